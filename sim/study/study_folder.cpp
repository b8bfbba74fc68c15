#include "sim/study/study_folder.h"

#include "sim/study/result_table.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

namespace hopmesh::study {

namespace {

/// The cells that a point's row has before anything is computed.
struct KnownCell {
  std::string name, text;
};

std::vector<KnownCell> known_cells(const Study& study, std::size_t number) {
  const Point point = point_of(study, number);
  std::vector<KnownCell> cells{{heading_of(&Point::number), std::to_string(number)},
                               {heading_of(&Point::method), point.method}};
  for (std::size_t a = 0; a < study.axes.size(); ++a) cells.push_back({study.axes[a].name, point.labels[a]});
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
  for (const KnownCell& known : known_cells(study_, number))
    if (one.text(0, known.name) != known.text)
      throw safe_.damaged(name, input::in_quotes(one.text(0, known.name)), known.text, known.name);
  const std::string outcome = one.text(0, heading_of(&PointRow::outcome)),
                    kind = one.text(0, heading_of(&PointRow::stability));
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
