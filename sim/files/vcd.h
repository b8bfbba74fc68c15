// Value change dumps (IEEE 1364, clause 18), for GTKWave and its kin: whole under their name, or absent.
#pragma once

#include "sim/files/output_file.h"

#include <vector>

namespace hopmesh::files {

class VcdFile {
 public:
  /// `picoseconds`: the unit in which times count, 1 or 1000.
  VcdFile(const std::filesystem::path& path, std::uint64_t picoseconds);

  // First the signals: scopes open and close, and each signal of the innermost one gets a number.
  void open_scope(std::string_view name);
  void close_scope();
  std::size_t add(std::string_view name, int width);

  /// Ends the definitions; values so far (0 where none was set) are those at `time`.
  void begin(std::uint64_t picoseconds);
  bool begun() const { return begun_; }
  /// Later changes happen at this time; it may stay, but not go back.
  void time(std::uint64_t picoseconds) { time_ = picoseconds; }
  void set(std::size_t signal, std::int64_t value) {
    if (signals_[signal].value != value) change(signal, value);
  }
  /// Complete up to now, on the disk under its name.
  void finish();

 private:
  struct Signal {
    std::string code;
    int width;
    std::int64_t value;
  };

  void change(std::size_t signal, std::int64_t value);
  void write_time();
  void write_value(const Signal& signal);

  OutputFile file_;
  const std::uint64_t unit_;
  std::vector<Signal> signals_;
  std::uint64_t time_ = 0, written_time_ = UINT64_MAX; ///< the last one in the file
  bool begun_ = false;
};

} // namespace hopmesh::files
