// The keys of scene and array files as tables of a page.
#include "tests/house/page_tables.h"

#include "rtl_model/spec/presets.h"
#include "sim/input/array_file.h"
#include "sim/scene/scene.h"

#include <fmt/format.h>

namespace hopmesh::tests {

namespace {

std::string in_ticks(const std::string& text) {
  return text.empty() ? "" : "`" + text + "`";
}

/// 0.5, 1e15, 1,000,000,000
std::string number(double x) {
  const bool whole = x == std::floor(x) && std::abs(x) < 1e12;
  std::string text = whole ? std::to_string(static_cast<std::int64_t>(x)) : fmt::format("{}", x);
  if (const auto plus = text.find('+'); plus != std::string::npos) text.erase(plus, 1);
  for (auto at = static_cast<std::ptrdiff_t>(text.size()) - 3; whole && at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), ",");
  return text;
}

/// What may stand at a key, of kinds whose values say so.
struct Allowed {
  const input::Key& key;

  std::string range() const { return number(key.range.low) + " to " + number(key.range.high); }

  std::string operator()(bool*) const { return "`true`, `false`"; }
  std::string operator()(int*) const { return range(); }
  std::string operator()(std::int64_t*) const { return range(); }
  std::string operator()(double*) const { return range(); }
  std::string operator()(std::optional<double>*) const { return range(); }
  std::string operator()(const input::Worded&) const { return range(); }
  std::string operator()(input::Vector3*) const { return "each within ±1e15"; }
  std::string operator()(std::optional<input::Vector3>*) const { return "each within ±1e15"; }
  std::string operator()(const spec::Choice& choice) const {
    std::string text;
    for (std::size_t k = 0; k < choice.count; ++k)
      text += fmt::format("{}`\"{}\"`", k ? ", " : "", choice.names[k]);
    return text;
  }
  template <typename Other> std::string operator()(const Other&) const { return "not told"; }
};

std::string page_row(const input::Key& key) {
  const std::string unset = key.unset.empty() ? in_ticks(input::value_text(key.place)) : key.unset;
  const std::string allowed = key.allowed.empty() ? std::visit(Allowed{key}, key.place) : key.allowed;
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.meaning, key.unit, unset, allowed);
}

} // namespace

std::string key_table(const input::Keys& keys) {
  std::string table = "| key | meaning | unit | default | range |\n|---|---|---|---|---|\n";
  for (const input::Key& key : keys)
    if (!std::holds_alternative<input::Part>(key.place)) table += page_row(key);
  return table;
}

std::string scene_table() {
  scene::Scene scene;
  scene.mesh.grid.emplace();
  scene.mesh.pin_ball.emplace();
  scene.force.image.emplace();
  return key_table(scene_keys(scene));
}

std::string array_table() {
  spec::ArraySpec array = spec::default_array();
  return key_table(input::array_file_keys(array));
}

std::string preset_table() {
  std::string table = "| key |", line = "|---|";
  std::vector<spec::ArraySpec> presets = spec::presets();
  for (const spec::ArraySpec& a : presets) table += " `" + a.name + "` |", line += "---|";
  table += "\n" + line + "\n";
  for (std::size_t row = 0; row < spec::array_keys(presets[0]).size(); ++row) {
    std::string cells;
    bool differ = false;
    for (spec::ArraySpec& a : presets) {
      const auto key = spec::array_keys(a)[row];
      differ |= key.value() != spec::array_keys(presets[0])[row].value();
      const bool number =
          std::holds_alternative<int*>(key.place) || std::holds_alternative<double*>(key.place);
      const std::string quotes = number ? "" : "\"";
      cells += " `" + quotes + key.value() + quotes + "` |";
    }
    if (differ) table += "| `" + spec::array_keys(presets[0])[row].name + "` |" + cells + "\n";
  }
  return table;
}

} // namespace hopmesh::tests
