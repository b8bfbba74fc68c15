// Edges are made where a formula says they are, and kept where the firing shows them.
#include "sim/cosim/firings/edge_search.h"

#include "rtl_model/spec/points.h"
#include "sim/cosim/firings/firing_edges.h"

#include <algorithm>

namespace hopmesh::cosim {

namespace {

constexpr int random_tries = 3000;

/// Makes candidates and keeps those that show an edge of which there are few.
class EdgeSearch {
 public:
  EdgeSearch(const NeuronShape& shape, const levels::OpenNeuron& neuron)
      : shape_(shape), neuron_(neuron), formats_(shape.formats), points_(spec::points_of(shape.formats)),
        one_state_(code(formats_.state.one_raw())), one_link_(code(formats_.link.one_raw())),
        found_(firing_edges().size(), 0) {}

  std::vector<Firing> all() {
    empty_rows();
    all_of_norm();
    ties_of_drive();
    walking_ones();
    ways_ahead();
    Dice dice(1);
    for (int k = 0; k < random_tries; ++k) offer(random_inputs(dice, shape_, neuron_));
    return std::move(kept_);
  }

 private:
  static std::int32_t code(std::int64_t x) { return static_cast<std::int32_t>(x); }

  /// The neuron is tap 0 of its row. Y is V unless it was made otherwise.
  void offer(spec::FiringInputs inputs) {
    if (!spec::has_momentum(shape_.array)) inputs.extrapolated = inputs.momentum = 0;
    inputs.link[0] = link_of(neuron_, spec::has_momentum(shape_.array) ? inputs.extrapolated : inputs.state);
    Firing f = fired(shape_, neuron_, std::move(inputs));
    bool wanted = false;
    for (std::size_t e = 0; e < found_.size(); ++e)
      if (f.edges >> e & 1 && found_[e] < lines_of_an_edge) wanted = true;
    if (!wanted) return;
    for (std::size_t e = 0; e < found_.size(); ++e) found_[e] += f.edges >> e & 1;
    f.neuron = kept_.size();
    kept_.push_back(std::move(f));
  }

  /// A row of zeros.
  spec::FiringInputs blank(std::int64_t state) const {
    return {std::vector<std::int32_t>(shape_.taps, 0),
            std::vector<std::int32_t>(shape_.taps, 0),
            0,
            code(state),
            0,
            code(state),
            0};
  }

  // Nothing goes in, so V stays, and its link is rounded: the odd halves are ties.
  void empty_rows() {
    for (std::int32_t v : {one_state_, -one_state_, 0}) offer(blank(v));
    const std::int64_t half = points_.link_down > 0 ? std::int64_t{1} << (points_.link_down - 1) : 1;
    for (std::int64_t v : {half, -half, 3 * half, -3 * half})
      if (std::abs(v) <= one_state_) offer(blank(v));
  }

  // Every source at the end of the box that its weight points to; then only the bias; then no source at all.
  void all_of_norm() {
    for (std::int64_t w : {formats_.weight.max_raw(), formats_.weight.min_raw(), std::int64_t{1}})
      for (int sign : {1, -1}) {
        spec::FiringInputs in = blank(sign * one_state_);
        std::fill(in.weight.begin(), in.weight.end(), code(w));
        std::fill(in.link.begin(), in.link.end(), code(w < 0 ? -sign * one_link_ : sign * one_link_));
        if (w < 0) in.state = in.extrapolated = -in.state;
        in.bias = code(sign > 0 ? formats_.bias.max_raw() : formats_.bias.min_raw());
        offer(in);
        std::fill(in.weight.begin(), in.weight.end(), 0);
        offer(in);
        in = blank(0);
        std::fill(in.weight.begin(), in.weight.end(), code(w));
        offer(in);
      }
  }

  // A tap whose source answers beside weights whose sources do not: N is a power of two with so many bits
  // that s / N ends one place behind the drive's last. Larger weights, for sums that lose places.
  void ties_of_drive() {
    const int more = formats_.drive.fraction_bits() + 1 - formats_.link.fraction_bits();
    if (shape_.taps < 2 || more > 40) return;
    for (int scale = 0; scale + 1 < formats_.weight.width; ++scale)
      for (std::int64_t odd : {1, -1, 3, -3}) {
        const std::int64_t link = odd * (std::int64_t{1} << std::max(-more, 0));
        if (std::abs(link) <= one_link_) offer_tie(std::max(more, 0), std::int64_t{1} << scale, link);
      }
  }

