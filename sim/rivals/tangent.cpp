// The linearised step: products by springs, and the inverses of its diagonal blocks.
#include "sim/rivals/tangent.h"

namespace hopmesh::rivals {

Tangent::Tangent(const Physics& physics)
    : physics_(physics), moves_(physics.inverse_mass() * physics.mass()),
      tangents_(Vector::Zero(4 * physics.pass().springs())),
      block_(Eigen::ArrayXd::Zero(6 * physics.nodes())) {}

Tangents Tangent::at(Eigen::Index first) {
  const Eigen::Index springs = physics_.pass().springs();
  double* const sideways = tangents_.data() + first;
  return {sideways, sideways + springs, sideways + 2 * springs, sideways + 3 * springs};
}

void Tangent::expand_about(In position, double inertia) {
  inertia_ = inertia;
  block_.setZero();
  block_.head(3 * physics_.nodes()) = inertia;
  physics_.pass().each_block([&](const Block& block, Eigen::Index first) {
    physics_.pass().kernel().linearise(block, physics_.nodes(), position.data(), at(first), block_.data());
  });
  invert_blocks();
}

// By cofactors: a block is inertia plus what is positive, and well conditioned.
void Tangent::invert_blocks() {
  const Eigen::Index n = physics_.nodes();
  const auto part = [&](Eigen::Index c) { return block_.segment(c * n, n); };
  const Eigen::ArrayXd xx = part(0), yy = part(1), zz = part(2), xy = part(3), xz = part(4), yz = part(5);
  const Eigen::ArrayXd cx = yy * zz - yz * yz, cy = xz * yz - xy * zz, cz = xy * yz - xz * yy;
  const Eigen::ArrayXd share = (xx * cx + xy * cy + xz * cz).inverse();
  part(0) = cx * share, part(3) = cy * share, part(4) = cz * share;
  part(1) = (xx * zz - xz * xz) * share, part(2) = (xx * yy - xy * xy) * share;
  part(5) = (xy * xz - xx * yz) * share;
}

void Tangent::multiply(In vector, Out product) {
  product = inertia_ * vector;
  physics_.pass().each_block([&](const Block& block, Eigen::Index first) {
    physics_.pass().kernel().multiply(block, at(first), physics_.nodes(), vector.data(), product.data());
  });
  product.array() *= moves_.array();
}

void Tangent::precondition(In residual, Out result) const {
  const Eigen::Index n = physics_.nodes();
  const auto part = [&](Eigen::Index c) { return block_.segment(c * n, n); };
  const auto x = residual.segment(0, n).array(), y = residual.segment(n, n).array(),
             z = residual.segment(2 * n, n).array();
  result.segment(0, n).array() = part(0) * x + part(3) * y + part(4) * z;
  result.segment(n, n).array() = part(3) * x + part(1) * y + part(5) * z;
  result.segment(2 * n, n).array() = part(4) * x + part(5) * y + part(2) * z;
  result.array() *= moves_.array();
}

} // namespace hopmesh::rivals
