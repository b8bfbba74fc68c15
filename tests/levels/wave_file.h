// A folder of its own for each test, and runs of the built program in it.
#pragma once

#include "tests/support/vcd.h"

#include "place.h"

#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace hopmesh::tests {

namespace fs = std::filesystem;

inline std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

/// At the level that the test is for.
class WaveFile : public testing::TestWithParam<std::string> {
 protected:
  WaveFile() {
    char name[] = "/tmp/hopmesh-wave-XXXXXX";
    folder = mkdtemp(name);
  }
  ~WaveFile() override { fs::remove_all(folder); }

  /// Exit code of `hopmesh run ...` in the test's folder.
  int run(const std::string& arguments, const std::string& level = "", const std::string& before = "") {
    const std::string command = "cd " + folder.string() + " && " + before + "'" HOPMESH_PROGRAM "' run " +
                                arguments + " --level " + (level.empty() ? GetParam() : level) +
                                " >out.txt 2>err.txt </dev/null";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// A run with a wave, which must end well and say nothing on stderr.
  Vcd wave(const std::string& arguments, const std::string& level = "") {
    EXPECT_EQ(run(arguments + " --no-check --out r --wave w.vcd", level), 0) << arguments;
    EXPECT_EQ(content(folder / "err.txt"), "") << arguments;
    return read_vcd(folder / "w.vcd");
  }
  std::vector<std::string> column(const std::string& name) {
    std::istringstream in(content(folder / "r/steps.csv"));
    std::vector<std::string> cells;
    std::string line, cell;
    for (std::size_t k = 0, wanted = 0; std::getline(in, line); ++k) {
      std::istringstream row(line);
      for (std::size_t c = 0; std::getline(row, cell, ','); ++c) {
        if (k == 0 && cell == name) wanted = c;
        if (k > 0 && c == wanted) cells.push_back(cell);
      }
    }
    return cells;
  }
  std::vector<std::uint64_t> cycles() {
    std::vector<std::uint64_t> numbers;
    for (const std::string& text : column("cycles")) numbers.push_back(std::stoull(text));
    return numbers;
  }
  /// The last `count` codes of outputs_raw.npy.
  std::vector<std::int32_t> last_codes(std::size_t count) {
    const std::string bytes = content(folder / "r/outputs_raw.npy");
    std::vector<std::int32_t> codes(count);
    std::memcpy(codes.data(), bytes.data() + bytes.size() - 4 * count, 4 * count);
    return codes;
  }

  fs::path folder;
};

/// Nine nodes, the first of them pinned: cell c is node c + 1.
inline const std::string nine = "two-nodes --set mesh.grid.rows=3 --set mesh.grid.columns=3 "
                                "--set mesh.springs.shear=1.0 --set relax.max_sweeps=2";

inline std::string neuron(std::size_t cell, std::size_t p) {
  return ".cell_" + std::to_string(cell) + ".neuron_" + std::to_string(p);
}

} // namespace hopmesh::tests
