// Which edges a firing shows, from its numbers alone: remainders and ranges, and nobody's rounding.
#include "sim/cosim/firings/firing_edges.h"

#include "rtl_model/spec/points.h"

#include <algorithm>
#include <cstdlib>

namespace hopmesh::cosim {

namespace {

__extension__ typedef __int128 Wide;

/// Does x * 2^-places lie exactly half-way between two whole numbers?
bool is_tie(Wide x, int places) {
  if (places <= 0 || places > 120) return false;
  const Wide unit = Wide{1} << places;
  return (x & (unit - 1)) == unit / 2;
}

/// Is floor(x * 2^-places), or the next whole number where something is left, beyond the codes of a format?
/// Rounding goes to either of them, so x that lies between the last code and the next is left out.
bool overflows(Wide x, int places, const spec::NumberFormat& format) {
  if (places > 120) return false;
  const Wide floor = places > 0 ? x >> places : x * (Wide{1} << -places);
  const bool rest = places > 0 && (x & ((Wide{1} << places) - 1)) != 0;
  return floor > format.max_raw() || floor + rest < format.min_raw();
}

/// Is |x * 2^-places| above `most`?
bool is_beyond(Wide x, int places, std::int64_t most) {
  if (places > 120) return false;
  const Wide size = x < 0 ? -x : x;
  return places > 0 ? size > Wide{most} << places : size > Wide{most} >> -places;
}

/// 2^places where there are some to make room for, else 1.
Wide scale_of(int places) {
  return Wide{1} << std::max(places, 0);
}
Wide up_by(std::int64_t x, int places) {
  return x * scale_of(places);
}

class Look {
 public:
  Look(const Firing& firing, const NeuronShape& shape)
      : f_(firing), shape_(shape), points_(spec::points_of(shape.formats)),
        steps_(shape.array.output == spec::Output::projected || spec::has_momentum(shape.array)) {}

  std::uint32_t all() {
    look_at_ends();
    look_at_sums();
    look_at_drive();
    if (steps_)
      look_at_step();
    else
      note(FiringEdge::change_tie, is_tie(f_.steps.product, shape_.formats.drive.fraction_bits()));
    note(
        FiringEdge::link_tie,
        is_tie(spec::has_momentum(shape_.array) ? f_.steps.extrapolated : f_.steps.state, points_.link_down));
    return edges_;
  }

 private:
  void note(FiringEdge edge, bool shown) {
    if (shown) edges_ |= bit_of(edge);
  }

  std::int64_t sum() const { return f_.steps.sum.back(); }

  /// s, and N, in their finer unit.
  std::pair<Wide, Wide> sum_and_norm() const {
    const int sum_places = shape_.formats.accumulator.fraction_bits();
    const int norm_places =
        std::max(shape_.formats.weight.fraction_bits(), shape_.formats.bias.fraction_bits());
    const int up = norm_places - sum_places;
    return {Wide{sum()} << std::max(up, 0), Wide{f_.steps.norm} << std::max(-up, 0)};
  }

  void look_at_ends() {
    const std::int64_t one = shape_.formats.state.one_raw();
    note(FiringEdge::state_high, f_.inputs.state == one);
    note(FiringEdge::state_low, f_.inputs.state == -one);
    note(FiringEdge::sum_zero, sum() == 0);
    if (!spec::sums_norm(shape_.array)) return;
    const auto [s, n] = sum_and_norm();
    note(FiringEdge::norm_zero, n == 0);
    note(FiringEdge::sum_is_norm, n != 0 && (s == n || s == -n));
  }

  // What the register is asked to take, each time that it is written.
  void look_at_write(Wide exact, int places) {
    note(FiringEdge::sum_tie, is_tie(exact, places));
    note(FiringEdge::sum_overflow, overflows(exact, places, shape_.formats.accumulator));
  }

  void look_at_sums() {
    if (shape_.array.exact_accumulator) return;
    look_at_write(f_.inputs.bias, points_.bias_down);
    const auto lanes = static_cast<std::size_t>(shape_.array.lanes);
    for (std::size_t beat = 0; beat + 1 < f_.steps.sum.size(); ++beat) {
      Wide exact = Wide{f_.steps.sum[beat]} * (Wide{1} << points_.sum_up);
      for (std::size_t t = beat * lanes; t < std::min(f_.inputs.weight.size(), (beat + 1) * lanes); ++t)
        exact += Wide{f_.inputs.weight[t]} * f_.inputs.link[t] * (Wide{1} << points_.product_up);
      look_at_write(exact, points_.sum_up);
    }
  }

