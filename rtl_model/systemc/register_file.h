// The registers, built by walking the one table of firmware/registers.h: who may read and write, resets,
// storage.
#pragma once

#include "firmware/registers.h"

#include <cstdint>
#include <map>

namespace hopmesh::systemc {

enum class Access { RO, RW, WO, W1C };

class RegisterFile {
 public:
  RegisterFile();

  bool has(std::uint32_t offset) const { return registers_.count(offset) != 0; }
  bool writable(std::uint32_t offset) const { return registers_.at(offset).access != Access::RO; }
  /// As the bus sees it: write-only registers read as zero.
  std::uint32_t read(std::uint32_t offset) const;
  /// Which bits of the register belong to a field.
  std::uint32_t fields(std::uint32_t offset) const { return registers_.at(offset).fields; }
  /// As the bus does it: RW stores the bits of its fields, W1C clears. WO and RO store nothing (the device
  /// acts on WO by itself).
  void write(std::uint32_t offset, std::uint32_t word);
  /// As the hardware behind it does: stores in any register.
  void set(std::uint32_t offset, std::uint32_t word) { registers_.at(offset).value = word; }
  /// Every register that hardware or software may change, back to its reset value; capabilities stay.
  void reset();

 private:
  struct Register {
    Access access;
    std::uint32_t reset, value, fields;
  };
  std::map<std::uint32_t, Register> registers_;
};

} // namespace hopmesh::systemc
