// Pages of docs/use/ against the program (scene files, array files, the results folder, networks of one's
// own): keys, defaults, presets, files, columns, flags.
#include "tests/support/cli_test.h"

#include "place.h"

#include <regex>
#include <set>

namespace hopmesh::tests {
namespace {

using ::testing::HasSubstr;

class CliDocs : public Cli {
 protected:
  static std::string page(const std::string& name) { return content_of(HOPMESH_SOURCE_DIR "/docs/" + name); }

  /// Rows of all tables, or of those under a heading; cells without the blanks around them.
  static std::vector<std::vector<std::string>> rows_of(const std::string& text,
                                                       const std::string& heading = "") {
    std::vector<std::vector<std::string>> rows;
    bool inside = heading.empty();
    for (const std::string& line : lines_of(text)) {
      if (line.rfind("## ", 0) == 0) inside = heading.empty() || line == "## " + heading;
      if (!inside || line[0] != '|') continue;
      rows.emplace_back();
      for (std::string cell : split(line.substr(1, line.size() - 2), '|')) {
        cell.erase(0, cell.find_first_not_of(' '));
        cell.erase(cell.find_last_not_of(' ') + 1);
        rows.back().push_back(cell);
      }
    }
    return rows;
  }

  /// Everything in `backticks` in the first cell of the rows under a heading, or in the last one, in order.
  static std::vector<std::string> named_in(const std::string& text, const std::string& heading,
                                           bool last = false) {
    std::vector<std::string> names;
    static const std::regex code("`([^`]*)`");
    for (const auto& row : rows_of(text, heading)) {
      const std::string& cell = last ? row.back() : row[0];
      for (std::sregex_iterator at(cell.begin(), cell.end(), code), end; at != end; ++at)
        names.push_back((*at)[1]);
    }
    return names;
  }

  /// Keys with their full paths, and values as written, of TOML that the program prints.
  static std::map<std::string, std::string> keys_of(const std::string& toml) {
    std::map<std::string, std::string> keys;
    std::string table;
    static const std::regex inner(R"((\w+) = (\[[^\]]*\]|[^,}]+?)[ ,}])");
    for (const std::string& line : lines_of(toml)) {
      if (line.empty() || line[0] == '#') continue;
      if (line[0] == '[') {
        table = line.substr(1, line.size() - 2) + '.';
        continue;
      }
      const auto equals = line.find(" = ");
      const std::string key = table + line.substr(0, equals), value = line.substr(equals + 3);
      if (value[0] != '{') keys[key] = value;
      for (std::sregex_iterator at(value.begin(), value.end(), inner), end; value[0] == '{' && at != end;
           ++at)
        keys[key + '.' + (*at)[1].str()] = (*at)[2];
    }
    return keys;
  }

  std::pair<std::map<std::string, std::string>, std::map<std::string, std::string>>
  scene_and_array(const std::string& line) const {
    const std::string toml = good("info --toml " + line).out;
    const auto cut = toml.find("\n# array\n");
    return {keys_of(toml.substr(0, cut)), keys_of(toml.substr(cut))};
  }

