// A job put to several arrays: everything that a host can see must be equal.
#pragma once

#include "sim/cosim/loaded_job.h"
#include "sim/levels/level.h"

namespace hopmesh::cosim {

using levels::Way;
/// The first is the one that the others are held against: it must take any job.
using Ways = std::vector<Way>;

/// All that a host sees of a job: capabilities, memories read back, the run, and each sweep of it.
struct Answer {
  std::vector<std::uint32_t> capabilities;
  Codes weight, bias, start, momentum, output;
  spec::Relaxation end;
  std::uint64_t bus_cycles = 0;
  std::vector<Codes> outputs; ///< after every sweep; empty unless asked for
  std::vector<spec::Relaxation> sweeps;
};
Answer ask(const BusArray& array, const ArrayJob& job, bool every_sweep);

/// In words, where two answers differ first; "" where they do not.
std::string unequal(const Answer& a, const Answer& b, const ArrayJob& job);

/// How one way differs from the first.
struct Mismatch {
  std::size_t way = 0;
  std::string text; ///< "" if all are equal
};

/// Arrays that were made ahead, by way; null stands for one that takes no part, or is made when its turn
/// comes.
using MadeAhead = std::vector<std::unique_ptr<levels::ArrayPort>>;
MadeAhead make_ahead(const Ways& ways, const ArrayJob& job,
                     const std::function<bool(std::size_t)>& takes_part);
Mismatch contest(const Ways& ways, const ArrayJob& job, const MadeAhead& ahead, bool every_sweep,
                 const std::function<bool(std::size_t)>& takes_part);
/// All of them, every sweep.
Mismatch contest(const Ways& ways, const ArrayJob& job);

} // namespace hopmesh::cosim
