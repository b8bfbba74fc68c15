// What is measured of a part of an array, or predicted: a row of the table is a figure. A part is an element,
// an output stage, or the rest: sequencer, detector, registers, bus.
#pragma once

#include <array>
#include <cstddef>

namespace hopmesh::machine {

enum class Part { element, stage, rest };
inline constexpr std::array<const char*, 3> part_names{"element", "stage", "rest"};

/// Cells of ECP5 and iCE40 as yosys names them; what OSU's 0.18 um library has, without wires.
enum class Figure {
  ecp5_lut4,
  ecp5_carry,
  ecp5_ff,
  ecp5_dsp,
  ice40_lut4,
  ice40_carry,
  ice40_ff,
  ice40_dsp,
  um2,
  path_ns,
  idle_pj,
  active_pj
};

struct FigureRow {
  const char *name, *words;
};
inline constexpr std::array<FigureRow, 12> all_figures{{
    {"ecp5_lut4", "LUT4 of ECP5"},
    {"ecp5_carry", "CCU2C of ECP5: carries of two bits, each in the place of two LUT4"},
    {"ecp5_ff", "flip-flops of ECP5"},
    {"ecp5_dsp", "MULT18X18D of ECP5"},
    {"ice40_lut4", "SB_LUT4 of iCE40"},
    {"ice40_carry", "SB_CARRY of iCE40"},
    {"ice40_ff", "flip-flops of iCE40"},
    {"ice40_dsp", "SB_MAC16 of iCE40"},
    {"um2", "area of the cells in OSU 0.18 um, square micrometres"},
    {"path_ns", "longest path by OpenSTA, without wires, ns"},
    {"idle_pj", "energy of a clock in which no input changes, pJ"},
    {"active_pj", "more energy of a clock in which each input bit changes with probability 1/4, pJ"},
}};

/// NaN where nothing is known.
using PartFigures = std::array<double, all_figures.size()>;
inline double figure_of(const PartFigures& part, Figure figure) {
  return part[static_cast<std::size_t>(figure)];
}

/// Of a NAND2 of that library, which is a gate equivalent.
inline constexpr double um2_a_gate = 24;

} // namespace hopmesh::machine
