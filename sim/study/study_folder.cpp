#include "sim/study/study_folder.h"

#include "sim/study/result_table.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <map>

namespace hopmesh::study {

namespace {

/// Where a column stands; an axis may be called like any of those behind the axes.
std::size_t place_of(const std::vector<std::string>& header, const Study& study, const char* heading) {
  const auto behind_axes = header.begin() + 1 + static_cast<std::ptrdiff_t>(study.axes.size());
  return static_cast<std::size_t>(std::find(behind_axes, header.end(), heading) - header.begin());
}

/// What cells say before anything is computed, by their place.
std::map<std::size_t, std::string> known_cells(const std::vector<std::string>& header, const Study& study,
                                               std::size_t number) {
  const Point point = point_of(study, number);
  std::map<std::size_t, std::string> cells{{0, std::to_string(number)}};
  for (std::size_t a = 0; a < study.axes.size(); ++a) cells[1 + a] = point.labels[a];
  cells[place_of(header, study, heading_of(&Point::method))] = point.method;
  return cells;
}

bool is_class(const std::string& name) {
  return std::find(std::begin(stability_names), std::end(stability_names), name) != std::end(stability_names);
}

} // namespace

StudyFolder::StudyFolder(const Study& study, const std::filesystem::path& folder, std::uint64_t hash,
                         bool alone)
    : study_(study),
      safe_(folder, "points",
            {"study.hash", hash, "the results of another study, or of this one before a change",
             "a folder of its own, or the study as it was (study.toml there)"},
            result_header(study), alone) {
  files::write_once(folder / "study.toml", study.text);
  for (std::size_t n = 0; n < study_.combinations(); ++n)
    if (has(n)) row(n);
}

// A check proves that a row is as somebody wrote it, not that we did: charts and maps go by these cells.
files::CsvTable StudyFolder::row(std::size_t number) const {
  const std::string name = std::to_string(number);
  files::CsvTable one = safe_.row(name);
  const std::vector<std::string>& cells = one.rows[0];
  for (const auto& [at, text] : known_cells(one.header, study_, number))
    if (cells[at] != text) throw safe_.damaged(name, input::in_quotes(cells[at]), text, one.header[at]);
  const std::string& outcome = cells[place_of(one.header, study_, heading_of(&PointRow::outcome))];
  const std::string& kind = cells[place_of(one.header, study_, heading_of(&PointRow::stability))];
  if (!run::outcome_named(outcome))
    throw safe_.damaged(name, input::in_quotes(outcome), "how a run ends", heading_of(&PointRow::outcome));
  if (!is_class(kind))
    throw safe_.damaged(name, input::in_quotes(kind), fmt::format("{}", fmt::join(stability_names, ", ")),
                        heading_of(&PointRow::stability));
  return one;
}

std::vector<std::size_t> StudyFolder::missing() const {
  std::vector<std::size_t> numbers;
  for (std::size_t n = 0; n < study_.combinations(); ++n)
    if (!has(n)) numbers.push_back(n);
  return numbers;
}

void StudyFolder::save(const Point& point, const PointRow& row) const {
  files::CsvWriter table = safe_.writer(std::to_string(point.number));
  write_result(table, study_, point, row);
  table.commit();
}

std::map<std::string, std::size_t> StudyFolder::collect() const {
  std::map<std::string, std::size_t> count;
  const auto columns = result_header(study_);
  files::CsvWriter all(path() / "results.csv", columns);
  for (std::size_t n = 0; n < study_.combinations(); ++n) {
    const files::CsvTable one = row(n);
    for (const std::string& text : one.rows[0]) all.cell(text);
    all.end_row();
    ++count[one.text(0, heading_of(&PointRow::outcome))];
  }
  all.commit();
  return count;
}

} // namespace hopmesh::study
