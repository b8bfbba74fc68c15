// XML line by line: what IP-XACT and SVD share.
#pragma once

#include "rtl_model/describe/register_rows.h"

namespace hopmesh::describe {

class XmlLines {
 public:
  /// `prefix` stands before the name of every element.
  explicit XmlLines(std::string prefix) : prefix_(std::move(prefix)) {}

  void open(const std::string& name, const std::string& attributes = "") {
    text_ += indent() + "<" + prefix_ + name + attributes + ">\n";
    depth_ += 1;
  }
  void close(const std::string& name) {
    depth_ -= 1;
    text_ += indent() + "</" + prefix_ + name + ">\n";
  }
  void line(const std::string& name, const std::string& value) {
    text_ += indent() + "<" + prefix_ + name + ">" + escaped(value) + "</" + prefix_ + name + ">\n";
  }
  const std::string& text() const { return text_; }

 private:
  std::string indent() const { return std::string(2 * depth_, ' '); }
  static std::string escaped(const std::string& value) {
    std::string out;
    for (char c : value)
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return out;
  }

  const std::string prefix_;
  std::string text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  std::size_t depth_ = 0;
};

/// The word of both formats for an access. That a 1 clears a bit (W1C) stands in an element of its own.
inline const char* xml_access(Access access) {
  return access == Access::RO ? "read-only" : access == Access::WO ? "write-only" : "read-write";
}

/// What both formats tell first of a register. `offset`: as the format writes numbers.
inline void begin_register(XmlLines& xml, const RegisterRow& row, const std::string& offset) {
  xml.open("register");
  xml.line("name", row.name);
  xml.line("description", row.meaning);
  xml.line("addressOffset", offset);
  xml.line("size", "32");
  xml.line("access", xml_access(row.access));
}

/// What both formats tell first of a field.
inline void begin_field(XmlLines& xml, const FieldRow& field) {
  xml.open("field");
  xml.line("name", field.name);
  xml.line("description", field.meaning);
  xml.line("bitOffset", std::to_string(field.lowest));
}

} // namespace hopmesh::describe
