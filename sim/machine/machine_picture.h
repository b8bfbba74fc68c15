// An array drawn as the machine that one would build, with its figures: elements, their memories, the output
// stage, bus, registers, detector.
#pragma once

#include "rtl_model/spec/array_spec.h"
#include "rtl_model/spec/topology.h"

namespace hopmesh::machine {

/// `scene`: whose mesh the array is built for.
std::string machine_picture(const spec::ArraySpec& array, const spec::Topology& topology,
                            const std::string& scene);

} // namespace hopmesh::machine
