// Jobs and answers -> text.
#include "sim/cosim/vectors.h"

#include <algorithm>
#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

/// The codes of a table, none where there is no table.
std::string words_text(const std::string& key, const Codes& codes) {
  return codes.empty() ? key + '\n' : fmt::format("{} {}\n", key, fmt::join(codes, " "));
}

std::string links_text(const spec::Topology& t) {
  std::string text = fmt::format("cells {}\nneurons_per_cell {}\n", t.cells(), t.neurons_per_cell);
  for (std::size_t c = 0; c < t.cells(); ++c) {
    text += fmt::format("links {}", c);
    for (std::size_t k = t.first_link[c]; k < t.first_link[c + 1]; ++k)
      text += fmt::format(" {}", t.link_to[k]);
    text += '\n';
  }
  return text;
}

// A neuron's start, bias and row.
std::string neuron_text(const ArrayJob& job, std::size_t neuron) {
  const spec::Topology& t = job.topology;
  const auto n = static_cast<std::size_t>(t.neurons_per_cell);
  std::string text = fmt::format("neuron {} {} {}", neuron, job.start[neuron], job.bias[neuron]);
  const std::size_t row = t.row_offset(neuron / n, neuron % n);
  for (std::size_t tap = 0; tap < t.taps(neuron / n); ++tap)
    text += fmt::format(" {}", job.weight[row + tap]);
  return text + '\n';
}

} // namespace

VectorWriter::VectorWriter(const std::filesystem::path& path, spec::ArrayTable table)
    : file_(path), table_(table) {
  file_.write(fmt::format("{}\n", vectors_header));
}

void VectorWriter::comment(const std::string& text) {
  std::string line = "# " + text;
  std::replace(line.begin(), line.end(), '\n', ' ');
  file_.write(line + '\n');
}

void VectorWriter::add(const VectorCase& a_case, const hm_bus* bus) {
  write_job(a_case);
  if (bus)
    write_answers(a_case.job, *bus);
  else
    file_.write("?\n");
}

void VectorWriter::write_job(const VectorCase& a_case) {
  const ArrayJob& job = a_case.job;
  file_.write(fmt::format("\ncase {}\n", a_case.name));
  file_.write(array_lines(job.array, job.topology.most_taps(), table_));
  file_.write(links_text(job.topology));
  file_.write(fmt::format("threshold {}\nmax_sweeps {}\n", job.threshold, job.max_sweeps));
  file_.write(fmt::format("stop {}\nshare {}\nsum_threshold {}\n", job.rule.by_sum ? "sum" : "change",
                          job.rule.share, job.rule.floor));
  file_.write(words_text("momentum", job.momentum));
  for (std::size_t k = 0; k < job.topology.neurons(); ++k) file_.write(neuron_text(job, k));
  const spec::Phases phases = spec::phases_of(job.topology, job.array.schedule);
  file_.write(fmt::format("phases {}\n", phases.size()));
  for (std::size_t k = 0; k < phases.size(); ++k)
    file_.write(fmt::format("phase {} {}\n", k, fmt::join(phases[k], " ")));
  file_.write("answers\n");
}

// The whole run says how many sweeps there are; the same sweeps one by one, what each phase left.
void VectorWriter::write_answers(const ArrayJob& job, const hm_bus& bus) {
  const Timing timing(job);
  const BusArray array(bus, job.topology);
  load(array, job);
  const spec::Relaxation end = run_whole(array, job);
  SweepBySweep sweeps(array, job);
  for (std::uint64_t sweep = 1; sweep <= end.sweeps; ++sweep) {
    sweeps.next();
    const Codes after = array.outputs();
    for (std::size_t k = 0; k < timing.phases.size(); ++k) {
      std::string line = fmt::format("fire {} {} {}", sweep, k, timing.published(sweep, k));
      for (std::uint32_t neuron : timing.phases[k]) line += fmt::format(" {}", after[neuron]);
      file_.write(line + '\n');
    }
  }
  file_.write(fmt::format("end {} {:d} {} {} {}\n", end.sweeps, end.converged, end.largest_change,
                          end.largest_sum, end.cycles));
}

} // namespace hopmesh::cosim
