// What formats alone say of a motion's steps, before any array has flown: how far positions end from the
// answer of a step's own network (docs/method/theory.md, section 10). Where the search for the least array
// begins.
#pragma once

#include "sim/levels/networks/error_bound.h"
#include "sim/levels/reference_mover.h"
#include "sim/run/simulation.h"
#include "sim/scene/scene_file.h"

namespace hopmesh::study {

/// Watches a reference, and keeps the networks of a few of its steps where they are definite.
class StepBounds : public run::StepSink {
 public:
  /// `motion` is the one it is shown; both must outlive it.
  StepBounds(const levels::ReferenceMover& motion, const levels::BuiltMesh& mesh,
             const scene::Inputs& inputs);
  void step(const levels::StepRow& row, const levels::Mover& motion) override;

  /// Rms over nodes that a step's positions are off by at most on this array, the largest of the steps looked
  /// at, m; none where nothing bounds them.
  struct Metres {
    double most = 0;
    bool proved = false; ///< as levels::ErrorBound has it
  };
  std::optional<Metres> of(const scene::Inputs& inputs) const;
  std::size_t looked_at() const { return kept_.size(); }

 private:
  struct Kept {
    std::unique_ptr<levels::ErrorBounds> bounds;
    double metres; ///< rms over nodes that an rms of 1 over outputs stands for
  };

  const levels::ReferenceMover& motion_;
  const levels::BuiltMesh& mesh_;
  const reference::Order order_;
  const std::uint64_t every_;
  std::vector<Kept> kept_;
};

} // namespace hopmesh::study
