// What an answer to a network is held against: the same sweeps in double, and the rest.
#pragma once

#include "sim/reference/block_network.h"

namespace hopmesh::reference {

/// An answer and how it was come by.
struct Answer {
  Vector start, V;
  std::uint32_t sweeps = 0;
};

struct Judgement {
  Vector same_sweeps; ///< where the rule in double is after as many sweeps
  Vector rest;        ///< where it would come to rest
  double gap = 0;     ///< (E(V) - E(rest)) / (E(start) - E(rest)); 0 where nothing falls
};

/// Real outputs; `same_sweeps`: where the rule in double is after answer.sweeps. Where -W is positive
/// definite there is one rest, and the gap is never below 0 but for rounding. Elsewhere the rest is the one
/// that lies down from the same sweeps, or, if the answer lies below that, the one down from the answer: so
/// the gap is not negative there either.
Judgement judge_answer(const BlockNetwork& network, Vector same_sweeps, const Answer& answer);

/// Outputs are signs: there is no rest between the bounds, so the rule itself goes on, `most_sweeps` at most.
Judgement judge_signs(const Network& network, const Order& order, const Answer& answer,
                      std::uint32_t most_sweeps);

} // namespace hopmesh::reference
