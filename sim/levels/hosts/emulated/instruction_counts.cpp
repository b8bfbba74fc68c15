#include "sim/levels/hosts/emulated/instruction_counts.h"

#include <algorithm>

namespace hopmesh::levels {

InstructionCounts::InstructionCounts(const CoreProgram& program)
    : program_(program), begin_(program.address_of("hm_core_start")),
      library_(program.address_of("hm_core_library")),
      own_((program.address_of("hm_core_end") - begin_) / instruction_bytes + 1), charged_(own_.size()) {}

std::vector<HostFunction> InstructionCounts::functions() const {
  std::map<std::string, HostFunction> by_name;
  for (std::uint32_t place = 0; place < own_.size(); ++place) {
    if (own_[place] == 0 && charged_[place] == 0) continue;
    const auto behind = program_.functions().upper_bound(begin_ + instruction_bytes * place);
    const std::string name = behind == program_.functions().begin() ? "start" : std::prev(behind)->second;
    HostFunction& function = by_name[name];
    function.name = name;
    function.instructions += own_[place];
    function.with_library += charged_[place];
  }
  std::vector<HostFunction> all;
  for (auto& [name, function] : by_name) all.push_back(std::move(function));
  std::sort(all.begin(), all.end(), [](const HostFunction& a, const HostFunction& b) {
    return std::max(a.with_library, a.instructions) > std::max(b.with_library, b.instructions);
  });
  return all;
}

} // namespace hopmesh::levels
