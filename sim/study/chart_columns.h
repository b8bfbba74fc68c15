// Which columns of results.csv a chart shows unless told otherwise, and what they are called there.
#pragma once

#include "sim/files/csv_table.h"
#include "sim/study/point_row.h"

namespace hopmesh::study {

/// The last error that says anything: it is worth most.
std::string default_x(const files::CsvTable& table);
/// Time on hardware; time of this machine where integrators compete that have no hardware. The reference is
/// the judge and no competitor.
std::string default_y(const files::CsvTable& table);

/// Whether a finished point is of an integrator that has no hardware.
bool has_rivals(const files::CsvTable& table);

/// Throws input::InputError, which names `flag`, where the table has no such column.
void expect_column(const files::CsvTable& table, const std::string& flag, const std::string& name);
bool has_role(const std::string& heading, Role role);
std::string axis_label(const std::string& heading);

} // namespace hopmesh::study
