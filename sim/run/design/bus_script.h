// What went over a bus, as a script that a test bench plays: every write, every read with the words that came
// back.
#pragma once

#include "sim/levels/array_port.h"

namespace hopmesh::run {

/// Hands everything on to the port behind it, and keeps it. Lines are those of
/// rtl_model/verilog/hopmesh_test.v.
class BusScript : public levels::ArrayPort {
 public:
  explicit BusScript(levels::ArrayPort& behind) : behind_(behind) {}

  int read(std::uint32_t address, std::uint32_t* words, std::uint32_t count) override;
  int write(std::uint32_t address, const std::uint32_t* words, std::uint32_t count) override;
  int wait_for_irq() override;

  /// With a line for the end.
  std::size_t lines() const { return lines_ + 1; }
  /// For $readmemh.
  std::string hex() const;

 private:
  enum class Line { end, write, writes, reads, wait };
  void add(Line line, std::uint32_t first, std::uint32_t second);

  levels::ArrayPort& behind_;
  std::string text_;
  std::size_t lines_ = 0;
};

} // namespace hopmesh::run
