// Files that are either whole or absent: written beside their final name, and renamed when they are finished.
#pragma once

#include "sim/files/stream_rest.h"

#include <stdexcept>
#include <string_view>

namespace hopmesh::files {

/// What kept a file from being written: one line with the path and the system's reason.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Somebody else is writing the file or folder at this moment.
class BusyError : public WriteError {
 public:
  using WriteError::WriteError;
};

/// Writes NAME.part in the folder of NAME; commit() gives it its name. Without commit() nothing stays behind,
/// but for what sync() made safe. A device or pipe (/dev/stdout) has no temporary name and is written in
/// place.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  /// Goes on where the rest ends; whatever stands behind it is cut off.
  OutputFile(std::filesystem::path path, StreamRest rest);
  ~OutputFile();
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  /// Replaces bytes already written, e.g. a count in a header; the end of the file stays the place to write.
  void patch(std::uint64_t offset, std::string_view text);
  /// On the disk once this returns, as NAME.part, which from now on stays even without commit().
  StreamMark sync();
  /// On the disk and under the final name once this returns.
  void commit();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t bytes() const { return bytes_ + buffer_.size(); } ///< written so far

 private:
  void open_part(const std::filesystem::path& place);
  void cut(std::uint64_t bytes);
  void put(const char* data, std::size_t bytes);
  void flush();
  [[noreturn]] void fail(const char* what, int error) const;

  std::filesystem::path path_, part_; ///< part_ is empty when written in place
  int fd_ = -1;
  bool keep_ = false; ///< NAME.part stays behind
  std::string buffer_;
  std::uint64_t bytes_ = 0; ///< written so far, without the buffer
  RunningCheck check_;      ///< over these
};

/// The whole file at once.
void write_file(const std::filesystem::path& path, std::string_view text);

/// The whole file at once, unless it is there: several processes may come to it at the same moment, all of
/// them with this text.
void write_once(const std::filesystem::path& path, std::string_view text);

/// Makes the folder and proves that a file can be made in it and that bytes_wanted are free, before hours of
/// work.
void check_writable(const std::filesystem::path& folder, std::uint64_t bytes_wanted);

} // namespace hopmesh::files