  // N is `weight` * 2^more.
  void offer_tie(int more, std::int64_t weight, std::int64_t link) {
    spec::FiringInputs in = blank(0);
    in.weight[1] = code(weight), in.link[1] = code(link);
    std::int64_t rest = ((std::int64_t{1} << more) - 1) * weight;
    for (std::size_t t = 0; t < shape_.taps && rest > 0; ++t) {
      if (t == 1) continue;
      in.weight[t] = code(std::min(rest, formats_.weight.max_raw()));
      rest -= in.weight[t];
    }
    if (rest == 0) offer(in);
  }

  // A single tap, powers of two: every place of a product, and u = 1/2 beside odd V.
  void walking_ones() {
    const std::size_t tap = shape_.taps > 1 ? 1 : 0;
    for (int w = formats_.weight.width - 2; w >= 0; --w)
      for (int l = formats_.link.fraction_bits(); l >= 0; --l)
        for (int sign : {1, -1})
          for (std::int32_t v : {1, -1, 0, one_state_ - 1}) {
            spec::FiringInputs in = blank(v);
            in.weight[tap] = code(std::int64_t{1} << w);
            in.link[tap] = code(sign * (std::int64_t{1} << l));
            offer(in);
          }
  }

  // With momentum. Nothing goes in, so V comes to Y: ways of few places times m of one half, and far ones.
  void ways_ahead() {
    if (!spec::has_momentum(shape_.array)) return;
    const std::int64_t half = spec::momentum_format.one_raw() / 2;
    for (std::int64_t m : {half, -half, spec::momentum_format.max_raw(), spec::momentum_format.min_raw()})
      for (std::int64_t way : {1, -1, 3, -3})
        for (std::int64_t to : {std::int64_t{0}, std::int64_t{one_state_}, -std::int64_t{one_state_}}) {
          if (std::abs(to - way) > one_state_) continue;
          spec::FiringInputs in = blank(to - way);
          in.extrapolated = code(to), in.momentum = code(m);
          offer(in);
        }
  }

  const NeuronShape& shape_;
  const levels::OpenNeuron& neuron_;
  const spec::Formats& formats_;
  const spec::Points points_;
  const std::int32_t one_state_, one_link_;
  std::vector<int> found_; ///< lines of each edge
  std::vector<Firing> kept_;
};

std::int32_t within(std::int64_t code, std::int64_t bound) {
  return static_cast<std::int32_t>(std::min(std::max(code, -bound), bound));
}

} // namespace

std::int32_t link_of(const levels::OpenNeuron& neuron, std::int32_t state) {
  return neuron({{0}, {0}, 0, state, 0, state, 0}).link;
}

Firing fired(const NeuronShape& shape, const levels::OpenNeuron& neuron, spec::FiringInputs inputs) {
  Firing f;
  f.inputs = std::move(inputs);
  f.steps = neuron(f.inputs);
  f.edges = edges_of(f, shape);
  return f;
}

std::vector<Firing> edge_firings(const NeuronShape& shape, const levels::OpenNeuron& neuron) {
  return EdgeSearch(shape, neuron).all();
}

spec::FiringInputs random_inputs(Dice& dice, const NeuronShape& shape, const levels::OpenNeuron& neuron) {
  const spec::Formats& f = shape.formats;
  const std::int64_t one = f.state.one_raw(), link_one = f.link.one_raw();
  const std::size_t taps = dice.one_in(2) ? shape.taps : 1 + dice.below(shape.taps);
  const std::uint64_t weights = dice.below(6), links = dice.below(4);
  spec::FiringInputs in;
  for (std::size_t t = 0; t < taps; ++t) {
    const std::int64_t w = weights == 0   ? f.weight.max_raw()
                           : weights == 1 ? f.weight.min_raw()
                                          : dice.code(f.weight);
    const std::int64_t toward = w < 0 ? -link_one : link_one; // as far as the weight can pull
    in.weight.push_back(static_cast<std::int32_t>(w));
    in.link.push_back(within(links == 0   ? toward
                             : links == 1 ? dice.between(-link_one, link_one)
                                          : dice.code(f.link),
                             link_one));
  }
  in.bias = static_cast<std::int32_t>(dice.code(f.bias));
  const auto output = [&] {
    return within(dice.one_in(4) ? dice.between(-1, 1) * one : dice.between(-one, one), one);
  };
  in.state = output();
  if (spec::has_momentum(shape.array)) {
    in.extrapolated = output();
    in.momentum = static_cast<std::int32_t>(dice.code(spec::momentum_format));
  }
  in.link[0] = link_of(neuron, spec::has_momentum(shape.array) ? in.extrapolated : in.state);
  return in;
}

} // namespace hopmesh::cosim
