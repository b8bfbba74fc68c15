// The tables that make an array the array of a network: what the Verilog reads with $readmemh, and a
// simulated model is filled with.
#pragma once

#include "sim/machine/rtl/rtl_parameters.h"

namespace hopmesh::machine {

/// Rows of bits; row k has `words` words, its lowest bits first.
class BitTable {
 public:
  BitTable(std::string its_name, int bits, std::size_t count)
      : name(std::move(its_name)), width(bits), words((static_cast<std::size_t>(bits) + 31) / 32),
        rows(count), bits_(words * count, 0) {}

  /// The lowest `count` bits of `value`, from bit `at` of the row on.
  void put(std::size_t row, int at, int count, std::uint64_t value);
  const std::uint32_t* row(std::size_t k) const { return &bits_[k * words]; }
  /// A line of hexadecimal digits a row.
  std::string hex() const;

  const std::string name; ///< of the file, and of the parameter that says it, without `_FILE`
  const int width;
  const std::size_t words, rows;

 private:
  std::vector<std::uint32_t> bits_;
};

/// In the order of `rtl_table_names`. Widths follow from the room, rows from the network.
std::vector<BitTable> rtl_tables(const spec::ArraySpec& array, const spec::Topology& topology,
                                 const RtlRoom& room);
inline constexpr const char* rtl_table_names[] = {"LINES",      "ROUNDS",     "WEIGHT_MAP",
                                                  "NEURON_MAP", "FIRST_LINK", "LINK"};

} // namespace hopmesh::machine
