#include "sim/cosim/firings/neuron_vectors.h"

#include "rtl_model/spec/array_rules.h"
#include "sim/cosim/firings/edge_search.h"
#include "sim/cosim/firings/firing_edges.h"
#include "sim/cosim/firings/run_firings.h"
#include "sim/files/output_file.h"
#include "sim/input/input_error.h"
#include "sim/levels/interrupt.h"

#include <fmt/format.h>

namespace hopmesh::cosim {

namespace {

/// Writes, and counts.
class Firings {
 public:
  Firings(const FiringsWanted& wanted, const std::string& name, const NeuronShape& shape) {
    const auto whole = std::filesystem::absolute(wanted.path);
    files::check_writable(whole.parent_path(), 1 << 20);
    writer_ = make_firing_writer(wanted.format, wanted.path, shape, {name, wanted.blank});
  }

  void add_edges(const NeuronShape& shape, const levels::OpenNeuron& neuron) {
    for (const Firing& f : edge_firings(shape, neuron)) add(f), written_.edges += 1;
  }
  void add_other(const Firing& f) {
    add(f);
    written_.others += 1;
  }
  FiringsWritten end(bool whole) {
    written_.interrupted = !whole;
    if (whole) writer_->commit();
    return written_;
  }
  std::uint64_t count() const { return written_.edges + written_.others; }

 private:
  void add(const Firing& f) {
    writer_->add(f);
    written_.shown |= f.edges;
  }

  std::unique_ptr<FiringWriter> writer_;
  FiringsWritten written_;
};

} // namespace

std::vector<std::string> open_levels() {
  std::vector<std::string> names;
  for (const levels::Level& level : levels::levels())
    if (level.open_neuron) names.push_back(level.name);
  return names;
}

FiringsWritten write_firings(const FiringsWanted& wanted, const VectorCase& a_case,
                             const levels::Level& level) {
  const NeuronShape shape(a_case.job.array, a_case.job.topology.most_taps());
  const levels::OpenNeuron neuron = level.open_neuron(shape.array, shape.taps);
  Firings firings(wanted, a_case.name, shape);
  firings.add_edges(shape, neuron);
  return firings.end(
      run_firings(a_case.job, shape, level, neuron, [&](const Firing& f) { firings.add_other(f); }));
}

FiringsWritten write_random_firings(const FiringsWanted& wanted, const spec::ArraySpec& array,
                                    const std::string& file, std::size_t taps, std::uint64_t seed,
                                    std::uint64_t count, const levels::Level& level) {
  if (const auto fault = spec::validate(array, taps))
    throw input::input_error(file, 0, fault->key, fault->found, fault->expected);
  const NeuronShape shape(array, taps);
  const levels::OpenNeuron neuron = level.open_neuron(array, taps);
  Firings firings(wanted, fmt::format("{} firings of {}, seed {}", count, array.name, seed), shape);
  firings.add_edges(shape, neuron);
  Dice dice(seed);
  for (std::uint64_t k = 0; k < count; ++k) {
    if (levels::stop_requested) return firings.end(false);
    Firing f = fired(shape, neuron, random_inputs(dice, shape, neuron));
    f.neuron = firings.count();
    firings.add_other(f);
  }
  return firings.end(true);
}

std::string missing_edges(std::uint32_t shown) {
  const std::uint32_t all = (std::uint32_t{1} << firing_edges().size()) - 1;
  return shown == all ? "" : edge_names(all & ~shown);
}

} // namespace hopmesh::cosim
