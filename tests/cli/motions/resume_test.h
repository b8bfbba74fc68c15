// What the tests of --checkpoint-every and --resume share: a run that an end comes to, and its folder
// afterwards.
#pragma once

#include "tests/support/cli_test.h"

namespace hopmesh::tests {

class CliResume : public Cli {
 protected:
  /// Starts the line, sends the signal once so many steps were told safe, and waits for the end.
  Finished ended(const std::string& line, std::uint64_t safe, int signal) const {
    Program program(words_of(line), around);
    EXPECT_TRUE(program.wait_for("checkpoint: " + std::to_string(safe) + " of")) << line;
    program.send(signal);
    return program.finish();
  }

  /// The most steps that a process told to be safe; 0 if none.
  static std::uint64_t told_safe(const std::string& err) {
    std::uint64_t most = 0;
    for (const std::string& line : lines_of(err)) {
      unsigned long done = 0, of = 0;
      char end = 0;
      if (std::sscanf(line.c_str(), "checkpoint: %lu of %lu steps are saf%c", &done, &of, &end) == 3)
        most = std::max<std::uint64_t>(most, done);
    }
    return most;
  }

  /// "" if two folders hold the same run: every file but the two that tell times, and the totals of these.
  static std::string difference(const std::filesystem::path& a, const std::filesystem::path& b) {
    if (names_in(a) != names_in(b)) return "names: " + ::testing::PrintToString(names_in(b));
    for (const std::string& name : names_in(a))
      if (name != "stats.json" && name != "report.html" && content_of(a / name) != content_of(b / name))
        return name;
    auto stats = read_json(a / "stats.json"), others = read_json(b / "stats.json");
    for (const char* of_this_computer : {"wall_seconds", "steps_per_second", "neuron_updates_per_second",
                                         "peak_memory_mb", "simulated_cycles_per_second"}) {
      stats.erase(of_this_computer);
      others.erase(of_this_computer);
    }
    return stats == others ? "" : "stats.json";
  }
};

} // namespace hopmesh::tests
