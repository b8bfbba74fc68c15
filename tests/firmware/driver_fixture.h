// What the driver's tests share: a small mesh, the accesses of open and relax in order, and the codes to
// expect.
#pragma once

#include "tests/firmware/fake_array.h"
#include "tests/support/bus_mock.h"
#include "tests/support/firmware_mesh.h"
#include "tests/support/slow_fixed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hopmesh::tests {

/// Largest shift by which a value of this size still fits the format, found by trying.
inline int room_for(double largest, const spec::NumberFormat& f) {
  int shift = 1000;
  while (std::ldexp(largest, shift) > std::ldexp(static_cast<double>(f.max_raw()), -f.fraction_bits()))
    --shift;
  return shift;
}

class DriverTest : public testing::Test {
 protected:
  DriverTest() : DriverTest(path_springs(), {false, false, false, true}) {}
  DriverTest(const std::vector<PlainSpring>& springs, const std::vector<bool>& pinned)
      : mesh(springs, pinned, 2) {}

  /// open, in order. Bursts are as long as the buffer.
  void expect_open(const FakeArray& array) {
    bus.expect_read(HM_REG_ID, HM_ID_VALUE);
    bus.expect_read(HM_REG_VERSION, version);
    bus.expect_read(HM_REG_CAP_CELLS, mesh.mesh.cells);
    bus.expect_read(HM_REG_CAP_NEURONS_PER_CELL, mesh.mesh.components);
    const std::uint32_t links = mesh.mesh.first_link[mesh.mesh.cells];
    bus.expect_read(HM_REG_CAP_LINK_WORDS, links);
    bus.expect_read(HM_REG_CAP_WINDOW_FIRST_LINK, array.first_link);
    expect_bursts(false, array.first_link,
                  {mesh.mesh.first_link, mesh.mesh.first_link + mesh.mesh.cells + 1});
    bus.expect_read(HM_REG_CAP_WINDOW_LINK, array.link);
    expect_bursts(false, array.link, {mesh.mesh.link_to, mesh.mesh.link_to + links});
    bus.expect_read(HM_REG_CAP_PACKING, array.packing());
    bus.expect_read(HM_REG_CAP_WINDOW_BIAS, array.biases);
    bus.expect_read(HM_REG_CAP_WINDOW_OUTPUT, array.outputs);
    bus.expect_read(HM_REG_CAP_WINDOW_WEIGHT, array.weights);
    bus.expect_read(HM_REG_CAP_NORMALISER, array.normaliser);
    bus.expect_read(HM_REG_CAP_OUTPUT, array.output);
    bus.expect_read(HM_REG_CAP_FORMAT_WEIGHT, spec::format_word(array.weight));
    bus.expect_read(HM_REG_CAP_FORMAT_BIAS, spec::format_word(array.bias));
    bus.expect_read(HM_REG_CAP_FORMAT_STATE, spec::format_word(array.state));
    if (array.output == HM_OUTPUT_MOMENTUM) expect_momentum(array);
    bus.expect_write(HM_REG_IRQ_ENABLE, HM_IRQ_DONE);
  }
  /// The sequence of the page, in the places of the window.
  void expect_momentum(const FakeArray& array) {
    bus.expect_read(HM_REG_CAP_PACKING, array.packing());
    bus.expect_read(HM_REG_CAP_WINDOW_MOMENTUM, array.momentum);
    bus.expect_read(HM_REG_CAP_MOMENTUM_WORDS, array.momentum_words);
    std::vector<double> t{1}, m;
    for (std::size_t k = 0; k < std::size_t{array.momentum_words} * array.of_momentum; ++k) {
      t.push_back((1 + std::sqrt(1 + 4 * t[k] * t[k])) / 2);
      m.push_back((t[k] - 1) / t[k + 1]);
    }
    expect_bursts(true, array.momentum, packed(codes(m, 0, of_m), array.of_momentum));
  }
  int open() {
    return hm_driver_open(&driver, bus.bus(), &mesh.mesh, buffer.data(), std::uint32_t(buffer.size()));
  }

