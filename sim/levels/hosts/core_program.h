// The firmware as a program for another processor: what of its ELF file a loader needs.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hopmesh::levels {

/// Bytes that lie in memory from an address on.
struct ProgramPart {
  std::uint32_t address = 0;
  std::string_view bytes;
};

class CoreProgram {
 public:
  /// `elf`: a 32-bit little-endian file that stays. Throws std::logic_error for any other.
  explicit CoreProgram(std::string_view elf);

  const std::vector<ProgramPart>& parts() const { return parts_; }
  /// Throws std::logic_error where there is no such symbol.
  std::uint32_t address_of(const std::string& symbol) const;
  /// Address -> name of each function, in the order of addresses.
  const std::map<std::uint32_t, std::string>& functions() const { return functions_; }

 private:
  void read_parts(std::string_view elf);
  void read_symbols(std::string_view elf);

  std::vector<ProgramPart> parts_;
  std::map<std::string, std::uint32_t> symbols_;
  std::map<std::uint32_t, std::string> functions_;
};

} // namespace hopmesh::levels
