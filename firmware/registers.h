/* THE register table: one list that the device, the driver, the documentation and the tests all read.
   Plain C so that every one of them can. Addresses are bytes on the host bus; all registers are 32 bits wide.
   `print_registers` makes descriptions for other tools of it.
 */
#ifndef HOPMESH_FIRMWARE_REGISTERS_H
#define HOPMESH_FIRMWARE_REGISTERS_H

#include "firmware/register_fields.h"

#include <stdint.h>

#define HM_ID_VALUE 0x484F504Du /* "HOPM" */
#define HM_VERSION_MAJOR 2u
#define HM_VERSION_MINOR 1u
#define HM_VERSION_VALUE (HM_VERSION_MAJOR << 16 | HM_VERSION_MINOR)

/* X(NAME, offset, access, reset, meaning). Access: RO read only; RW read and write; WO reads as zero;
   W1C reads as it is, a written 1 clears the bit. A reset of 0 for a capability: set when the array is built.
 */
#define HM_REGISTERS(X)                                                                                      \
  X(ID, 0x000, RO, HM_ID_VALUE, "the letters HOPM")                                                          \
  X(VERSION, 0x004, RO, HM_VERSION_VALUE, "of these registers; drivers refuse another MAJOR")                \
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
  X(CAP_FORMAT_WEIGHT, 0x030, RO, 0, "format of a weight")                                                   \
  X(CAP_FORMAT_BIAS, 0x034, RO, 0, "format of a bias")                                                       \
  X(CAP_FORMAT_DRIVE, 0x038, RO, 0, "format of u = s / N")                                                   \
  X(CAP_FORMAT_STATE, 0x03C, RO, 0, "format of V in the output stage and in the OUTPUT window")              \
  X(CAP_FORMAT_LINK, 0x040, RO, 0, "format of V on the links")                                               \
  X(CAP_FORMAT_ACCUMULATOR, 0x044, RO, 0, "format of the input accumulator s")                               \
  X(CAP_OUTPUT, 0x048, RO, 0,                                                                                \
    "0 modified: V moves by R s / N; 1 binary: V is the sign of s; 2 projected; 3 momentum")                 \
  X(CAP_ELEMENTS, 0x04C, RO, 0, "elements that neurons share; 0: one a neuron")                              \
  X(CAP_STAGES, 0x050, RO, 0,                                                                                \
    "0 an output stage an element, 1 one for all; nothing where CAP_ELEMENTS is 0")                          \
  X(CAP_PIPELINE, 0x054, RO, 0, "registers inside normalise and output beyond the least")                    \
  X(CAP_PACKING, 0x058, RO, 0, "codes in a word of each window that can be packed: 1, 2 or 4")               \
  X(CAP_MOMENTUM_WORDS, 0x05C, RO, 0, "words in the MOMENTUM window: 0 where the output stage has no table") \
  X(CAP_SPAN, 0x060, RO, 0, "bytes that hold registers and windows: a power of two; 0 stands for 2^32")      \
  X(CAP_WINDOW_FIRST_LINK, 0x064, RO, 0, "where the FIRST_LINK window begins; 0 if it has no words")         \
  X(CAP_WINDOW_LINK, 0x068, RO, 0, "where the LINK window begins; 0 if it has no words")                     \
  X(CAP_WINDOW_BIAS, 0x06C, RO, 0, "where the BIAS window begins; 0 if it has no words")                     \
  X(CAP_WINDOW_OUTPUT, 0x070, RO, 0, "where the OUTPUT window begins; 0 if it has no words")                 \
  X(CAP_WINDOW_WEIGHT, 0x074, RO, 0, "where the WEIGHT window begins; 0 if it has no words")                 \
  X(CAP_WINDOW_MOMENTUM, 0x078, RO, 0, "where the MOMENTUM window begins; 0 if it has no words")             \
  X(CAP_RELAXATION, 0x07C, RO, 0, "omega of a projected array, in sixteenths; 0 with another output")        \
  X(CONTROL, 0x080, WO, 0, "what the array shall do")                                                        \
  X(STATUS, 0x084, RO, 0, "what the array does, and how its last run ended")                                 \
  X(IRQ_ENABLE, 0x088, RW, 0, "which causes raise the interrupt line")                                       \
  X(IRQ_STATUS, 0x08C, W1C, 0, "what has happened since it was cleared")                                     \
  X(THRESHOLD, 0x090, RW, 0,                                                                                 \
    "stop when no V moved by more, in units of the state's last place; not by STOP")                         \
  X(MAX_SWEEPS, 0x094, RW, 1, "stop after so many sweeps; 0 is taken as 1")                                  \
  X(SWEEPS, 0x098, RO, 0, "sweeps of the last run")                                                          \
  X(LARGEST_CHANGE, 0x09C, RO, 0, "largest |V' - V| of the last sweep, in units of the state's last place")  \
  X(CYCLES_LO, 0x0A0, RO, 0,                                                                                 \
    "cycles of the last run, from START taken to DONE, low word; latches CYCLES_HI")                         \
  X(CYCLES_HI, 0x0A4, RO, 0, "the high word that belongs to the CYCLES_LO read last")                        \
  X(BUS_CYCLES_LO, 0x0A8, RO, 0, "cycles this bus was held since RESET, low word; latches BUS_CYCLES_HI")    \
  X(BUS_CYCLES_HI, 0x0AC, RO, 0, "the high word that belongs to the BUS_CYCLES_LO read last")                \
  X(IRQ_TEST, 0x0B0, WO, 0, "a written 1 sets that bit of IRQ_STATUS")                                       \
  X(LARGEST_SUM_LO, 0x0B4, RO, 0,                                                                            \
    "largest |s| of the last sweep among neurons that may still move, in units of the accumulator's last "   \
    "place, low word; latches LARGEST_SUM_HI; 0 without BY_SUM")                                             \
  X(LARGEST_SUM_HI, 0x0B8, RO, 0, "the high word that belongs to the LARGEST_SUM_LO read last")              \
  X(SUM_THRESHOLD_LO, 0x0BC, RW, 0, "with BY_SUM: stop where LARGEST_SUM is at most this, low word")         \
  X(SUM_THRESHOLD_HI, 0x0C0, RW, 0, "its high word")                                                         \
  X(STOP, 0x0C4, RW, 0, "by which measure a run stops")

