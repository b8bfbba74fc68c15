// What a killed or stopped run left of a file that it wrote piece by piece, proven before it is written on.
#pragma once

#include "sim/files/running_check.h"

#include <filesystem>
#include <optional>
#include <string>

namespace hopmesh::files {

/// How much of a stream is safe on the disk: its length, and a check over it as first written (what patch()
/// replaces later does not count).
struct StreamMark {
  std::uint64_t bytes = 0, check = 0;
};

/// A stream that was found to begin as marked; OutputFile takes it up.
struct StreamRest {
  std::filesystem::path found; ///< NAME.part, or NAME where it has its name already
  std::string head;            ///< its first bytes as first written
  std::uint64_t bytes = 0;
  RunningCheck check; ///< over those bytes
};

/// Looks at NAME.part, then at NAME, and touches nothing. `head`: the first bytes as first written, where
/// patch() may have replaced them since. None: `found` tells what is there instead.
std::optional<StreamRest> find_rest(const std::filesystem::path& path, const StreamMark& mark,
                                    const std::string& head, std::string& found);

/// The temporary name of an output file.
std::filesystem::path part_of(const std::filesystem::path& path);

} // namespace hopmesh::files
