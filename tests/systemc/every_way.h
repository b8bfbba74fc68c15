// An array built in every way that changes no bit.
#pragma once

#include "tests/systemc/register_table.h"

namespace hopmesh::tests {

/// The array in each way of being built and woken.
inline std::vector<std::unique_ptr<Dut>> every_way(const spec::ArraySpec& array,
                                                   const spec::Topology& topology) {
  std::vector<std::unique_ptr<Dut>> duts;
  for (int elements : {0, 1, 5})
    for (spec::Stages stages : {spec::Stages::each, spec::Stages::one})
      for (systemc::Waking waking : {systemc::Waking::by_phase, systemc::Waking::by_clock}) {
        spec::ArraySpec a = array;
        a.elements = elements;
        a.stages = stages;
        duts.push_back(std::make_unique<Dut>(("dut" + std::to_string(duts.size())).c_str(), a, topology));
        duts.back()->device.wake(waking);
      }
  return duts;
}

} // namespace hopmesh::tests
