// A folder has one writer: whoever holds it may read what a killed run left there and go on with it.
#pragma once

#include <filesystem>

namespace hopmesh::files {

/// A lock on the folder itself: it leaves no file behind, and ends with the process however that ends.
class FolderLock {
 public:
  /// Throws WriteError if another run holds it. A folder on a disk that knows no locks is not locked; there
  /// the locks of its files have to do.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  int fd_ = -1;
};

} // namespace hopmesh::files
