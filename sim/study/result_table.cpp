#include "sim/study/result_table.h"

#include <fmt/format.h>
#include <stdexcept>

namespace hopmesh::study {

namespace {

using Labels = std::vector<std::string> Point::*;
using AtTimes = std::vector<Maybe> PointRow::*;

/// The cells of a column.
struct Write {
  files::CsvWriter& table;
  const Study& study;
  const Point& point;
  const PointRow& row;

  template <class Value> void operator()(Value Point::*member) const { table.cell(point.*member); }
  template <class Value> void operator()(Value PointRow::*member) const { table.cell(row.*member); }
  void operator()(run::Outcome PointRow::*member) const { table.cell(run::name_of(row.*member)); }
  void operator()(Stability PointRow::*member) const { table.cell(study::name_of(row.*member)); }
  void operator()(Labels member) const {
    for (const std::string& label : point.*member) table.cell(label);
  }
  void operator()(AtTimes member) const {
    const std::vector<Maybe>& values = row.*member;
    for (std::size_t k = 0; k < study.times.size(); ++k) table.cell(k < values.size() ? values[k] : Maybe());
  }
};

std::vector<std::string> headings(const ResultColumn& column, const Study& study) {
  std::vector<std::string> all;
  if (std::holds_alternative<Labels>(column.figure))
    for (const StudyAxis& axis : study.axes) all.push_back(axis.name);
  else if (std::holds_alternative<AtTimes>(column.figure))
    for (const double time : study.times) all.push_back(fmt::format("{}@{}", column.name, time));
  else
    all.emplace_back(column.name);
  return all;
}

} // namespace

const ResultColumns& result_columns() {
  static const ResultColumns columns(std::begin(all_result_columns), std::end(all_result_columns));
  return columns;
}

std::vector<std::string> result_header(const Study& study, const ResultColumns& columns) {
  std::vector<std::string> header;
  for (const ResultColumn& column : columns)
    for (const std::string& heading : headings(column, study)) header.push_back(heading);
  return header;
}

void write_result(files::CsvWriter& table, const Study& study, const Point& point, const PointRow& row,
                  const ResultColumns& columns) {
  for (const ResultColumn& column : columns) std::visit(Write{table, study, point, row}, column.figure);
  table.end_row();
}

const char* heading_of(const ResultFigure& figure) {
  for (const ResultColumn& column : all_result_columns)
    if (column.figure == figure) return column.name;
  throw std::logic_error("a member without a column of results.csv");
}

const ResultColumn* column_headed(std::string_view heading, const ResultColumns& columns) {
  const bool at_time = heading.find('@') != std::string_view::npos;
  const std::string_view name = heading.substr(0, heading.find('@'));
  for (const ResultColumn& column : columns)
    if (column.name == name && std::holds_alternative<AtTimes>(column.figure) == at_time &&
        !std::holds_alternative<Labels>(column.figure))
      return &column;
  return nullptr;
}

} // namespace hopmesh::study
