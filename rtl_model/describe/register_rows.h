// The table of firmware/registers.h as rows, and the descriptions that other tools take of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hopmesh::describe {

/// What a host may do with a register or field (firmware/registers.h tells what the words mean).
enum class Access { RO, RW, WO, W1C };

struct FieldRow {
  std::string name;
  int lowest = 0, width = 32; ///< bits
  Access access = Access::RO;
  std::string meaning;
};

struct RegisterRow {
  std::string name;
  std::uint32_t offset = 0; ///< bytes
  Access access = Access::RO;
  std::uint32_t reset = 0;
  bool as_built = false; ///< a property of the array at hand, which has no reset
  std::string meaning;
  std::vector<FieldRow> fields; ///< from the lowest bit on
};

struct WindowRow {
  std::string name;
  Access access = Access::RO;
  std::string meaning;
};

/// All registers, in the order of their offsets.
std::vector<RegisterRow> register_rows();
/// All windows, in the order in which they lie behind the registers.
std::vector<WindowRow> window_rows();

/// The version of the registers: "2.0".
std::string version_text();
/// An access as "RO", "RW", "WO" or "W1C".
const char* name_of(Access access);
/// A number as 0x and at least so many digits.
std::string hex(std::uint32_t value, int digits = 1);

// Tables of docs/hardware/registers.md.
std::string register_table();
std::string field_table();
std::string window_table();

/// A description: how people name it, what its file is called, and its text.
struct Format {
  const char *name, *file;
  std::string (*text)();
};

std::string markdown_text();
std::string c_text();
std::string system_rdl_text();
std::string ip_xact_text();
std::string svd_text();
std::string verilog_text();

inline constexpr Format formats[] = {{"markdown", "hopmesh_registers.md", markdown_text},
                                     {"c", "hopmesh_registers.h", c_text},
                                     {"systemrdl", "hopmesh_registers.rdl", system_rdl_text},
                                     {"ip-xact", "hopmesh_registers.xml", ip_xact_text},
                                     {"svd", "hopmesh_registers.svd", svd_text},
                                     {"verilog", "hm_register_map.vh", verilog_text}};

} // namespace hopmesh::describe
