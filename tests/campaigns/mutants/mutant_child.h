// What a child does: reads mutants one after the other, and tells where it is in memory that outlives it.
#pragma once

#include "tests/campaigns/mutants/hunt.h"

namespace hopmesh::campaigns {

/// Where a child is, and what it counted.
struct ChildPlace {
  std::atomic<std::uint64_t> number{0}, read{0}, refused{0}, faults{0};
};

/// A place that parent and children see.
class SharedPlace {
 public:
  SharedPlace();
  ~SharedPlace();
  SharedPlace(const SharedPlace&) = delete;
  SharedPlace& operator=(const SharedPlace&) = delete;
  ChildPlace* operator->() const { return place_; }
  ChildPlace& operator*() const { return *place_; }

 private:
  ChildPlace* place_;
};

struct ChildWork {
  const Reader& reader;
  const Hunt& plan;
  std::filesystem::path folder; ///< the child's own
  std::uint64_t from, to;
};
/// The exit code of the child. What it says goes into FOLDER.stderr; a hang ends it by SIGPROF or SIGALRM.
int read_mutants(const ChildWork& work, ChildPlace& place);

/// A fault's folder: the mutant, and why it is kept.
struct Kept {
  const std::filesystem::path& out;
  const Reader& reader;
  std::uint64_t number;

  void keep(const std::string& mutant, const std::string& why) const;
};

} // namespace hopmesh::campaigns
