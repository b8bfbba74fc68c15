#include "sim/machine/silicon.h"

namespace hopmesh::machine {

namespace {

std::uint64_t width_of(const spec::NumberFormat& format) {
  return static_cast<std::uint64_t>(format.width);
}

std::uint64_t sum_width(const spec::ArraySpec& array, const spec::Topology& topology) {
  return width_of(spec::accumulator_format(array, topology.most_taps()));
}

/// Is N divided by, and not its reciprocal multiplied with?
bool divides_by_norm(const spec::ArraySpec& array) {
  return spec::sums_norm(array) && !spec::has_reciprocal(array);
}

} // namespace

Parts parts_of(const spec::ArraySpec& array, const spec::Topology& topology) {
  const bool folded = spec::is_folded(array);
  Parts parts;
  parts.accumulators = folded ? static_cast<std::uint64_t>(array.elements) : topology.neurons();
  parts.multipliers = parts.accumulators * static_cast<std::uint64_t>(array.lanes);
  parts.stages = spec::shares_stage(array) ? 1 : parts.accumulators;
  parts.link_memories = folded ? parts.accumulators : 1;
  parts.points = spec::has_momentum(array) ? 2 : 1;
  parts.link_banks = folded && array.schedule == spec::Schedule::synchronous ? 2 : 1;
  return parts;
}

// N reaches what bounds s, which the exact accumulator has room for beside its sign; |w_ii| what one weight
// can be. (Without the bias, N of a momentum array may be a bit narrower; its register is that of the
// others.)
int norm_bits(const spec::ArraySpec& array, const spec::Topology& topology) {
  const spec::Formats& f = array.formats;
  const int finest = std::max(f.weight.fraction_bits(), f.bias.fraction_bits());
  if (array.output == spec::Output::projected) return f.weight.integer_bits + finest;
  const int whole = spec::exact_accumulator_format(f, topology.most_taps()).integer_bits - 1;
  return whole + finest;
}

int reciprocal_bits(const spec::ArraySpec& array, const spec::Topology& topology) {
  int shift = 1; // bits that count from 0 to those of N
  while (norm_bits(array, topology) >> shift != 0) ++shift;
  return array.reciprocal_bits + shift;
}

MemoryBits memory_bits(const spec::ArraySpec& array, const spec::Topology& topology) {
  const spec::Formats& f = array.formats;
  const Parts parts = parts_of(array, topology);
  const std::uint64_t neurons = topology.neurons();
  MemoryBits bits;
  bits.weights = topology.weight_words() * width_of(f.weight);
  bits.biases = neurons * width_of(f.bias);
  bits.states = neurons * width_of(f.state) * parts.points;
  const std::uint64_t shown = spec::is_folded(array) ? parts.points : 1; // a restart chooses between both
  bits.links = neurons * width_of(f.link) * parts.link_memories * parts.link_banks * shown;
  if (spec::has_momentum(array))
    bits.momentum = static_cast<std::uint64_t>(array.momentum_entries) * width_of(spec::momentum_format);
  bits.sums = parts.accumulators * sum_width(array, topology) * (spec::shares_stage(array) ? 2 : 1);
  if (!spec::sums_norm(array)) return bits;
  const std::uint64_t kept = spec::is_folded(array) && divides_by_norm(array) ? neurons : 0;
  bits.norms = (parts.accumulators + kept) * static_cast<std::uint64_t>(norm_bits(array, topology));
  if (spec::has_reciprocal(array))
    bits.reciprocals = neurons * static_cast<std::uint64_t>(reciprocal_bits(array, topology));
  return bits;
}

MultiplierBits multiplier_bits(const spec::ArraySpec& array, const spec::Topology& topology) {
  const spec::Formats& f = array.formats;
  const Parts parts = parts_of(array, topology);
  MultiplierBits bits;
  bits.sums = parts.multipliers * width_of(f.weight) * width_of(f.link);
  if (array.output == spec::Output::binary) return bits; // a sign multiplies nothing
  if (array.output == spec::Output::modified)
    bits.outputs = parts.stages * width_of(f.state) * width_of(f.drive);
  if (spec::has_momentum(array)) // a change may be as large as 2
    bits.outputs = parts.stages * (width_of(f.state) + 1) * width_of(spec::momentum_format);
  if (spec::has_reciprocal(array))
    bits.normalisers =
        parts.stages * sum_width(array, topology) * static_cast<std::uint64_t>(array.reciprocal_bits);
  return bits;
}

// A quotient has a bit for each place of the drive and one for the unit, with `projected` one for 2; a
// reciprocal has those of its mantissa.
std::uint64_t divider_bits(const spec::ArraySpec& array, const spec::Topology& topology) {
  if (!spec::sums_norm(array)) return 0;
  const int quotient = spec::has_reciprocal(array) ? array.reciprocal_bits
                                                   : array.formats.drive.fraction_bits() +
                                                         (array.output == spec::Output::projected ? 2 : 1);
  const int rows = spec::shares_stage(array) ? quotient : 1;
  return parts_of(array, topology).stages * static_cast<std::uint64_t>(rows * norm_bits(array, topology));
}

} // namespace hopmesh::machine
