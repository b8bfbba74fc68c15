#include "tests/bench/sc_fixed_array.h"

#include <stdexcept>

namespace hopmesh::bench {

using sc_core::sc_time;
using spec::Segment;

namespace {

template <typename Fixed> spec::NumberFormat format_of() {
  const Fixed x;
  return {x.wl(), x.iwl(), static_cast<spec::Rounding>(x.q_mode()), static_cast<spec::Overflow>(x.o_mode())};
}

template <typename Fixed> void expect_format(const spec::NumberFormat& wanted) {
  if (!(format_of<Fixed>() == wanted))
    throw std::invalid_argument("the sc_fixed array is written for " + format_of<Fixed>().text() + ", not " +
                                wanted.text());
}

void expect_array(const spec::ArraySpec& a, std::size_t taps) {
  expect_format<WeightFixed>(a.formats.weight);
  expect_format<BiasFixed>(a.formats.bias);
  expect_format<DriveFixed>(a.formats.drive);
  expect_format<StateFixed>(a.formats.state);
  expect_format<LinkFixed>(a.formats.link);
  expect_format<DeltaFixed>({a.formats.state.width + 1, a.formats.state.integer_bits + 1,
                             a.formats.state.rounding, a.formats.state.overflow});
  const auto exact = spec::exact_accumulator_format(a.formats, taps), built = format_of<SumFixed>();
  if (!a.exact_accumulator || a.lanes != 1 || a.normaliser != spec::Normaliser::reciprocal ||
      a.reciprocal_bits != ReciprocalFixed().wl() || exact.width > built.width ||
      exact.fraction_bits() != built.fraction_bits())
    throw std::invalid_argument(
        "the sc_fixed array is written for an exact accumulator of up to 255 taps, one "
        "lane and a reciprocal of 18 bits");
}

template <typename Fixed> std::int32_t raw(const Fixed& x) {
  return static_cast<std::int32_t>((x << (x.wl() - x.iwl())).to_int64());
}

template <typename Fixed> Fixed from_raw(std::int32_t code) {
  Fixed x;
  x.range() = code;
  return x;
}

} // namespace

// ---- neuron

ScFixedNeuron::ScFixedNeuron(sc_core::sc_module_name name, std::size_t taps, std::size_t phase,
                             const spec::CycleModel& cycles)
    : sc_module(name), clock("clock"), segment("segment"), beat("beat"), in("in", taps), out("out"),
      change("change"), taps_(static_cast<int>(taps)),
      segment_(Segment::first_phase + static_cast<int>(phase)),
      phase_cycles_(static_cast<int>(cycles.phase[phase])), prepare_cycles_(static_cast<int>(cycles.prepare)),
      weights_(taps) {
  SC_METHOD(on_clock);
  sensitive << clock.pos();
  dont_initialize();
}

void ScFixedNeuron::load(const std::int32_t* weights_raw, std::int32_t bias_raw, std::int32_t state_raw) {
  for (std::size_t k = 0; k < weights_.size(); ++k) weights_[k] = from_raw<WeightFixed>(weights_raw[k]);
  bias_ = from_raw<BiasFixed>(bias_raw);
  state_ = from_raw<StateFixed>(state_raw);
  if (state_ > 1) state_ = 1;
  if (state_ < -1) state_ = -1;
  out.write(state_);
}

std::int32_t ScFixedNeuron::state_raw() const {
  return raw(state_);
}

// An edge ends the cycle that segment and beat show.
void ScFixedNeuron::on_clock() {
  const int now = segment.read();
  if (now == segment_) return phase_beat(beat.read());
  if (now == Segment::prepare) prepare_beat(beat.read());
}

void ScFixedNeuron::prepare_beat(int k) {
  if (k == 0) norm_ = bias_ < 0 ? -bias_ : +bias_;
  if (k < taps_) norm_ += weights_[k] < 0 ? -weights_[k] : +weights_[k];
  if (k + 1 == prepare_cycles_) divide();
}

// r = floor(2^(B + 16) / N) for N of B bits; 1 / N is then r * 2^(15 - (B + 16)), as N counts in 2^-15.
void ScFixedNeuron::divide() {
  const std::uint64_t n = norm_.range().to_uint64();
  if (n == 0) {
    reciprocal_ = 0;
    return;
  }
  const int bits = 64 - __builtin_clzll(n), exponent = bits + reciprocal_.wl() - 2;
  reciprocal_.range() = (std::uint64_t{1} << exponent) / n;
  reciprocal_shift_ = exponent - (norm_.wl() - norm_.iwl());
}

void ScFixedNeuron::phase_beat(int k) {
  if (k == 0) sum_ = bias_;
  if (k < taps_) sum_ += weights_[k] * in[k].read();
  if (k == taps_ + 1) normalise(); // its second cycle: the first multiplies, this one shifts and rounds
  if (k == taps_ + 2) bias_by_r();
  if (k + 1 == phase_cycles_) publish();
}

void ScFixedNeuron::normalise() {
  drive_ = (sum_ * reciprocal_) >> reciprocal_shift_;
  if (drive_ > 1) drive_ = 1;
  if (drive_ < -1) drive_ = -1;
}

void ScFixedNeuron::bias_by_r() {
  const BiasedFixed r = drive_ >= 0 ? 1 - state_ : 1 + state_;
  delta_ = r * drive_;
}

void ScFixedNeuron::publish() {
  state_ += delta_;
  out.write(state_);
  change.write(delta_ < 0 ? -delta_ : +delta_);
}

// ---- array

ScFixedArray::ScFixedArray(sc_core::sc_module_name name, const spec::ArraySpec& array,
                           const spec::Topology& topology)
    : sc_module(name), topology_(topology), phases_(spec::phases_of(topology_, array.schedule)),
      model_(spec::cycle_model(array, topology_, phases_)), period_(1.0 / array.clock_mhz, sc_core::SC_US),
      clock_("clock", false), segment_("segment", Segment::idle), beat_("beat", 0),
      links_("link", topology_.neurons()), changes_("change", topology_.neurons()) {
  expect_array(array, topology_.most_taps());
  SC_METHOD(toggle_clock);
  sensitive << edge_;
  dont_initialize();
  SC_METHOD(on_clock);
  sensitive << clock_.posedge_event();
  dont_initialize();
  wire();
}

void ScFixedArray::wire() {
  const std::size_t per_cell = topology_.neurons_per_cell;
  const auto phase = spec::phase_of_neurons(topology_, phases_);
  for (std::size_t i = 0; i < topology_.neurons(); ++i) {
    const std::size_t cell = i / per_cell;
    auto neuron = std::make_unique<ScFixedNeuron>(("neuron_" + std::to_string(i)).c_str(),
                                                  topology_.taps(cell), phase[i], model_);
    neuron->clock(clock_);
    neuron->segment(segment_);
    neuron->beat(beat_);
    neuron->out(links_[i]);
    neuron->change(changes_[i]);
    for (std::size_t k = 0; k < topology_.taps(cell); ++k) {
      const std::size_t source =
          k < per_cell ? cell : topology_.link_to[topology_.first_link[cell] + k / per_cell - 1];
      neuron->in[k](links_[source * per_cell + k % per_cell]);
    }
    neurons_.push_back(std::move(neuron));
  }
}

void ScFixedArray::load(const std::vector<std::int32_t>& weights, const std::vector<std::int32_t>& biases,
                        const std::vector<std::int32_t>& first) {
  const std::size_t per_cell = topology_.neurons_per_cell;
  for (std::size_t i = 0; i < neurons_.size(); ++i)
    neurons_[i]->load(&weights[topology_.row_offset(i / per_cell, i % per_cell)], biases[i], first[i]);
  sc_core::sc_start(sc_core::SC_ZERO_TIME); // until the links show it
}

void ScFixedArray::run(std::uint32_t threshold_raw, std::uint32_t max_sweeps) {
  const std::uint32_t largest = (1u << (threshold_.wl() - 1)) - 1; // any more would stop no less
  threshold_ = from_raw<DeltaFixed>(static_cast<std::int32_t>(std::min(threshold_raw, largest)));
  max_sweeps_ = std::max(max_sweeps, 1u);
  sweeps_ = 0;
  cycles_ = 0;
  running_ = true;
  edge_.notify(period_);
  while (running_) sc_core::sc_start(period_ * 4096);
}

std::vector<std::int32_t> ScFixedArray::outputs_raw() const {
  std::vector<std::int32_t> codes;
  for (const auto& neuron : neurons_) codes.push_back(neuron->state_raw());
  return codes;
}

std::uint32_t ScFixedArray::largest_change_raw() const {
  return static_cast<std::uint32_t>(raw(largest_));
}

// Rests low between runs, so that an Segment::idle array costs a neighbour in the same simulation nothing.
void ScFixedArray::toggle_clock() {
  const bool rises = !clock_.read();
  clock_ = rises;
  if (rises || running_) edge_.notify(period_ / 2);
}

int ScFixedArray::next_segment() {
  const int at = segment_.read();
  bool over = false;
  if (at == Segment::check) {
    measure_change();
    sweeps_ += 1;
    over = largest_ <= threshold_ || sweeps_ == max_sweeps_;
  }
  return spec::next_segment(model_, at, over);
}

// The first edge only takes START; every other one ends a cycle of the run.
void ScFixedArray::on_clock() {
  const int at = segment_.read(), beat = beat_.read();
  if (at != Segment::idle) cycles_ += 1;
  if (beat + 1 < static_cast<int>(spec::segment_cycles(model_, at))) {
    beat_.write(beat + 1);
    return;
  }
  const int next = next_segment();
  segment_.write(next);
  beat_.write(0);
  if (next == Segment::idle) running_ = false;
}

void ScFixedArray::measure_change() {
  largest_ = 0;
  for (const auto& change : changes_)
    if (change.read() > largest_) largest_ = change.read();
}

} // namespace hopmesh::bench
