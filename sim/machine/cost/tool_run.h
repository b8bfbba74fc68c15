// Programs of others that measure a design, where they are installed: yosys, nextpnr-ice40, OpenSTA, and the
// cells of OSU's 0.18 um library.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hopmesh::machine {

struct CostTools {
  std::string yosys, nextpnr, sta; ///< paths; empty where there is none
  std::string liberty;             ///< cells and their delays

  bool weigh_silicon() const { return !yosys.empty() && !sta.empty() && !liberty.empty(); }
  bool place() const { return !yosys.empty() && !nextpnr.empty(); }
  /// Names of those that are not there.
  std::vector<std::string> missing() const;
};
/// Looks along PATH, and where Debian puts the library.
CostTools find_cost_tools();

/// Runs a program in a folder, its output in a file there. What it ended with; 127 where it could not begin.
int run_tool(const std::vector<std::string>& words, const std::filesystem::path& folder,
             const std::string& log);

/// What a tool wrote; empty where there is no such file.
std::string file_text(const std::filesystem::path& file);

/// Does jobs, so many at a time. They must not throw.
void do_jobs(const std::vector<std::function<void()>>& jobs, std::size_t workers);

} // namespace hopmesh::machine
