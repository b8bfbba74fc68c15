// What a description tells of the registers, and what it should: the one table.
#pragma once

#include "firmware/registers.h"
#include "tests/support/files.h"

#include "place.h"
#include <optional>
#include <ostream>

namespace hopmesh::tests {

/// A register or field as a tool tells it; what a format does not say is left empty.
struct Told {
  std::string name, meaning, access;
  std::uint32_t offset = 0; ///< bytes, or the lowest bit
  std::uint32_t width = 0;  ///< of a field
  std::optional<std::uint32_t> reset;
  std::vector<Told> fields;

  bool operator==(const Told& o) const {
    return name == o.name && meaning == o.meaning && access == o.access && offset == o.offset &&
           width == o.width && reset == o.reset && fields == o.fields;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Told& t) {
  out << t.name << " " << t.access << " at " << t.offset << " width " << t.width << " reset "
      << (t.reset ? std::to_string(*t.reset) : "none") << " \"" << t.meaning << "\"";
  for (const Told& field : t.fields) out << "\n    " << field;
  return out;
}

/// The table itself.
inline std::vector<Told> table() {
  std::vector<Told> rows;
#define HM_X(name, offset, access, reset_value, meaning)                                                     \
  rows.push_back({#name, meaning, #access, offset, 0, reset_value, {}});                                     \
  if (offset >= HM_REG_CAP_CELLS && offset < HM_REG_CONTROL) rows.back().reset.reset();
  HM_REGISTERS(HM_X)
#undef HM_X
#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  for (Told & row : rows)                                                                                    \
    if (row.name == #reg) {                                                                                  \
      row.fields.push_back({#field, meaning, #access, lowest, width, row.reset, {}});                        \
      if (row.reset) row.fields.back().reset = HM_FIELD(*row.reset, reg##_##field);                          \
    }
  HM_FIELDS(HM_X)
#undef HM_X
  return rows;
}

/// The table without what a format does not say.
inline std::vector<Told> table(bool register_resets, bool field_resets, bool register_access) {
  std::vector<Told> rows = table();
  for (Told& row : rows) {
    if (!register_resets) row.reset.reset();
    if (!register_access) row.access.clear();
    for (Told& field : row.fields)
      if (!field_resets) field.reset.reset();
  }
  return rows;
}

inline std::string file_text(const std::string& ending) {
  return content_of(std::string(HOPMESH_BINARY_DIR) + "/registers/hopmesh_registers." + ending);
}

/// 0x1F, 'h1F or 31.
inline std::uint32_t number(const std::string& text) {
  if (text.rfind("'h", 0) == 0) return static_cast<std::uint32_t>(std::stoul(text.substr(2), nullptr, 16));
  return static_cast<std::uint32_t>(std::stoul(text, nullptr, 0));
}

} // namespace hopmesh::tests
