// Reads a stream through once, from its beginning to where it was marked.
#include "sim/files/stream_rest.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <vector>

namespace hopmesh::files {
namespace {

constexpr std::size_t block_bytes = 1u << 20;

/// Adds `bytes` of the file from where it stands; false where it ends before.
bool add_from(std::ifstream& file, std::uint64_t bytes, RunningCheck& check) {
  std::vector<char> block(static_cast<std::size_t>(std::min<std::uint64_t>(bytes, block_bytes)));
  while (bytes > 0) {
    const auto part = static_cast<std::size_t>(std::min<std::uint64_t>(bytes, block.size()));
    if (!file.read(block.data(), static_cast<std::streamsize>(part))) return false;
    check.add(block.data(), part);
    bytes -= part;
  }
  return true;
}

/// "" if the file begins as marked, else what was found.
std::string fault_of(const std::filesystem::path& path, const StreamMark& mark, const std::string& head,
                     RunningCheck& check) {
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(path, error);
  if (error) return error.message();
  const std::string name = path.filename().string();
  if (size < mark.bytes) return fmt::format("{} of {} bytes", name, size);
  std::ifstream file(path, std::ios::binary);
  if (!file) return fmt::format("{}: {}", name, std::strerror(errno));
  file.seekg(static_cast<std::streamoff>(head.size()));
  check.add(head.data(), head.size());
  if (mark.bytes < head.size() || !add_from(file, mark.bytes - head.size(), check))
    return name + " that cannot be read so far";
  return check.value() == mark.check ? "" : fmt::format("{} with check {:016x}", name, check.value());
}

} // namespace

std::filesystem::path part_of(const std::filesystem::path& path) {
  return path.string() + ".part";
}

std::optional<StreamRest> find_rest(const std::filesystem::path& path, const StreamMark& mark,
                                    const std::string& head, std::string& found) {
  found.clear();
  for (const auto& place : {part_of(path), path}) { // what has its name already is given up last
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(place, ignored)) continue;
    RunningCheck check;
    const std::string fault = fault_of(place, mark, head, check);
    if (fault.empty()) return StreamRest{place, head, mark.bytes, std::move(check)};
    if (found.empty()) found = fault;
  }
  if (found.empty()) found = fmt::format("neither {0}.part nor {0}", path.filename().string());
  return std::nullopt;
}

} // namespace hopmesh::files
