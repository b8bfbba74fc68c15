#include "rtl_model/describe/register_rows.h"

#include "firmware/registers.h"

#include <cstdio>

namespace hopmesh::describe {

std::vector<RegisterRow> register_rows() {
  std::vector<RegisterRow> rows;
#define HM_X(name, offset, access, reset, meaning)                                                           \
  rows.push_back(                                                                                            \
      {#name, offset, Access::access, reset, std::string(#name).rfind("CAP_", 0) == 0, meaning, {}});
  HM_REGISTERS(HM_X)
#undef HM_X
  std::size_t at = 0;
  const auto row_of = [&](const std::string& name) -> RegisterRow& {
    while (rows[at].name != name) ++at;
    return rows[at];
  };
#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  row_of(#reg).fields.push_back({#field, lowest, width, Access::access, meaning});
  HM_FIELDS(HM_X)
#undef HM_X
  return rows;
}

std::vector<WindowRow> window_rows() {
  std::vector<WindowRow> rows;
#define HM_X(name, access, meaning) rows.push_back({#name, Access::access, meaning});
  HM_WINDOWS(HM_X)
#undef HM_X
  return rows;
}

std::string version_text() {
  return std::to_string(HM_VERSION_MAJOR) + "." + std::to_string(HM_VERSION_MINOR);
}

const char* name_of(Access access) {
  static const char* const names[] = {"RO", "RW", "WO", "W1C"};
  return names[static_cast<std::size_t>(access)];
}

std::string hex(std::uint32_t value, int digits) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%0*X", digits, static_cast<unsigned>(value));
  return text;
}

} // namespace hopmesh::describe
