#include "sim/levels/hosts/core_program.h"

#include <cstring>
#include <elf.h>
#include <stdexcept>

namespace hopmesh::levels {

namespace {

template <typename Header> Header at(std::string_view bytes, std::size_t offset) {
  if (offset + sizeof(Header) > bytes.size()) throw std::logic_error("an ELF file that ends too early");
  Header header;
  std::memcpy(&header, bytes.data() + offset, sizeof header);
  return header;
}

/// A compiler's copies of a function, like "add_spring.constprop.0", are that function.
std::string plain_name(const std::string& symbol) {
  return symbol.substr(0, symbol.find('.'));
}

} // namespace

CoreProgram::CoreProgram(std::string_view elf) {
  if (elf.substr(0, SELFMAG) != ELFMAG || elf[EI_CLASS] != ELFCLASS32)
    throw std::logic_error("no ELF file of 32 bits");
  read_parts(elf);
  read_symbols(elf);
}

void CoreProgram::read_parts(std::string_view elf) {
  const auto head = at<Elf32_Ehdr>(elf, 0);
  for (std::size_t k = 0; k < head.e_phnum; ++k) {
    const auto part = at<Elf32_Phdr>(elf, head.e_phoff + k * head.e_phentsize);
    if (part.p_type == PT_LOAD && part.p_filesz > 0)
      parts_.push_back({part.p_vaddr, elf.substr(part.p_offset, part.p_filesz)});
  }
}

void CoreProgram::read_symbols(std::string_view elf) {
  const auto head = at<Elf32_Ehdr>(elf, 0);
  for (std::size_t k = 0; k < head.e_shnum; ++k) {
    const auto table = at<Elf32_Shdr>(elf, head.e_shoff + k * head.e_shentsize);
    if (table.sh_type != SHT_SYMTAB) continue;
    const auto names = at<Elf32_Shdr>(elf, head.e_shoff + table.sh_link * head.e_shentsize);
    for (std::size_t place = 0; place < table.sh_size; place += sizeof(Elf32_Sym)) {
      const auto symbol = at<Elf32_Sym>(elf, table.sh_offset + place);
      const std::string name = elf.data() + names.sh_offset + symbol.st_name;
      if (name.empty() || name[0] == '$' || name[0] == '.') continue;
      symbols_[name] = symbol.st_value;
      if (ELF32_ST_TYPE(symbol.st_info) == STT_FUNC) functions_[symbol.st_value] = plain_name(name);
    }
  }
}

std::uint32_t CoreProgram::address_of(const std::string& symbol) const {
  const auto found = symbols_.find(symbol);
  if (found == symbols_.end()) throw std::logic_error("a core's program without " + symbol);
  return found->second;
}

} // namespace hopmesh::levels
