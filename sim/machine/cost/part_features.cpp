#include "sim/machine/cost/part_features.h"

#include "rtl_model/spec/array_modes.h"

#include <algorithm>

namespace hopmesh::machine {

namespace {

using spec::Normaliser, spec::Output;

int bits_that_count_to(std::int64_t most) {
  int bits = 0;
  while (most >> bits != 0) ++bits;
  return bits;
}

/// The parameters, with what the modules make of them.
struct Widths {
  explicit Widths(const Parameters& p)
      : elements(double(p.at("ELEMENTS"))), shared(p.at("SHARED") != 0), output(Output(p.at("OUTPUT"))),
        normaliser(Normaliser(p.at("NORMALISER"))), pipeline(double(p.at("PIPELINE"))),
        synchronous(p.at("SYNCHRONOUS") != 0), weight(double(p.at("WEIGHT_BITS"))),
        bias(double(p.at("BIAS_BITS"))), sum(double(p.at("SUM_BITS"))),
        drive_fraction(double(p.at("DRIVE_FRACTION"))), state(double(p.at("STATE_BITS"))),
        link(double(p.at("LINK_BITS"))), mantissa(double(p.at("MANTISSA"))) {
    const std::int64_t fraction = std::max(p.at("WEIGHT_FRACTION"), p.at("BIAS_FRACTION"));
    const std::int64_t norm_bits = p.at("SUM_BITS") - 1 - p.at("SUM_FRACTION") + fraction;
    norm = double(norm_bits);
    shift = bits_that_count_to(norm_bits - 1);
    place = bits_that_count_to(p.at("PLACES") - 1);
    unit = drive_fraction + (output == Output::projected ? 1 : 0);
    divisor = norm + double(p.at("SUM_FRACTION") - fraction) + unit - drive_fraction;
    sources = p.count("SOURCES") ? double(p.at("SOURCES")) : shared ? 1 : elements;
  }
  bool norms() const { return output != Output::binary && normaliser != Normaliser::prescaled; }
  bool reciprocal() const { return norms() && normaliser == Normaliser::reciprocal; }
  bool divider() const { return norms() && normaliser == Normaliser::divider; }

  double elements;
  bool shared;
  Output output;
  Normaliser normaliser;
  double pipeline;
  bool synchronous;
  double weight, bias, sum, drive_fraction, state, link, mantissa;
  double norm = 0, shift = 0, place = 0, unit = 0, divisor = 0;
  double sources = 1; ///< that an element chooses a link from
};

std::vector<double> of_element(const Widths& w) {
  const double word = w.output == Output::momentum ? 2 * w.link : w.link;
  const double chosen = w.sources > 1 ? (w.sources - 1) * word : 0;
  return {1, w.weight * w.link, w.sum, w.weight + w.link, chosen + word - w.link};
}

/// Multipliers of a stage, cell by cell.
double stage_cells(const Widths& w) {
  double cells = 0;
  if (w.output == Output::modified) cells += (w.state + 1) * (w.drive_fraction + 1);
  if (w.output == Output::momentum) cells += 16 * (w.state + 1);
  if (w.reciprocal()) cells += w.sum * w.mantissa;
  return cells;
}

/// Steps of long division, each with a subtractor: of a pipeline, or one.
struct Division {
  double kept = 0, subtracted = 0;
};
Division division_of(const Widths& w) {
  if (w.reciprocal()) {
    const double one = 2 * w.norm + w.mantissa + w.shift + 2;
    if (!w.shared) return {one + w.mantissa, w.norm + 1};
    return {w.mantissa * (one - w.mantissa / 2), w.mantissa * (w.norm + 1)};
  }
  if (!w.divider()) return {};
  const double rest = std::max(w.sum, w.divisor) + 1, steps = w.unit + 1;
  if (!w.shared) return {rest + w.divisor + 2 * steps, rest};
  return {steps * (rest + w.norm + steps / 2 + 2), steps * rest};
}

/// Registers that carry a neuron beside its drive: V, and Y where there is one.
double carried(const Widths& w) {
  const double states = w.output == Output::momentum ? 2 * w.state : w.state;
  const double wait = !w.norms() ? 1 : w.reciprocal() ? 2 : w.unit + 2;
  return (wait + w.pipeline + 1) * states;
}

std::vector<double> of_stage(const Widths& w) {
  const Division division = division_of(w);
  const double kept = division.kept + carried(w) + w.sum + w.unit + w.pipeline * w.sum;
  const double adders = 3 * w.sum + 3 * w.state + w.unit;
  const double shifted = w.reciprocal() ? (w.sum + w.mantissa) * w.shift + w.norm * w.shift : 0;
  return {1, kept, stage_cells(w), adders, division.subtracted, shifted};
}

std::vector<double> of_rest(const Widths& w) {
  const double stages = w.shared ? 1 : w.elements;
  return {1, w.elements, w.shared ? w.elements * w.sum : 0, stages * (w.state + w.sum),
          w.output == Output::momentum ? w.state : 0};
}

} // namespace

std::vector<double> features_of(Part part, const Parameters& parameters) {
  const Widths w(parameters);
  if (part == Part::element) return of_element(w);
  return part == Part::stage ? of_stage(w) : of_rest(w);
}

double count_of(Part part, const Parameters& parameters) {
  if (part == Part::rest) return 1;
  const auto elements = static_cast<double>(parameters.at("ELEMENTS"));
  return part == Part::element || parameters.at("SHARED") == 0 ? elements : 1;
}

} // namespace hopmesh::machine
