#include "sim/cosim/loaded_job.h"

namespace hopmesh::cosim {

ArrayJob loaded_job(const hm_bus& bus, const spec::ArraySpec& array, const spec::Topology& topology,
                    Codes start) {
  const BusArray there(bus, topology);
  return {array,
          topology,
          there.weights(),
          there.biases(),
          std::move(start),
          there.threshold(),
          there.max_sweeps()};
}

} // namespace hopmesh::cosim
