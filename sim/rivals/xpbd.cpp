// Extended position-based dynamics: substeps of backward Euler, each spring a constraint of compliance 1/k
// met in turn. Springs of one colour share no node, so a colour's springs are computed together.
#include "sim/rivals/all_integrators.h"

#include <cmath>

namespace hopmesh::rivals {
namespace {

/// Springs colour by colour, as arrays. Those of weight 0 ask for nothing and are left out.
struct ColouredSprings {
  std::vector<std::uint32_t> from, to;
  std::vector<double> stiffness, rest;
  std::vector<std::size_t> colour_end;
};

// Each spring takes the first colour that neither of its nodes has yet.
std::vector<std::vector<const scene::Spring*>> colours(const Physics& physics) {
  std::vector<std::vector<bool>> taken(physics.nodes());
  std::vector<std::vector<const scene::Spring*>> result;
  for (const scene::Spring& spring : physics.springs()) {
    if (spring.weight == 0) continue;
    auto &a = taken[spring.node[0]], &b = taken[spring.node[1]];
    std::size_t colour = 0;
    while ((colour < a.size() && a[colour]) || (colour < b.size() && b[colour])) ++colour;
    for (auto* node : {&a, &b}) {
      if (node->size() <= colour) node->resize(colour + 1);
      (*node)[colour] = true;
    }
    if (result.size() <= colour) result.resize(colour + 1);
    result[colour].push_back(&spring);
  }
  return result;
}

ColouredSprings coloured(const Physics& physics) {
  ColouredSprings result;
  for (const auto& colour : colours(physics)) {
    for (const scene::Spring* spring : colour) {
      result.from.push_back(spring->node[0]);
      result.to.push_back(spring->node[1]);
      result.stiffness.push_back(2 * spring->weight);
      result.rest.push_back(spring->rest_length);
    }
    result.colour_end.push_back(result.from.size());
  }
  return result;
}

class Xpbd : public Method {
 public:
  Xpbd(const Physics& physics, double time_step, int substeps, int iterations)
      : Method("xpbd", physics, time_step), substeps_(substeps), iterations_(iterations),
        dt_(time_step / substeps), braked_(physics.slowed(dt_)), springs_(coloured(physics)),
        mobility_(physics.inverse_mass() / braked_), multiplier_(springs_.from.size()),
        compliance_(springs_.from.size()), share_(springs_.from.size()) {
    const Vector& w = mobility_;
    for (std::size_t s = 0; s < share_.size(); ++s) {
      compliance_[s] = 1 / (springs_.stiffness[s] * dt_ * dt_);
      share_[s] = 1 / (w[springs_.from[s]] + w[springs_.to[s]] + compliance_[s]);
    }
  }

 private:
  static constexpr std::size_t block_size = 64;

  void step() override {
    for (int part = 0; part < substeps_; ++part) substep();
  }

  void substep() {
    start_ = state_.position;
    state_.position += dt_ / braked_ * (state_.velocity + dt_ * physics_.external());
    std::fill(multiplier_.begin(), multiplier_.end(), 0.0);
    for (int iteration = 0; iteration < iterations_; ++iteration) sweep();
    counters_.iterations += iterations_;
    state_.velocity = (state_.position - start_) / dt_;
  }

  void sweep() {
    std::size_t begin = 0;
    for (const std::size_t end : springs_.colour_end)
      for (; begin < end; begin += std::min(block_size, end - begin))
        meet(begin, std::min(block_size, end - begin));
  }

  // Read, compute, write, one after the other: what is computed then stands in neighbouring numbers.
  void meet(std::size_t first, std::size_t count) {
    double u[3][block_size];
    const Eigen::Index nodes = physics_.nodes();
    const std::uint32_t *const from = &springs_.from[first], *const to = &springs_.to[first];
    for (int p = 0; p < 3; ++p) {
      const double* const x = state_.position.data() + p * nodes;
      for (std::size_t s = 0; s < count; ++s) u[p][s] = x[to[s]] - x[from[s]];
    }
    project(first, count, u);
    for (int p = 0; p < 3; ++p) {
      double* const x = state_.position.data() + p * nodes;
      const double* const w = mobility_.data() + p * nodes;
      for (std::size_t s = 0; s < count; ++s) {
        x[from[s]] -= w[from[s]] * u[p][s];
        x[to[s]] += w[to[s]] * u[p][s];
      }
    }
  }

  // u becomes (change of the multiplier) * (unit direction of the spring).
  void project(std::size_t first, std::size_t count, double (&u)[3][block_size]) {
    const double* const __restrict rest = &springs_.rest[first], * const __restrict share = &share_[first], * const __restrict compliance = &compliance_[first];
    double* const __restrict multiplier = &multiplier_[first];
    for (std::size_t s = 0; s < count; ++s) {
      const double square = u[0][s] * u[0][s] + u[1][s] * u[1][s] + u[2][s] * u[2][s];
      const double root = std::sqrt(square), length = root > shortest_spring ? root : shortest_spring;
      const double change = (rest[s] - length - compliance[s] * multiplier[s]) * share[s];
      const double scale = change / length;
      multiplier[s] += change;
      u[0][s] *= scale;
      u[1][s] *= scale;
      u[2][s] *= scale;
    }
  }

  const int substeps_, iterations_;
  const double dt_, braked_;
  const ColouredSprings springs_;
  const Vector mobility_; ///< inverse mass as drag leaves it
  std::vector<double> multiplier_, compliance_, share_;
  Vector start_;
};

} // namespace

std::unique_ptr<Method> xpbd(const Physics& physics, double time_step, const Options& options) {
  return std::make_unique<Xpbd>(physics, time_step, options.substeps,
                                options.iterations ? options.iterations : 1);
}

} // namespace hopmesh::rivals
