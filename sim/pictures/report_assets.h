// The report's HTML, CSS and JavaScript, by file name: made from sim/pictures/report/ when the program is
// built.
#pragma once

#include <map>
#include <string>

namespace hopmesh::pictures {

const std::map<std::string, std::string>& report_assets();

} // namespace hopmesh::pictures
