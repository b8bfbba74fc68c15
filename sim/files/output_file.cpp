// Write beside the final name, fsync, rename, fsync the folder: the order that survives a crash at any point.
#include "sim/files/output_file.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace hopmesh::files {
namespace {

constexpr std::size_t buffer_bytes = 1u << 20;

[[noreturn]] void throw_error(const std::filesystem::path& path, const char* what, int error) {
  throw WriteError(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

/// Writes all of it, however the system slices it; returns 0 or errno.
int write_all(int fd, const char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t written = ::write(fd, data, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    data += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return 0;
}

int pwrite_all(int fd, const char* data, std::size_t bytes, off_t offset) {
  while (bytes > 0) {
    const ssize_t written = ::pwrite(fd, data, bytes, offset);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    data += written;
    offset += written;
    bytes -= static_cast<std::size_t>(written);
  }
  return 0;
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

/// A rename lives in the folder's own data: it is safe only when that has reached the disk.
void sync_folder(const std::filesystem::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return; // a folder that may be written but not listed: the file is there all the same
  ::fsync(fd);
  ::close(fd);
}

bool written_in_place(const std::filesystem::path& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && (S_ISCHR(info.st_mode) || S_ISFIFO(info.st_mode));
}

bool same_file(int fd, const std::filesystem::path& path) {
  struct stat mine {
  }, named{};
  return ::fstat(fd, &mine) == 0 && ::stat(path.c_str(), &named) == 0 && mine.st_ino == named.st_ino &&
         mine.st_dev == named.st_dev;
}

std::string in_units(std::uint64_t bytes) {
  const char* const units[] = {"B", "kB", "MB", "GB", "TB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1000.0 && unit < 4; ++unit) value /= 1000.0;
  return fmt::format("{:.{}f} {}", value, unit == 0 ? 0 : 1, units[unit]);
}

} // namespace

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) fail("cannot write", EISDIR);
  if (!written_in_place(path_)) {
    part_ = part_of(path_);
    open_part(part_);
    cut(0);
  } else if ((fd_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC)) < 0) {
    fail("cannot write", errno);
  }
  buffer_.reserve(buffer_bytes);
}

// Wherever a process ends in here, the rest still begins as it was marked.
OutputFile::OutputFile(std::filesystem::path path, StreamRest rest)
    : path_(std::move(path)), part_(part_of(path_)), keep_(true), bytes_(rest.bytes),
      check_(std::move(rest.check)) {
  open_part(rest.found);
  if (rest.found != part_ && ::rename(rest.found.c_str(), part_.c_str()) != 0) {
    const int error = errno;
    ::close(std::exchange(fd_, -1));
    fail("cannot take up again", error);
  }
  cut(rest.bytes);
  buffer_.reserve(buffer_bytes);
  patch(0, rest.head);
}

/// What a killed run left is taken over; what a live run holds (its lock tells) is not.
void OutputFile::open_part(const std::filesystem::path& place) {
  while (true) {
    fd_ = ::open(place.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd_ < 0 && errno == ELOOP)
      throw WriteError(
          fmt::format("{}: found a symbolic link, expected a file of ours or none", place.string()));
    if (fd_ < 0) fail("cannot create", errno);
    if (::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      ::close(std::exchange(fd_, -1));
      throw BusyError(fmt::format("{}: another run is writing this file", path_.string()));
    }
    if (same_file(fd_, place)) break; // else its owner renamed it between our open and our lock: try again
    ::close(std::exchange(fd_, -1));
  }
}

void OutputFile::cut(std::uint64_t bytes) {
  const auto end = static_cast<off_t>(bytes);
  if (::ftruncate(fd_, end) == 0 && ::lseek(fd_, end, SEEK_SET) == end) return;
  const int error = errno;
  ::close(std::exchange(fd_, -1));
  fail(bytes == 0 ? "cannot empty" : "cannot cut", error);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)), part_(std::move(other.part_)), fd_(std::exchange(other.fd_, -1)),
      keep_(other.keep_), buffer_(std::move(other.buffer_)), bytes_(other.bytes_),
      check_(std::move(other.check_)) {}

OutputFile::~OutputFile() {
  if (fd_ < 0) return;
  if (!part_.empty() && !keep_) ::unlink(part_.c_str());
  ::close(fd_);
}

void OutputFile::fail(const char* what, int error) const {
  throw_error(path_, what, error);
}

void OutputFile::write(const void* data, std::size_t bytes) {
  if (fd_ < 0) fail("cannot write", EBADF);
  if (buffer_.size() + bytes > buffer_bytes) flush();
  if (bytes < buffer_bytes)
    buffer_.append(static_cast<const char*>(data), bytes);
  else
    put(static_cast<const char*>(data), bytes);
}

void OutputFile::put(const char* data, std::size_t bytes) {
  if (const int error = write_all(fd_, data, bytes)) fail("cannot write", error);
  check_.add(data, bytes);
  bytes_ += bytes;
}

// The buffer is empty afterwards even if the disk is full: nobody tries the same bytes twice.
void OutputFile::flush() {
  std::string waiting;
  waiting.swap(buffer_);
  put(waiting.data(), waiting.size());
  waiting.clear();
  buffer_.swap(waiting);
}

StreamMark OutputFile::sync() {
  if (fd_ < 0) fail("cannot write", EBADF);
  flush();
  if (::fsync(fd_) != 0) fail("cannot write", errno);
  keep_ = true;
  return {bytes_, check_.value()};
}

void OutputFile::patch(std::uint64_t offset, std::string_view text) {
  if (fd_ < 0) fail("cannot write", EBADF);
  flush();
  if (const int error = pwrite_all(fd_, text.data(), text.size(), static_cast<off_t>(offset)))
    fail("cannot write", error);
}

void OutputFile::commit() {
  if (fd_ < 0) fail("cannot finish", EBADF);
  flush();
  if (part_.empty()) {
    if (::close(std::exchange(fd_, -1)) != 0) fail("cannot finish", errno);
    return;
  }
  if (::fsync(fd_) != 0) fail("cannot finish", errno);
  if (::rename(part_.c_str(), path_.c_str()) != 0) fail("cannot rename into place", errno);
  ::close(std::exchange(fd_, -1));
  sync_folder(folder_of(path_));
}

void write_file(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_once(const std::filesystem::path& path, std::string_view text) {
  constexpr auto glance = std::chrono::milliseconds(5);
  for (std::error_code ignored; !std::filesystem::exists(path, ignored);) {
    try {
      return write_file(path, text);
    } catch (const BusyError&) {
      std::this_thread::sleep_for(glance);
    } catch (const WriteError&) { // on disks that know no locks another one may have renamed it away
      if (!std::filesystem::exists(path, ignored)) throw;
    }
  }
}

void check_writable(const std::filesystem::path& folder, std::uint64_t bytes_wanted) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw_error(folder, "cannot create the folder", error.value());
  if (!std::filesystem::is_directory(folder, error)) throw_error(folder, "is not a folder", ENOTDIR);

  const std::string probe =
      (folder / ".writable").string(); // one name: what a kill leaves goes with the next
  const int fd = ::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (fd < 0) throw_error(folder, "cannot write into the folder", errno);
  const int trouble = write_all(fd, "x", 1);
  ::close(fd);
  ::unlink(probe.c_str());
  if (trouble) throw_error(folder, "cannot write into the folder", trouble);

  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) return; // some network disks cannot say; the writes will
  const std::uint64_t free_bytes = static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
  if (free_bytes < bytes_wanted)
    throw WriteError(fmt::format("{}: {} are needed, {} are free: {}", folder.string(),
                                 in_units(bytes_wanted), in_units(free_bytes), std::strerror(ENOSPC)));
}

} // namespace hopmesh::files
