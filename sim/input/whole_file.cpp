// Reads files through the C library, because it says why an open failed (no such file, no permission, ...).
#include "sim/input/whole_file.h"

#include "sim/input/input_error.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace hopmesh::input {

namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

File open(const std::string& path, const std::string& kind) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw input_error(path, 0, "", "a directory", kind);
  File file(std::fopen(path.c_str(), "rb"));
  if (file) return file;
  const int reason = errno;
  throw input_error(path, 0, "", reason == ENOENT ? "no such file" : std::strerror(reason), kind);
}

} // namespace

std::string read_whole_file(const std::string& path, const std::string& kind, std::size_t most_bytes) {
  const File file = open(path, kind);
  std::string text;
  char block[65536];
  while (const std::size_t got = std::fread(block, 1, sizeof block, file.get())) {
    text.append(block, got);
    if (text.size() > most_bytes)
      throw input_error(path, 0, "", fmt::format("more than {} bytes", most_bytes),
                        kind + " of at most that size");
  }
  if (std::ferror(file.get())) throw input_error(path, 0, "", "a read error", kind);
  if (text.empty()) throw input_error(path, 0, "", "an empty file", kind);
  return text;
}

} // namespace hopmesh::input
