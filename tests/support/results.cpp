#include "tests/support/results.h"

#include <cstring>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace hopmesh::tests {

namespace {

template <typename T> std::vector<double> as_doubles(const std::string& bytes, std::size_t count) {
  if (bytes.size() != count * sizeof(T)) throw std::runtime_error("size and shape disagree");
  std::vector<T> raw(count);
  std::memcpy(raw.data(), bytes.data(), bytes.size());
  return {raw.begin(), raw.end()};
}

} // namespace

Array read_array(const std::filesystem::path& path) {
  const std::string bytes = content_of(path);
  if (bytes.size() < 10 || bytes.compare(0, 8, std::string("\x93NUMPY\x01\x00", 8)) != 0)
    throw std::runtime_error(path.string() + ": no npy 1.0");
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
  const std::string header = bytes.substr(10, length);
  static const std::regex shape(R"('descr': '([^']*)', 'fortran_order': False, 'shape': \(([0-9, ]*)\))");
  std::smatch part;
  if (!std::regex_search(header, part, shape)) throw std::runtime_error("header " + header);
  Array array;
  array.dtype = part[1];
  std::size_t count = 1;
  for (const std::string& size : split(part[2], ','))
    if (size.find_first_of("0123456789") != std::string::npos) array.shape.push_back(std::stoul(size));
  for (std::size_t size : array.shape) count *= size;
  const std::string data = bytes.substr(10 + length);
  array.values =
      array.dtype == "<f8" ? as_doubles<double>(data, count) : as_doubles<std::int32_t>(data, count);
  return array;
}

std::vector<double> Table::numbers(const std::string& name) const {
  std::vector<double> values;
  for (const std::string& cell : column.at(name)) values.push_back(std::stod(cell));
  return values;
}

namespace {

/// Cells of a line; commas in "quotes" part nothing.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

} // namespace

Table read_table(const std::filesystem::path& path) {
  Table table;
  const auto lines = lines_of(content_of(path));
  table.header = split(lines.at(0), ',');
  for (const std::string& name : table.header) table.column[name];
  for (std::size_t k = 1; k < lines.size(); ++k) {
    const auto cells = cells_of(lines[k]);
    if (cells.size() != table.header.size()) throw std::runtime_error("row " + lines[k]);
    for (std::size_t c = 0; c < cells.size(); ++c) table.column[table.header[c]].push_back(cells[c]);
  }
  return table;
}

nlohmann::json read_json(const std::filesystem::path& path) {
  return nlohmann::json::parse(content_of(path));
}

Market read_market(const std::filesystem::path& path) {
  std::istringstream file(content_of(path));
  Market m;
  std::getline(file, m.header);
  const bool sparse = m.header.find("coordinate") != std::string::npos;
  file >> m.rows >> m.columns;
  if (sparse) file >> m.entries;
  m.values.assign(m.rows, std::vector<double>(m.columns, 0.0));
  if (!sparse)
    for (std::size_t c = 0; c < m.columns; ++c)
      for (std::size_t r = 0; r < m.rows; ++r, ++m.entries) file >> m.values[r][c];
  for (std::size_t k = 0; sparse && k < m.entries; ++k) {
    std::size_t row = 0, column = 0;
    double value = 0;
    file >> row >> column >> value;
    m.values.at(row - 1).at(column - 1) = value;
  }
  std::string rest;
  if (!file || file >> rest) throw std::runtime_error(path.string() + ": count and content disagree");
  return m;
}

namespace {

std::string fault_of_arrays(const std::filesystem::path& folder, std::size_t steps, bool fixed) {
  const Array positions = read_array(folder / "positions.npy");
  if (positions.dtype != "<f8" || positions.shape.size() != 3 || positions.shape[0] != steps + 1 ||
      positions.shape[2] != 3)
    return "shape of positions.npy";
  if (std::filesystem::exists(folder / "outputs_raw.npy") != fixed) return "outputs_raw.npy";
  if (!fixed) return "";
  const Array outputs = read_array(folder / "outputs_raw.npy");
  if (outputs.dtype != "<i4" || outputs.shape.size() != 3 || outputs.shape[0] != steps ||
      outputs.shape[1] != positions.shape[1] || (outputs.shape[2] != 3 && outputs.shape[2] != 2))
    return "shape of outputs_raw.npy";
  return "";
}

} // namespace

std::string fault_of_results(const std::filesystem::path& folder, std::size_t steps, bool fixed) {
  try {
    std::string arrays = fault_of_arrays(folder, steps, fixed);
    if (!arrays.empty()) return arrays;
    if (read_table(folder / "steps.csv").rows() != steps) return "rows of steps.csv";
    if (read_json(folder / "stats.json").at("steps") != steps) return "steps of stats.json";
    if (read_json(folder / "manifest.json").at("step_hashes").size() != steps)
      return "hashes of manifest.json";
    const std::string glb = content_of(folder / "mesh.glb"), report = content_of(folder / "report.html");
    std::uint32_t length = 0;
    std::memcpy(&length, glb.data() + 8, 4);
    if (glb.compare(0, 4, "glTF") != 0 || length != glb.size()) return "mesh.glb";
    if (report.find("<html") == std::string::npos || report.find("</html>") == std::string::npos)
      return "report.html";
    const std::string picture = content_of(folder / "picture.svg");
    if (picture.rfind("<svg ", 0) != 0 || picture.find("</svg>") == std::string::npos) return "picture.svg";
    for (const std::string& name : names_in(folder))
      if (name.find(".part") != std::string::npos) return "left behind: " + name;
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

} // namespace hopmesh::tests
