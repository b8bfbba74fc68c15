#include "rtl_model/systemc/register_file.h"

namespace hopmesh::systemc {

RegisterFile::RegisterFile() {
#define HM_X(name, offset, access, reset_value, meaning)                                                     \
  registers_[offset] = Register{Access::access, reset_value, reset_value, 0};
  HM_REGISTERS(HM_X)
#undef HM_X
#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  registers_[HM_REG_##reg].fields |= HM_MASK_##reg##_##field;
  HM_FIELDS(HM_X)
#undef HM_X
}

std::uint32_t RegisterFile::read(std::uint32_t offset) const {
  const Register& r = registers_.at(offset);
  return r.access == Access::WO ? 0 : r.value;
}

void RegisterFile::write(std::uint32_t offset, std::uint32_t word) {
  Register& r = registers_.at(offset);
  if (r.access == Access::RW) r.value = word & r.fields;
  if (r.access == Access::W1C) r.value &= ~word;
}

void RegisterFile::reset() {
  for (auto& [offset, r] : registers_)
    if (offset >= HM_REG_CONTROL) r.value = r.reset;
}

} // namespace hopmesh::systemc
