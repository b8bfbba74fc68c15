// What tells the Verilog modules which array they are, and for how large a network: their parameters, and the
// facts of a network that stand at their inputs.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

#include <string>
#include <vector>

namespace hopmesh::machine {

/// Room for a network. An array has exactly what it needs; a simulated one may have more, so that one model
/// serves many networks.
struct RtlRoom {
  std::size_t taps = 1;   ///< of the longest row
  std::size_t lines = 1;  ///< of an element: taps of the longest rows of all rounds
  std::size_t rounds = 1; ///< of a sweep
  std::size_t places = 1; ///< neurons of a stage
  std::size_t neurons = 1, weights = 1, cells = 1, links = 0;
};
RtlRoom rtl_room(const spec::ArraySpec& array, const spec::Topology& topology);
/// Room for any network that a simulated array is asked for now and then, and for more in powers of two: so
/// one model serves most of them.
RtlRoom usual_room(const spec::ArraySpec& array, const RtlRoom& least = {});

struct RtlParameter {
  std::string name;
  std::uint64_t value;
};
/// Those of hm_device, but for files.
std::vector<RtlParameter> rtl_parameters(const spec::ArraySpec& array, const RtlRoom& room);

/// Of a network: the words of `facts` of hm_device.
std::vector<std::uint32_t> rtl_facts(const spec::ArraySpec& array, const spec::Topology& topology);

/// Bits that number so many things; 1 for one of them.
int index_bits(std::size_t many);

} // namespace hopmesh::machine
