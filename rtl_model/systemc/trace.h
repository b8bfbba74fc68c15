// Signals of a module in a wave, under the names that rtl_model/spec/signals.h gives them.
#pragma once

#include "rtl_model/spec/signals.h"

#include <systemc>

namespace hopmesh::systemc {

inline std::string traced_name(const sc_core::sc_object& owner, const spec::Signal& signal) {
  return std::string(owner.name()) + "." + signal.name;
}

/// A register: a raw code of so many bits.
template <typename Code>
void trace_register(sc_core::sc_trace_file* file, const Code& code, const sc_core::sc_object& owner,
                    const spec::Signal& signal) {
  sc_core::sc_trace(file, code, traced_name(owner, signal), signal.width);
}

} // namespace hopmesh::systemc
