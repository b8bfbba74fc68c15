// Points of a study that differ only along some axes (seeds, scenes) as one: the middle, the least and the
// largest of what they come to.
#pragma once

#include "sim/files/csv_table.h"

#include <filesystem>

namespace hopmesh::study {

struct Spread {
  double least = 0, median = 0, largest = 0;
};
/// Of at least one value; of an even number the median is the mean of the two in the middle.
Spread spread_of(std::vector<double> values);

/// Where the axes of a study stand in results.csv.
struct AxisColumns {
  std::vector<std::size_t> kept, over; ///< axes that tell points apart, and those along which they are one
  std::size_t method = 0;
};
/// Throws input::InputError where `over` names no axis.
AxisColumns axis_columns(const files::CsvTable& table, const std::vector<std::string>& over);

/// Points that are one mark of a chart: equal in method and in all kept axes.
struct PointGroup {
  std::vector<std::size_t> rows;
  std::vector<std::size_t> told; ///< of these rows, those that finished and have both figures
  Spread x, y;                   ///< of the rows told
  std::size_t middle = 0;        ///< the row that is nearest to the median of x
};
/// In the order of the table.
std::vector<PointGroup> groups_of(const files::CsvTable& table, const AxisColumns& axes, const std::string& x,
                                  const std::string& y);

bool is_finished(const files::CsvTable& table, std::size_t row);

/// A row a group: method, kept axes, how many points and how many of them are told, then both figures.
void write_spread(const std::filesystem::path& file, const files::CsvTable& table, const AxisColumns& axes,
                  const std::vector<PointGroup>& groups, const std::string& x, const std::string& y);

} // namespace hopmesh::study
