// The columns of steps.csv and results.csv as tables of a page.
#include "tests/house/page_tables.h"

namespace hopmesh::tests {

namespace {

constexpr const char* summary_words[] = {"sum", "steps at 0", "root mean square", "median", "largest"};

std::string totals_of(const levels::StepColumn& column) {
  using levels::Subject;
  const bool judged = column.subject == Subject::reference || column.subject == Subject::certainty ||
                      column.subject == Subject::arithmetic;
  const std::string within = judged ? "against_reference." : column.subject == Subject::host ? "host." : "";
  std::string cell;
  for (const levels::Total& total : column.totals)
    if (total.key)
      cell += (cell.empty() ? "" : "; ") + std::string(summary_words[static_cast<std::size_t>(total.how)]) +
              ": `" + within + total.key + "`";
  return cell;
}

std::string heading_of(const study::ResultColumn& column) {
  if (std::holds_alternative<std::vector<std::string> study::Point::*>(column.figure)) return "one an axis";
  const bool at_times = std::holds_alternative<std::vector<study::Maybe> study::PointRow::*>(column.figure);
  return "`" + std::string(column.name) + (at_times ? "@T`" : "`");
}

} // namespace

std::string step_table(const std::vector<levels::StepColumn>& columns) {
  std::string table = "| column | meaning | unit | in `stats.json` |\n|---|---|---|---|\n";
  for (const levels::StepColumn& column : columns)
    table += page_row({"`" + std::string(column.name) + "`", column.words, column.unit, totals_of(column)});
  return table;
}

std::string result_table(const std::vector<study::ResultColumn>& columns) {
  std::string table = "| column | meaning | unit |\n|---|---|---|\n";
  for (const study::ResultColumn& column : columns)
    table += page_row({heading_of(column), column.words, column.unit});
  return table;
}

} // namespace hopmesh::tests
