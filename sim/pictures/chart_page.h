// A chart as a page of its own: hovering tells a point's settings, a click keeps its command.
#pragma once

#include "sim/files/csv_table.h"

namespace hopmesh::pictures {

/// Self-contained HTML: a chart as svg_of makes it, and below it the whole table.
std::string chart_page(const std::string& title, const std::string& svg, const files::CsvTable& table);

} // namespace hopmesh::pictures
