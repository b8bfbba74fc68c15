// The same job put to several arrays: everything that a host can see must be equal.
#pragma once

#include "sim/cosim/bus_array.h"

#include <functional>
#include <memory>
#include <string>

namespace hopmesh::cosim {

/// A bus, and with it the array behind it.
using SharedBus = std::shared_ptr<const hm_bus>;

/// One way of building an array. The first of several is the one that the others are held against: it must
/// take any job.
struct Contestant {
  std::string name;
  std::function<SharedBus(const ArrayJob&)> make; ///< null where it cannot have this array
  bool ahead = false;       ///< all arrays are made before one is used (SystemC elaborates once a process)
  std::uint64_t one_in = 1; ///< takes part in so many of the cases of a campaign
};

/// All that a host sees of a job: capabilities, memories read back, the run, and each sweep of it.
struct Answer {
  std::vector<std::uint32_t> capabilities;
  Codes weight, bias, start, output;
  spec::Relaxation end;
  std::uint64_t bus_cycles = 0;
  std::vector<Codes> outputs; ///< after every sweep; empty unless asked for
  std::vector<spec::Relaxation> sweeps;
};
Answer ask(const hm_bus& bus, const ArrayJob& job, bool every_sweep);

/// In words, where two answers differ first; "" where they do not.
std::string unequal(const Answer& a, const Answer& b, const ArrayJob& job);

/// How one contestant differs from the first.
struct Mismatch {
  std::size_t contestant = 0;
  std::string text; ///< "" if all are equal
};

/// Arrays that were made ahead, by contestant; others are made here, and null stands for one that takes no
/// part.
using MadeAhead = std::vector<SharedBus>;
MadeAhead make_ahead(const std::vector<Contestant>& contestants, const ArrayJob& job,
                     const std::function<bool(std::size_t)>& takes_part);
Mismatch contest(const std::vector<Contestant>& contestants, const ArrayJob& job, const MadeAhead& ahead,
                 bool every_sweep, const std::function<bool(std::size_t)>& takes_part);
/// All of them, every sweep.
Mismatch contest(const std::vector<Contestant>& contestants, const ArrayJob& job);

} // namespace hopmesh::cosim
