// Corrections of an array's answer by its residual in double (docs/method/theory.md, section 9), for networks
// that no step makes: the array keeps its weights and answers to what is left as a bias.
#pragma once

#include "sim/reference/refinement.h"

#include <functional>

namespace hopmesh::levels {

class Corrections {
 public:
  /// What the array comes to from these outputs beside such biases, in units of the network's.
  using Asked = std::function<Eigen::VectorXd(const Eigen::VectorXd& bias, const Eigen::VectorXd& output)>;

  /// `room`: the largest bias that the array can take beside its weights. The network must outlive it.
  Corrections(const reference::Network& network, double room, Asked ask);

  /// V0 and what the array made of it tell how far a residual moves outputs.
  void learn_from(const Eigen::VectorXd& V0, const Eigen::VectorXd& V);
  /// Another correction of V, in the box; false, and V as it was, where nothing is left, or the energy would
  /// rise, or what would change is the rounding of doubles.
  bool correct(Eigen::VectorXd& V);
  std::uint32_t made() const { return made_.corrections; }
  std::uint32_t refused() const { return made_.refused; }
  /// Largest |s| of neurons that may still move, over the largest |I|.
  double residual(const Eigen::VectorXd& V) const;

 private:
  Eigen::VectorXd change_for(const Eigen::VectorXd& V, const Eigen::VectorXd& residual);
  void hold(const Eigen::VectorXd& V, const Eigen::VectorXd& residual, Eigen::VectorXd& bias,
            Eigen::VectorXd& output) const;

  const reference::Network& network_;
  const double room_;
  const Asked ask_;
  double softness_ = 0; ///< outputs over residual, as the last answer had it; 0: nothing is known
  reference::Refinement made_;
};

} // namespace hopmesh::levels