  /// relax, in order, for the network as it stands in `mesh`, one exponent for all of it.
  void expect_relax(const FakeArray& array, int shift, std::uint32_t threshold_raw, std::uint32_t max_sweeps,
                    const std::vector<std::uint32_t>& answer) {
    bus.expect_read(HM_REG_STATUS, HM_STATUS_DONE);
    expect_bursts(true, array.weights, packed(codes(mesh.weight, shift, array.weight), array.of_weight));
    expect_bursts(true, array.biases, packed(codes(mesh.bias, shift, array.bias), array.of_bias));
    expect_bursts(true, array.outputs, packed(codes(mesh.output, 0, array.state), array.of_output));
    bus.expect_write(HM_REG_THRESHOLD, threshold_raw);
    bus.expect_write(HM_REG_MAX_SWEEPS, max_sweeps);
    bus.expect_write(HM_REG_IRQ_STATUS, HM_IRQ_DONE); // left over from a run that nobody waited for
    bus.expect_write(HM_REG_CONTROL, HM_CONTROL_START);
    bus.expect_wait();
    bus.expect_write(HM_REG_IRQ_STATUS, HM_IRQ_DONE);
    bus.expect_read(HM_REG_STATUS, HM_STATUS_DONE | HM_STATUS_CONVERGED);
    bus.expect_read(HM_REG_SWEEPS, 17);
    bus.expect_read(HM_REG_CYCLES_LO, 0x89ABCDEFu);
    bus.expect_read(HM_REG_CYCLES_HI, 0x12u);
    expect_bursts(false, array.outputs, packed(answer, array.of_output));
  }
  int relax(double threshold, std::uint32_t max_sweeps) {
    return hm_driver_relax(&driver, &mesh.mesh, &mesh.network, threshold, max_sweeps, &result);
  }

  static std::vector<std::uint32_t> codes(const std::vector<double>& values, int shift,
                                          const spec::NumberFormat& f) {
    std::vector<std::uint32_t> words;
    for (double x : values) words.push_back(static_cast<std::uint32_t>(quantise_double(x, shift, f)));
    return words;
  }

  /// Codes side by side in words, the first at the low end: 8, 16 or all 32 bits of each.
  static std::vector<std::uint32_t> packed(const std::vector<std::uint32_t>& codes, std::size_t in_a_word) {
    std::vector<std::uint32_t> words;
    for (std::size_t k = 0; k < codes.size(); k += in_a_word) {
      std::uint64_t word = 0, place = 1;
      for (std::size_t j = k; j < std::min(codes.size(), k + in_a_word); ++j, place <<= 32 / in_a_word)
        word += place * (codes[j] % (std::uint64_t{1} << 32 / in_a_word));
      words.push_back(static_cast<std::uint32_t>(word));
    }
    return words;
  }

  void expect_bursts(bool write, std::uint32_t address, const std::vector<std::uint32_t>& words) {
    for (std::size_t done = 0; done < words.size(); done += buffer.size()) {
      const std::vector<std::uint32_t> part(words.begin() + done,
                                            words.begin() + std::min(words.size(), done + buffer.size()));
      const auto at = static_cast<std::uint32_t>(address + 4 * done);
      write ? bus.expect_write_burst(at, part) : bus.expect_read_burst(at, part);
    }
  }

  /// A network with the largest weight and bias given, the rest smaller, signs mixed.
  void fill(double largest_weight, double largest_bias) {
    for (std::size_t k = 0; k < mesh.weight.size(); ++k)
      mesh.weight[k] = largest_weight * (k % 2 ? -1 : 1) / (1.0 + 0.37 * k);
    for (std::size_t k = 0; k < mesh.bias.size(); ++k)
      mesh.bias[k] = largest_bias * (k % 2 ? 1 : -1) / (1.0 + k);
    for (std::size_t k = 0; k < mesh.output.size(); ++k) mesh.output[k] = -1 + 0.4 * k;
  }

  const spec::NumberFormat of_m{16, 1, spec::Rounding::rnd, spec::Overflow::sat};
  std::uint32_t version = HM_VERSION_VALUE; ///< that the array tells
  FirmwareMesh mesh;
  std::vector<std::uint32_t> buffer = std::vector<std::uint32_t>(64);
  hm_driver driver{};
  hm_relaxation result{};
  BusMock bus;
};

} // namespace hopmesh::tests
