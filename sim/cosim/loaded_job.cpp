#include "sim/cosim/loaded_job.h"

namespace hopmesh::cosim {

SweepBySweep::SweepBySweep(const BusArray& array, const ArrayJob& job, Each each)
    : array_(array), job_(job),
      from_the_start_(each == Each::from_the_start || spec::has_momentum(job.array)) {
  array.put_outputs(job.start);
}

spec::Relaxation SweepBySweep::next() {
  sweeps_ += 1;
  if (!from_the_start_) return array_.one_sweep();
  if (sweeps_ > 1) array_.put_outputs(job_.start);
  return array_.run(job_.threshold, sweeps_, job_.rule);
}

ArrayJob loaded_job(const hm_bus& bus, const spec::ArraySpec& array, const spec::Topology& topology,
                    Codes start) {
  const BusArray there(bus, topology);
  return {array,
          topology,
          there.weights(),
          there.biases(),
          std::move(start),
          there.threshold(),
          there.max_sweeps(),
          there.stop_rule(),
          spec::has_momentum(array) ? there.momentum(table_entries(array)) : Codes()};
}

} // namespace hopmesh::cosim