  /// The default of a key as a page tells it.
  static std::string default_in(const std::string& text, const std::string& key) {
    for (const auto& row : rows_of(text, "Keys"))
      if (row[0] == '`' + key + '`') return row.at(3);
    return "no row";
  }
};

TEST_F(CliDocs, EveryKeyOfASceneIsOnItsPageWithItsDefault) {
  write_text(at("s.toml"), "mesh.grid = {}\n");
  std::filesystem::copy(HOPMESH_SOURCE_DIR "/tests/scene/good/tent.obj", at("tent.obj"));
  write_text(at("f.toml"), "mesh.file = \"tent.obj\"\nforce.wind = [0, 0, 0]\n");
  const std::string text = page("use/scene-files.md");
  for (const auto& [key, value] : scene_and_array("s.toml").first)
    EXPECT_EQ(default_in(text, key), key == "name" ? "the file's name" : '`' + value + '`') << key;
  for (const auto& [key, value] : scene_and_array("f.toml").first)
    EXPECT_EQ(default_in(text, key), key == "name"                               ? "the file's name"
                                     : key == "mesh.file" || key == "force.wind" ? "none"
                                                                                 : '`' + value + '`')
        << key;
}

TEST_F(CliDocs, EveryKeyOfAnArrayIsOnItsPageWithItsDefault) {
  const std::string text = page("use/array-files.md");
  for (const auto& [key, value] : scene_and_array("two-nodes").second) {
    if (key == "name") continue;
    EXPECT_EQ(default_in(text, key), '`' + value + '`') << key;
  }
  EXPECT_EQ(default_in(text, "preset"), "`\"guarded\"`");
}

TEST_F(CliDocs, EveryKeyOnAPageIsOneOfTheProgram) {
  for (const char* name : {"use/scene-files.md", "use/array-files.md"})
    for (const std::string& key : named_in(page(name), "Keys")) {
      if (key == "preset") continue;                                        // of array files alone
      const Finished f = hopmesh("info two-nodes --set " + key + "=[[1]]"); // no key has such a value
      EXPECT_EQ(f.exit_code, 2) << key;
      const std::string group = key.substr(0, key.rfind('.')); // which may say first what it lacks
      EXPECT_THAT(f.err, ::testing::AnyOf(HasSubstr(key), HasSubstr("--set: " + group + ": found no ")))
          << key;
      EXPECT_EQ(f.err.find("unknown key"), std::string::npos) << f.err;
    }
}

TEST_F(CliDocs, PresetsAreWhatTheArrayPageSays) {
  const auto rows = rows_of(page("use/array-files.md"), "Presets");
  const auto plain = scene_and_array("two-nodes").second;
  for (std::size_t column = 1; column <= 7; ++column) {
    const std::string preset = split(rows[0].at(column), '`')[1];
    auto expected = plain;
    expected["name"] = '"' + preset + '"';
    for (std::size_t k = 2; k < rows.size() && rows[k].size() == 8; ++k)
      expected[split(rows[k][0], '`')[1]] = split(rows[k].at(column), '`')[1];
    EXPECT_EQ(scene_and_array("two-nodes --array " + preset).second, expected) << preset;
  }
  EXPECT_THAT(
      hopmesh("info two-nodes --array none").err,
      HasSubstr("\"guarded\", \"descent\", \"prescaled\", \"byte\", \"folded\", \"descent-projected\" or "
                "\"descent-momentum\""));
}

TEST_F(CliDocs, EveryShippedSceneIsOnTheScenePage) {
  const auto named = named_in(page("use/scene-files.md"), "Shipped scenes");
  std::set<std::string> files;
  for (const std::string& file : names_in(HOPMESH_SOURCE_DIR "/sim/scenes"))
    if (std::filesystem::path(file).extension() == ".toml") files.insert(std::filesystem::path(file).stem());
  EXPECT_EQ(std::set<std::string>(named.begin(), named.end()), files);
}

TEST_F(CliDocs, ExamplesOfScenesAndArraysAreGood) {
  static const std::regex block("```toml\n([^`]*)```");
  std::smatch scene, array;
  const std::string of_scene = page("use/scene-files.md"), of_array = page("use/array-files.md");
  ASSERT_TRUE(std::regex_search(of_scene, scene, block) && std::regex_search(of_array, array, block));
  write_text(at("s.toml"), scene[1]);
  write_text(at("a.toml"), array[1]);
  EXPECT_EQ(fault_of_results(results_of("s.toml --array a.toml --steps 3", "r"), 3), "");
}

TEST_F(CliDocs, TheExampleOfVectorsIsWhatTheProgramWrites) {
  good("vectors two-nodes --step 3 --out two-nodes.txt");
  EXPECT_THAT(page("use/test-vectors.md"),
              HasSubstr("```text\n" + content_of(at("two-nodes.txt")) + "```\n"));
}

// In order, in one folder, as a reader types them; "exit 1" in a comment says that a command ends so.
TEST_F(CliDocs, CommandsOfTheNetworksPageRun) {
  static const std::regex command("    hopmesh ([^#]*[^# ]) *(#.*)?");
  int tried = 0;
  for (const std::string& line : lines_of(page("use/own-networks.md"))) {
    std::smatch part;
    if (!std::regex_match(line, part, command)) continue;
    const bool refuses = part[2].str().find("exit 1") != std::string::npos;
    const Finished f = hopmesh(part[1]);
    EXPECT_EQ(f.exit_code, refuses ? 1 : 0) << line << f.err;
    EXPECT_EQ(f.out.find("limit cycle of 2") != std::string::npos, refuses) << line;
    ++tried;
  }
  EXPECT_GT(tried, 5);
}

TEST_F(CliDocs, EveryFlagFileAndColumnOfSolveIsOnItsPage) {
  good("solve cut-16 --out o");
  const std::string text = page("use/own-networks.md"), problems = page("findings/problem-set.md");
  for (const std::string& name : names_in(at("o"))) EXPECT_THAT(text, HasSubstr('`' + name + '`'));
  for (const std::string& name : read_table(at("o/solve.csv")).header)
    EXPECT_THAT(text, HasSubstr('`' + name + '`'));
  for (const std::string& line : lines_of(good("problems").out))
    EXPECT_THAT(problems, HasSubstr('`' + split(line, ' ')[0] + '`'));
  static const std::regex flag("(--[a-z]+)");
  const std::string help = good("solve --help").out;
  for (std::sregex_iterator at(help.begin(), help.end(), flag), end; at != end; ++at) {
    if ((*at)[1] == "--help") continue;
    EXPECT_THAT(text, HasSubstr((*at)[1].str()));
  }
}

TEST_F(CliDocs, FilesColumnsAndKeysOfResultsAreOnTheirPage) {
  const auto folder = results_of("two-nodes --steps 1 --check", "r");
  const std::string text = page("use/results-folder.md");
  for (const std::string& name : names_in(folder)) EXPECT_THAT(text, HasSubstr("| `" + name + "` |"));
  EXPECT_EQ(named_in(text, "steps.csv"), read_table(folder / "steps.csv").header);
  const auto names_under = [&](const std::string& heading) {
    const auto named = named_in(text, heading);
    return std::set<std::string>(named.begin(), named.end());
  };
  const auto keys_in = [](const nlohmann::json& json, const std::string& within) {
    std::set<std::string> keys;
    for (const auto& item : json.items()) keys.insert(within + item.key());
    return keys;
  };
  EXPECT_EQ(names_under("manifest.json"), keys_in(read_json(folder / "manifest.json"), ""));
  const auto stats = read_json(folder / "stats.json");
  std::set<std::string> named = names_under("stats.json"), keys = keys_in(stats, "");
  for (const std::string& total : named_in(text, "steps.csv", true))
    if (total != "stats.json") named.insert(total); // the heading of the column of totals
  keys.merge(keys_in(stats["against_reference"], "against_reference."));
  const auto corrected = results_of("banner --steps 1 --set relax.refinements=1", "c");
  keys.merge(keys_in(read_json(corrected / "stats.json"), ""));
  const auto certain = results_of("banner --steps 1 --check", "k"); // whose network is definite
  keys.merge(keys_in(read_json(certain / "stats.json")["against_reference"], "against_reference."));
  const auto whole = results_of("banner --steps 1 --check --set host.arithmetic=fixed", "w");
  keys.merge(keys_in(read_json(whole / "stats.json")["against_reference"], "against_reference."));
  keys.insert({"host", "host.instructions"});
  if (hopmesh("run two-nodes --steps 1 --host rv32 --out e").exit_code == 0) { // the build has the emulator
    EXPECT_TRUE(read_json(at("e/stats.json"))["host"].contains("instructions"));
  }
  EXPECT_EQ(named, keys);
  for (const auto& item : stats["ranges"][0].items()) EXPECT_THAT(text, HasSubstr('`' + item.key() + '`'));
}

} // namespace
} // namespace hopmesh::tests
