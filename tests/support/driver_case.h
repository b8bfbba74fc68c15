// A relaxation from doubles to doubles: a network on a random mesh, the array for it, the codes that it
// should get, and what the slow array makes of them. Whose bus the driver works is the caller's choice.
#pragma once

#include "tests/firmware/driver_fixture.h"
#include "tests/support/random_network.h"

#include <memory>

namespace hopmesh::tests {

/// A network in double on a random mesh, and the job that the array should get from it.
struct DriverCase {
  explicit DriverCase(std::uint64_t seed_of_case) : seed(seed_of_case), dice(seed) {
    job.topology = random_topology(dice, 30);
    job.array = random_array(dice, job.topology.most_taps());
    std::vector<PlainSpring> springs;
    for (std::uint32_t c = 0; c < job.topology.cells(); ++c)
      for (std::size_t k = job.topology.first_link[c]; k < job.topology.first_link[c + 1]; ++k)
        if (c < job.topology.link_to[k]) springs.push_back({c, job.topology.link_to[k], 1, 1});
    mesh = std::make_unique<FirmwareMesh>(springs, std::vector<bool>(job.topology.cells(), false),
                                          static_cast<std::uint32_t>(job.topology.neurons_per_cell));
    const double scale = std::ldexp(1.0, static_cast<int>(dice.between(-60, 60)));
    for (std::vector<double>* values : {&mesh->weight, &mesh->bias})
      for (double& x : *values) x = dice.one_in(4) ? 0 : scale * (2 * dice.unit() - 1);
    for (double& x : mesh->output) x = dice.one_in(4) ? double(dice.between(-1, 1)) : 2 * dice.unit() - 1;
    set_codes();
  }

  void set_codes() {
    const auto largest = [](const std::vector<double>& values) {
      double most = 0;
      for (double x : values) most = std::max(most, std::abs(x));
      return most;
    };
    const double w = largest(mesh->weight), b = largest(mesh->bias);
    const spec::Formats& f = job.array.formats;
    const bool prescaled =
        job.array.output == spec::Output::modified && job.array.normaliser == spec::Normaliser::prescaled;
    int shift = std::min(w == 0 ? 5000 : room_for(w, f.weight), b == 0 ? 5000 : room_for(b, f.bias));
    if (prescaled || shift == 5000) shift = 0;
    const spec::Topology& t = job.topology;
    for (std::size_t i = 0; i < t.neurons(); ++i) {
      const std::size_t cell = i / t.neurons_per_cell, row = t.row_offset(cell, i % t.neurons_per_cell);
      double norm = std::abs(mesh->bias[i]);
      for (std::size_t k = 0; k < t.taps(cell); ++k) norm += std::abs(mesh->weight[row + k]);
      const double divisor = prescaled && norm > 0 ? norm : 1;
      for (std::size_t k = 0; k < t.taps(cell); ++k)
        job.weight.push_back(code(mesh->weight[row + k] / divisor, shift, f.weight));
      job.bias.push_back(code(mesh->bias[i] / divisor, shift, f.bias));
      job.start.push_back(code(mesh->output[i], 0, f.state));
    }
    job.threshold = static_cast<std::uint32_t>(dice.below(4));
    job.max_sweeps = 1 + static_cast<std::uint32_t>(dice.below(8));
  }

  static std::int32_t code(double value, int shift, const spec::NumberFormat& f) {
    return static_cast<std::int32_t>(quantise_double(value, shift, f));
  }

  void relax_and_compare(const hm_bus& bus) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + describe(job));
    const ArrayResult expected = run_slow_array(job);
    std::vector<std::uint32_t> buffer(1 + dice.below(200));
    hm_driver driver;
    hm_relaxation result;
    ASSERT_EQ(hm_driver_open(&driver, &bus, &mesh->mesh, buffer.data(), std::uint32_t(buffer.size())), HM_OK);
    const double last_place = std::ldexp(1.0, -job.array.formats.state.fraction_bits());
    ASSERT_EQ(hm_driver_relax(&driver, &mesh->mesh, &mesh->network, (job.threshold + 0.5) * last_place,
                              job.max_sweeps, &result),
              HM_OK);
    EXPECT_EQ(result.sweeps, expected.sweeps);
    EXPECT_EQ(result.converged != 0, expected.converged);
    EXPECT_EQ(result.cycles, expected.cycles);
    for (std::size_t i = 0; i < mesh->output.size(); ++i)
      ASSERT_EQ(mesh->output[i], expected.output()[i] * last_place) << "neuron " << i;
  }

  const std::uint64_t seed;
  Dice dice;
  ArrayJob job;
  std::unique_ptr<FirmwareMesh> mesh;
};

} // namespace hopmesh::tests
