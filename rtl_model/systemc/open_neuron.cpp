#include "rtl_model/systemc/open_neuron.h"

namespace hopmesh::systemc {

OpenNeuron::OpenNeuron(const spec::ArraySpec& array, std::size_t taps)
    : path_(array, taps, 1), sums_norm_(spec::sums_norm(array)), wires_(taps, 0),
      accumulator_(sc_core::sc_gen_unique_name("open_accumulator"), path_, std::vector<std::size_t>{taps}),
      output_(sc_core::sc_gen_unique_name("open_output"), path_) {
  for (const std::int32_t& wire : wires_) accumulator_.connect(&wire);
}

// Weights behind the end of a shorter row are zeros.
void OpenNeuron::load(const spec::FiringInputs& in) {
  for (std::size_t t = 0; t < wires_.size(); ++t) {
    const bool there = t < in.weight.size();
    accumulator_.set_weight(t, there ? in.weight[t] : 0);
    wires_[t] = there ? in.link[t] : 0;
  }
  accumulator_.set_bias(in.bias);
  accumulator_.set_own_tap(in.own_tap);
  output_.load(in.state);
  output_.extrapolate(in.extrapolated);
}

spec::FiringSteps OpenNeuron::fire(const spec::FiringInputs& in) {
  load(in);
  spec::FiringSteps steps;
  if (sums_norm_) accumulator_.norm_row();
  output_.set_norm(accumulator_.norm_raw());
  accumulator_.begin_sum();
  steps.sum.push_back(accumulator_.sum_raw());
  for (std::size_t beat = 0; beat * path_.lanes < in.weight.size(); ++beat) {
    accumulator_.sum_beat(beat);
    steps.sum.push_back(accumulator_.sum_raw());
  }
  output_.normalise(accumulator_.sum_raw());
  output_.find_change(output_.drive_raw());
  output_.publish(0, in.momentum);
  steps.norm = accumulator_.norm_raw();
  const bool inverted = steps.norm != 0 && path_.normaliser == spec::Normaliser::reciprocal;
  if (inverted) steps.reciprocal = output_.reciprocal_raw(), steps.places = output_.reciprocal_places();
  steps.ratio = output_.ratio_raw();
  steps.drive = output_.drive_raw();
  steps.pull = output_.pull_raw();
  steps.product = output_.product_raw();
  steps.change = output_.change_raw();
  steps.state = static_cast<std::int32_t>(output_.state_raw());
  steps.link = output_.link_raw();
  if (path_.output == spec::Output::momentum)
    steps.extrapolated = static_cast<std::int32_t>(output_.extrapolated_raw());
  return steps;
}

} // namespace hopmesh::systemc
