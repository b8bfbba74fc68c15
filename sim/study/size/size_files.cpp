// The least array as a file, and the table of what was tried beside it.
#include "sim/files/csv.h"
#include "sim/run/array_info.h"
#include "sim/study/size/size_report.h"

#include <fmt/format.h>

namespace hopmesh::study {

namespace {

std::string command_of(const SizeReport& r, const Setting& setting) {
  input::InputWords words = with_steps(r.order.words, r.order.steps);
  for (const std::string& word : r.sizing.overrides(setting)) words.overrides.push_back(word);
  return "hopmesh run " + text_of(words);
}

void write_row(files::CsvWriter& table, const SizeReport& r, const SizeEvidence& e) {
  table.cell(e.what).cell(e.knob);
  for (std::size_t knob = 0; knob < knob_count; ++knob) table.cell(r.sizing.text_of(e.setting, knob));
  const spec::ArraySpec array = r.sizing.array_of(e.setting);
  table.cell(run::memory_bits(*r.prepared.mesh, array).total());
  table.cell(run::multiplier_bits(*r.prepared.mesh, array));
  table.cell(name_of(e.row.outcome)).cell(e.row.error).cell(e.fails_by).cell(e.row.sweeps).cell(e.row.cycles);
  table.cell(static_cast<double>(e.row.most_cycles) / (array.clock_mhz * 1e6));
  table.cell(command_of(r, e.setting)).end_row();
}

void write_evidence(const SizeReport& r) {
  std::vector<std::string> columns{"what", "knob"};
  columns.insert(columns.end(), knob_names.begin(), knob_names.end());
  for (const char* name : {"memory_bits", "multiplier_bits", "status", "error", "fails_by", "sweeps",
                           "cycles", "slowest_step", "command"})
    columns.emplace_back(name);
  files::CsvWriter table(r.folder / "size.csv", columns);
  for (const SizeEvidence& e : r.found.evidence) write_row(table, r, e);
  table.commit();
}

} // namespace

std::string relaxation_words(const SizeReport& r) {
  std::string words;
  for (std::size_t knob : {k_threshold, k_sweeps})
    if (r.found.setting[knob] != r.found.file[knob])
      words += fmt::format(" --set {}={}", knob_names[knob], r.sizing.text_of(r.found.setting, knob));
  return words;
}

void write_size(const SizeReport& r) {
  files::write_file(
      r.folder / "size.toml",
      fmt::format("# The least array found for {} at {} m rms from the {}. With its own sweeps:{}\n{}",
                  r.order.words.scene, r.order.error, r.order.against, relaxation_words(r),
                  input::array_text(r.sizing.array_of(r.found.setting))));
  write_evidence(r);
}

} // namespace hopmesh::study
