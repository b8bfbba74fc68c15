// Beside every step of an array: the double reference's answer to the very same step.
#pragma once

#include "firmware/relax.h"
#include "sim/levels/mover.h"
#include "sim/levels/networks/error_bound.h"
#include "sim/reference/block_sweeps.h"
#include "sim/reference/judgement.h"

namespace hopmesh::levels {

/// The order in which an array's schedule fires, with the reference's numbering (over all nodes).
reference::Order order_for(const BuiltMesh& mesh, spec::Schedule schedule);
/// An array's output stage as the reference has it. `momentum`: a table of a scene's own; empty: FISTA's, as
/// long as the array's.
reference::NeuronRule rule_of(const spec::ArraySpec& array, const std::vector<double>& momentum = {});
/// A scene's motion as the output stage of an array makes it.
reference::StepParameters motion_for(const scene::Scene& scene, const spec::ArraySpec& array);

/// How a motion's relaxations end, for ErrorBounds.
RunRules rules_of(const reference::StepParameters& motion);

/// Where a step starts from, as the reference has it; its V, numbered over all nodes, stays empty.
reference::State state_of(const StepState& state);

/// Does a network that does not come to rest swing between two states? Of what the next sweep changes, the
/// share that is still done and undone `swings` later: 1 for ever, 0 for a walk in one direction or a swing
/// that dies.
inline constexpr std::uint32_t swings = 20; ///< even
double alternation(const reference::Network& network, const reference::Order& order,
                   const reference::Vector& V, const reference::NeuronRule& rule = {});

class ReferenceCheck {
 public:
  ReferenceCheck(const scene::Scene& scene, const BuiltMesh& mesh, const spec::ArraySpec& array);

  /// Before a step: where it starts from, outputs cell by cell; accelerations [3 * nodes] of each node's own,
  /// or null.
  void begin(const StepState& state, const double* node_force);
  /// After it: the network that the firmware built about `start` and the outputs that the array came to.
  /// With several expansions it is the last one that is judged, from the array's own start of it; so it is in
  /// the incremental formulation, at the array's own scale. `last`: what the array took for it.
  ReferenceError judge(const hm_network& network, const std::vector<double>& start, double scale,
                       const hm_relaxation& last);

  /// The figures that need no rest: told_error and error_bound of a row whose step was judged last, where the
  /// network is definite and not too large.
  void certify(StepRow& row) const;
  static constexpr std::uint64_t steps_a_proof = 8;  ///< as LeftOver::steps_a_look
  static constexpr std::size_t most_proven = 30'000; ///< neurons

 private:
  reference::Vector by_node(const std::vector<double>& by_cell) const;
  /// That expansion by the reference, from its own prediction; `start` becomes its point.
  reference::Network expanded(const std::vector<double>& start, double scale, reference::Vector& V0) const;
  const reference::BlockSweeps& laid_out(const reference::Network& network);
  void find_places(const reference::Matrix& W);
  double network_difference(const reference::Network& network, const hm_network& built);
  /// Rms of what the firmware's network rests at against the rest of the reference's.
  double rest_difference(reference::Network network, const hm_network& built, const reference::Vector& rest);

  const BuiltMesh& mesh_;
  reference::StepParameters motion_;
  const bool fixed_; ///< the host computes in whole numbers
  const reference::Order order_;
  reference::State state_;
  const spec::ArraySpec array_;
  reference::Network network_;                    ///< of the last step,
  reference::Vector V_;                           ///< and the array's answer to it
  std::optional<reference::BlockNetwork> blocks_; ///< the last step's network
  std::optional<reference::BlockSweeps> sweeps_;  ///< of it
  std::vector<std::ptrdiff_t>
      place_; ///< [weights of the array]: in the reference's matrix; -1 where it has none
};

} // namespace hopmesh::levels
