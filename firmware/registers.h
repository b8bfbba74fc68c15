/* THE register table: one list that the device, the driver, the documentation and the tests all read.
   Plain C so that every one of them can. Addresses are bytes on the host bus; all registers are 32 bits wide.
 */
#ifndef HOPMESH_FIRMWARE_REGISTERS_H
#define HOPMESH_FIRMWARE_REGISTERS_H

#include <stdint.h>

#define HM_ID_VALUE 0x484F504Du /* "HOPM" */
#define HM_VERSION_VALUE 0x00010002u

/* X(NAME, offset, access, reset, meaning). Access: RO read only; RW read and write; WO reads as zero;
   W1C reads as it is, a written 1 clears the bit. A reset of 0 for a capability: set when the array is built.
 */
#define HM_REGISTERS(X)                                                                                      \
  X(ID, 0x000, RO, HM_ID_VALUE, "the letters HOPM")                                                          \
  X(VERSION, 0x004, RO, HM_VERSION_VALUE, "major << 16 | minor")                                             \
  X(CAP_CELLS, 0x008, RO, 0, "cells: free nodes of the mesh, or neurons of a network")                       \
  X(CAP_NEURONS_PER_CELL, 0x00C, RO, 0,                                                                      \
    "neurons in a cell: 3; 2 in a planar array; 1 in a network that is no mesh")                             \
  X(CAP_LINK_WORDS, 0x010, RO, 0, "words in the LINK window: two for every link")                            \
  X(CAP_WEIGHT_WORDS, 0x014, RO, 0, "words in the WEIGHT window")                                            \
  X(CAP_PHASES, 0x018, RO, 0, "phases of a sweep")                                                           \
  X(CAP_SCHEDULE, 0x01C, RO, 0, "0 coloured, 1 sequential, 2 synchronous")                                   \
  X(CAP_NORMALISER, 0x020, RO, 0, "0 prescaled rows, 1 reciprocal, 2 divider; none in a binary array")       \
  X(CAP_RECIPROCAL_BITS, 0x024, RO, 0, "width of the reciprocal's mantissa")                                 \
  X(CAP_LANES, 0x028, RO, 0, "multipliers per neuron, or element")                                           \
  X(CAP_BUS_BITS, 0x02C, RO, 0, "data width of this bus")                                                    \
  X(CAP_FORMAT_WEIGHT, 0x030, RO, 0,                                                                         \
    "format of a weight: width | integer bits << 8 | rounding << 16 | "                                      \
    "overflow << 24, modes numbered as SystemC does")                                                        \
  X(CAP_FORMAT_BIAS, 0x034, RO, 0, "format of a bias")                                                       \
  X(CAP_FORMAT_DRIVE, 0x038, RO, 0, "format of u = s / N")                                                   \
  X(CAP_FORMAT_STATE, 0x03C, RO, 0, "format of V in the output stage and in the OUTPUT window")              \
  X(CAP_FORMAT_LINK, 0x040, RO, 0, "format of V on the links")                                               \
  X(CAP_FORMAT_ACCUMULATOR, 0x044, RO, 0, "format of the input accumulator s")                               \
  X(CAP_OUTPUT, 0x048, RO, 0, "0 modified: V moves by R s / N; 1 binary: V is the sign of s")                \
  X(CAP_ELEMENTS, 0x04C, RO, 0, "elements that neurons share; 0: one a neuron")                              \
  X(CAP_STAGES, 0x050, RO, 0,                                                                                \
    "0 an output stage an element, 1 one for all; nothing where CAP_ELEMENTS is 0")                          \
  X(CAP_PIPELINE, 0x054, RO, 0, "registers inside normalise and output beyond the least")                    \
  X(CONTROL, 0x080, WO, 0, "bit 0 START, bit 1 RESET: outputs and weights to zero")                          \
  X(STATUS, 0x084, RO, 0, "bit 0 BUSY, bit 1 DONE, bit 2 CONVERGED, of the last run")                        \
  X(IRQ_ENABLE, 0x088, RW, 0, "bit 0 DONE, bit 1 REFUSED: which causes raise the interrupt line")            \
  X(IRQ_STATUS, 0x08C, W1C, 0, "bit 0 DONE, bit 1 REFUSED: a START or RESET came while busy")                \
  X(THRESHOLD, 0x090, RW, 0, "stop when no V moved by more, in units of the state's last place")             \
  X(MAX_SWEEPS, 0x094, RW, 1, "stop after so many sweeps; 0 is taken as 1")                                  \
  X(SWEEPS, 0x098, RO, 0, "sweeps of the last run")                                                          \
  X(LARGEST_CHANGE, 0x09C, RO, 0, "largest |V' - V| of the last sweep, in units of the state's last place")  \
  X(CYCLES_LO, 0x0A0, RO, 0, "cycles of the last run, from START taken to DONE, low word")                   \
  X(CYCLES_HI, 0x0A4, RO, 0, "the same, high word")                                                          \
  X(BUS_CYCLES_LO, 0x0A8, RO, 0, "cycles this bus was held since reset, low word")                           \
  X(BUS_CYCLES_HI, 0x0AC, RO, 0, "the same, high word")

/* X(NAME, base, access, meaning). Each element is a 32-bit word, two's complement, sign extended. */
#define HM_WINDOWS(X)                                                                                        \
  X(FIRST_LINK, 0x10000000, RO, "CAP_CELLS + 1 words: where each cell's neighbours begin in LINK")           \
  X(LINK, 0x20000000, RO, "CAP_LINK_WORDS words: neighbour cells, ascending, cell by cell")                  \
  X(BIAS, 0x30000000, RW, "one word a neuron: I as raw code")                                                \
  X(OUTPUT, 0x40000000, RW, "one word a neuron: V as raw code of the state")                                 \
  X(WEIGHT, 0x80000000, RW, "a row a neuron: the cell's own neurons, then each neighbour's in LINK order")

#define HM_X(name, offset, access, reset, meaning) HM_REG_##name = (offset),
enum { HM_REGISTERS(HM_X) };
#undef HM_X

#define HM_X(name, base, access, meaning) static const uint32_t HM_WINDOW_##name = (base);
HM_WINDOWS(HM_X)
#undef HM_X

enum { HM_CONTROL_START = 1, HM_CONTROL_RESET = 2 };
enum { HM_STATUS_BUSY = 1, HM_STATUS_DONE = 2, HM_STATUS_CONVERGED = 4 };
enum { HM_IRQ_DONE = 1, HM_IRQ_REFUSED = 2 };
enum { HM_SCHEDULE_COLOURED, HM_SCHEDULE_SEQUENTIAL, HM_SCHEDULE_SYNCHRONOUS };
enum { HM_STAGES_EACH, HM_STAGES_ONE };
enum { HM_OUTPUT_MODIFIED, HM_OUTPUT_BINARY };
enum { HM_NORMALISER_PRESCALED, HM_NORMALISER_RECIPROCAL, HM_NORMALISER_DIVIDER };
/* Rounding and overflow modes as the format registers number them (the order of SystemC's sc_q_mode,
 * sc_o_mode). */
enum { HM_RND, HM_RND_ZERO, HM_RND_MIN_INF, HM_RND_INF, HM_RND_CONV, HM_TRN, HM_TRN_ZERO };
enum { HM_SAT, HM_SAT_ZERO, HM_SAT_SYM, HM_WRAP };

#endif