  void look_at_drive() {
    if (shape_.array.output == spec::Output::binary) return;
    const spec::NumberFormat& drive = shape_.formats.drive;
    if (!steps_) note(FiringEdge::limited, f_.steps.ratio != f_.steps.drive);
    if (shape_.array.normaliser == spec::Normaliser::prescaled)
      return look_at_shift(sum(), points_.scaled_down);
    if (f_.steps.norm == 0) return;
    const bool projected = shape_.array.output == spec::Output::projected;
    const Wide scaled = Wide{sum()} * (projected ? shape_.array.relaxation : 1);
    const int down = projected ? spec::relaxation_down : 0;
    if (shape_.array.normaliser == spec::Normaliser::reciprocal)
      return look_at_shift(scaled * f_.steps.reciprocal, static_cast<int>(f_.steps.places) + down);
    const int up = points_.ratio_up;
    const Wide s = scaled * (Wide{1} << std::max(up, 0));
    const Wide n = Wide{f_.steps.norm} << (std::max(-up, 0) + down);
    const Wide size = s < 0 ? -s : s, rest = size % n;
    note(FiringEdge::drive_tie, rest == n - rest);
    if (steps_)
      note(FiringEdge::limited, size / n + (rest > 0 ? 1 : 0) > most_drive());
    else
      note(FiringEdge::drive_overflow, s / n > drive.max_raw() || s / n < drive.min_raw());
  }

  std::int64_t most_drive() const {
    return shape_.formats.drive.one_raw() * (shape_.array.output == spec::Output::projected ? 2 : 1);
  }

  // Where the limiter comes before the rounding, no overflow mode has a say.
  void look_at_shift(Wide x, int places) {
    note(FiringEdge::drive_tie, is_tie(x, places));
    if (!steps_)
      note(FiringEdge::drive_overflow, overflows(x, places, shape_.formats.drive));
    else
      note(FiringEdge::limited, is_beyond(x, places, most_drive()));
  }

  // From V, or from Y, by u; with momentum, from there by m dV.
  void look_at_step() {
    const bool ahead = spec::has_momentum(shape_.array);
    const std::int64_t one = shape_.formats.state.one_raw();
    const std::int64_t from = ahead ? f_.inputs.extrapolated : f_.inputs.state;
    note(FiringEdge::change_tie, is_tie(f_.steps.drive, points_.step_down));
    note(FiringEdge::held,
         is_beyond(Wide{from} * scale_of(points_.step_down) + up_by(f_.steps.drive, -points_.step_down),
                   std::max(points_.step_down, 0), one));
    if (!ahead) return;
    note(FiringEdge::ahead_tie, is_tie(f_.steps.product, spec::momentum_down));
    note(FiringEdge::ahead_held,
         is_beyond(Wide{f_.steps.state} * scale_of(spec::momentum_down) + f_.steps.product,
                   spec::momentum_down, one));
  }

  const Firing& f_;
  const NeuronShape& shape_;
  const spec::Points points_;
  const bool steps_; ///< u itself is the step
  std::uint32_t edges_ = 0;
};

} // namespace

const std::vector<EdgeWords>& firing_edges() {
  static const std::vector<EdgeWords> table{
      {"norm_zero", "N = 0, or nothing else divides s"},
      {"sum_zero", "s = 0"},
      {"sum_is_norm", "s = N or s = −N, so s / N is 1 or −1"},
      {"state_high", "V = 1 before"},
      {"state_low", "V = −1 before"},
      {"sum_tie", "the accumulator is to round a number half-way between two of its codes"},
      {"sum_overflow", "the accumulator is to take a number beyond its range"},
      {"drive_tie", "u is half-way between two codes of the drive before it is rounded"},
      {"drive_overflow", "u is beyond the range of the drive before the overflow mode has its say"},
      {"limited", "the limiter changes u"},
      {"change_tie", "R · u, or u where it is the step, is half-way between two of the state's last places"},
      {"link_tie", "V after, or Y after, is half-way between two codes of the link"},
      {"held", "the step would lead beyond ±1"},
      {"ahead_tie", "m · ΔV is half-way between two of the state's last places"},
      {"ahead_held", "V after + m · ΔV would lead beyond ±1"},
  };
  return table;
}

std::uint32_t edges_of(const Firing& firing, const NeuronShape& shape) {
  return Look(firing, shape).all();
}

std::string edge_names(std::uint32_t edges) {
  std::string names;
  for (std::size_t k = 0; k < firing_edges().size(); ++k)
    if (edges >> k & 1) names += (names.empty() ? "" : "+") + std::string(firing_edges()[k].name);
  return names.empty() ? "-" : names;
}

std::optional<std::uint32_t> edges_named(const std::string& names) {
  std::uint32_t edges = 0;
  for (std::size_t at = 0; names != "-" && at <= names.size();) {
    const std::size_t end = std::min(names.find('+', at), names.size());
    const std::string name = names.substr(at, end - at);
    const auto& all = firing_edges();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const EdgeWords& e) { return e.name == name; });
    if (found == all.end()) return std::nullopt;
    edges |= std::uint32_t{1} << (found - all.begin());
    at = end + 1;
  }
  return edges;
}

} // namespace hopmesh::cosim