/* X(NAME, access, meaning), in the order in which they lie behind the registers. Where a window begins and
   how many words it has, the capabilities tell. A code is two's complement in its part of a word. */
#define HM_WINDOWS(X)                                                                                        \
  X(FIRST_LINK, RO, "CAP_CELLS + 1 words: where each cell's neighbours begin in LINK")                       \
  X(LINK, RO, "CAP_LINK_WORDS words: neighbour cells, ascending, cell by cell")                              \
  X(BIAS, RW, "a code a neuron: I")                                                                          \
  X(OUTPUT, RW, "a code a neuron: V in the format of the state")                                             \
  X(WEIGHT, RW,                                                                                              \
    "CAP_WEIGHT_WORDS words. A row of codes a neuron: the cell's own neurons, then each neighbour's in "     \
    "LINK order")                                                                                            \
  X(MOMENTUM, RW,                                                                                            \
    "CAP_MOMENTUM_WORDS words: the table of m, a code of 16 bits an entry, 15 of them behind the point")

/* Registers lie below this byte, windows above. */
enum { HM_REGISTER_BYTES = 0x1000 };

#define HM_X(name, offset, access, reset, meaning) HM_REG_##name = (offset),
enum { HM_REGISTERS(HM_X) };
#undef HM_X

#define HM_X(reg, field, lowest, width, access, meaning) HM_SHIFT_##reg##_##field = (lowest),
enum { HM_FIELDS(HM_X) };
#undef HM_X

#define HM_X(reg, field, lowest, width, access, meaning)                                                     \
  static const uint32_t HM_MASK_##reg##_##field = 0xFFFFFFFFu >> (32 - (width)) << (lowest);
HM_FIELDS(HM_X)
#undef HM_X

/* The number that a field holds: HM_FIELD(word, STATUS_BUSY). */
#define HM_FIELD(word, name) (((word)&HM_MASK_##name) >> HM_SHIFT_##name)

enum {
  HM_CONTROL_START = 1 << HM_SHIFT_CONTROL_START,
  HM_CONTROL_RESET = 1 << HM_SHIFT_CONTROL_RESET,
  HM_CONTROL_ABORT = 1 << HM_SHIFT_CONTROL_ABORT
};
enum {
  HM_STATUS_BUSY = 1 << HM_SHIFT_STATUS_BUSY,
  HM_STATUS_DONE = 1 << HM_SHIFT_STATUS_DONE,
  HM_STATUS_CONVERGED = 1 << HM_SHIFT_STATUS_CONVERGED,
  HM_STATUS_ABORTED = 1 << HM_SHIFT_STATUS_ABORTED
};
/* Alike in IRQ_ENABLE, IRQ_STATUS and IRQ_TEST. */
enum { HM_IRQ_DONE = 1 << HM_SHIFT_IRQ_STATUS_DONE, HM_IRQ_REFUSED = 1 << HM_SHIFT_IRQ_STATUS_REFUSED };
enum { HM_SCHEDULE_COLOURED, HM_SCHEDULE_SEQUENTIAL, HM_SCHEDULE_SYNCHRONOUS };
enum { HM_STAGES_EACH, HM_STAGES_ONE };
enum { HM_OUTPUT_MODIFIED, HM_OUTPUT_BINARY, HM_OUTPUT_PROJECTED, HM_OUTPUT_MOMENTUM };
enum { HM_NORMALISER_PRESCALED, HM_NORMALISER_RECIPROCAL, HM_NORMALISER_DIVIDER };
/* Rounding and overflow modes as the format registers number them (the order of SystemC's sc_q_mode,
 * sc_o_mode). */
enum { HM_RND, HM_RND_ZERO, HM_RND_MIN_INF, HM_RND_INF, HM_RND_CONV, HM_TRN, HM_TRN_ZERO };
enum { HM_SAT, HM_SAT_ZERO, HM_SAT_SYM, HM_WRAP };

#endif
