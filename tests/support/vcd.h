// A small reader of value change dumps (IEEE 1364, 18), for what SystemC writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace hopmesh::tests {

struct Vcd {
  struct Change {
    std::uint64_t picoseconds;
    std::int64_t value;
  };
  struct Signal {
    int width = 0;
    std::int64_t initial = 0;
    std::vector<Change> changes;

    std::int64_t last() const { return changes.empty() ? initial : changes.back().value; }
    /// Times at which a one-bit signal went from 0 to 1.
    std::vector<std::uint64_t> rises() const;
  };

  std::map<std::string, Signal> signals; ///< by scope.scope.name
  std::vector<std::uint64_t> times;      ///< every time stamp, in picoseconds

  /// The one signal whose name ends so. Throws where there is none or more than one.
  const Signal& at(const std::string& ending) const;
};

/// Throws std::runtime_error with the line that is no VCD.
Vcd read_vcd(const std::filesystem::path& file);

} // namespace hopmesh::tests
