// What a wave of an array shows: scopes and signals by name, and how many bits each has. Every level that can
// make a wave calls them so, and what somebody saved for a viewer fits all.
#pragma once

#include "rtl_model/spec/array_spec.h"

namespace hopmesh::spec {

struct Signal {
  const char* name;
  int width;
};

/// Of the device.
inline constexpr Signal irq_signal{"irq", 1};

/// Of the scope `sequencer`, beside the cells.
namespace sequencer_signals {
inline constexpr const char* scope = "sequencer";
inline constexpr Signal clock{"clock", 1};
inline constexpr Signal segment{"segment", 32}; ///< a number of Segment, of cycles.h
inline constexpr Signal beat{"beat", 64};       ///< cycle of the segment
inline constexpr Signal busy{"busy", 1};
inline constexpr Signal sweeps{"sweeps", 64};
inline constexpr Signal momentum{"k", 32}; ///< of a momentum array: which entry of its table the sweep takes
} // namespace sequencer_signals

/// Registers of a neuron. Of its scope `accumulator`: s and N. Of its scope `output`: u, Delta V and V, and Y
/// beside V in a momentum array.
struct NeuronSignals {
  Signal sum, norm, drive, change, state, extrapolated;
};
inline constexpr const char* accumulator_scope = "accumulator";
inline constexpr const char* output_scope = "output";

/// `built`: with the accumulator as built (built_formats).
inline NeuronSignals neuron_signals(const Formats& built, Output output = Output::modified) {
  return {{"s", built.accumulator.width},
          {"norm", 64},
          {"u", built.drive.width + (output == Output::projected ? 1 : 0)}, // which goes up to 2
          {"delta", built.state.width + 1},                                 // from -1 to 1 at most
          {"V", built.state.width},
          {"Y", built.state.width}};
}

/// Of a folded array. Of the scope of an element: the neuron whose row it adds, and its hold register, where
/// stages are shared. Of the scope of a stage: the neuron whose u it shows. Beside them stand the registers
/// of accumulators and output stages, and of each neuron V, and Y where it has one.
inline constexpr Signal worked_signal{"neuron", 32};
inline constexpr Signal held_signal{"held", 64};
inline std::string element_scope(std::size_t element) {
  return "element_" + std::to_string(element);
}
inline constexpr const char* stage_scope = "stage";

/// Scopes of the array, of a cell in it and of a neuron in that.
inline constexpr const char* cells_scope = "cells";
inline std::string cell_scope(std::size_t cell) {
  return "cell_" + std::to_string(cell);
}
inline std::string neuron_scope(std::size_t p) {
  return "neuron_" + std::to_string(p);
}

} // namespace hopmesh::spec
