// What every test of the program stands on: a folder of its own, and command lines run in it.
#pragma once

#include "tests/support/program.h"
#include "tests/support/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hopmesh::tests {

class Cli : public ::testing::Test {
 protected:
  Cli() { around.folder = folder_.path(); }

  std::filesystem::path at(const std::string& name) const { return around.folder / name; }

  /// The program with the words of a line: run("info flag-400").
  Finished hopmesh(const std::string& line) const { return run_program(words_of(line), around); }

  /// A line where nothing may go wrong: exit 0 and silence on stderr, but for notes about keys.
  Finished good(const std::string& line) const {
    const Finished f = hopmesh(line);
    EXPECT_EQ(f.exit_code, 0) << line << '\n' << f.err << f.out;
    for (const std::string& told : lines_of(f.err))
      EXPECT_EQ(told.rfind("hopmesh: note: ", 0), 0u) << line << '\n' << told;
    return f;
  }

  /// A line that may not work: exit 2, silence on stdout, and on stderr a short line that says why; returns
  /// it.
  std::string refused(const std::string& line, const std::string& says = "") const {
    const Finished f = hopmesh(line);
    EXPECT_EQ(f.exit_code, 2) << line;
    EXPECT_EQ(f.out, "") << line;
    EXPECT_EQ(lines_of(f.err).size(), 1u) << line << '\n' << f.err;
    EXPECT_LT(f.err.size(), 600u) << f.err;
    EXPECT_THAT(f.err, ::testing::HasSubstr(says)) << line;
    return f.err;
  }

  /// A run into `out`; returns the folder.
  std::filesystem::path results_of(const std::string& line, const std::string& out) const {
    good("run " + line + " --out " + out);
    return at(out);
  }

  /// Two results folders must agree in every bit of their arrays, tables and hashes.
  static void expect_same_bits(const std::filesystem::path& a, const std::filesystem::path& b) {
    for (const char* name : {"positions.npy", "outputs_raw.npy", "steps.csv"})
      EXPECT_TRUE(content_of(a / name) == content_of(b / name)) << name;
    EXPECT_EQ(read_json(a / "manifest.json")["step_hashes"], read_json(b / "manifest.json")["step_hashes"]);
  }

  Surroundings around;

 private:
  Folder folder_;
};

} // namespace hopmesh::tests
