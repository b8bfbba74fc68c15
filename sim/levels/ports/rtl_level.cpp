#include "sim/levels/ports/rtl_level.h"

#include "sim/input/input_error.h"
#include "sim/levels/ports/rtl_builder.h"
#include "sim/levels/ports/rtl_port.h"
#include "sim/machine/rtl/rtl_cover.h"

namespace hopmesh::levels {

std::unique_ptr<ArrayPort> make_rtl_port(const spec::ArraySpec& array, const spec::Topology& topology,
                                         bool at_once, const std::atomic<bool>& stop) {
  if (const auto fault = machine::rtl_fault(array, topology)) {
    if (at_once) return nullptr;
    throw input::input_error("", 0, fault->key, fault->found, fault->expected);
  }
  const machine::RtlRoom room = machine::usual_room(array, machine::rtl_room(array, topology));
  const RtlLibrary* const library =
      rtl_library(array, room, at_once ? RtlBuild::never : RtlBuild::when_missing);
  if (library == nullptr) return nullptr;
  return std::make_unique<RtlPort>(*library, array, topology, room, stop);
}

void make_rtl_model(const spec::ArraySpec& array) {
  spec::Topology one_cell;
  one_cell.neurons_per_cell = 1;
  one_cell.first_link = {0, 0};
  if (const auto fault = machine::rtl_fault(array, one_cell))
    throw input::input_error("", 0, fault->key, fault->found, fault->expected);
  rtl_library(array, machine::usual_room(array), RtlBuild::when_missing);
}

} // namespace hopmesh::levels
