/* The bit fields of the register table: a part of firmware/registers.h, which includes this file. */
#ifndef HOPMESH_FIRMWARE_REGISTER_FIELDS_H
#define HOPMESH_FIRMWARE_REGISTER_FIELDS_H

/* Fields that many registers have. */
#define HM_WHOLE_WORD(X, REGISTER, access) X(REGISTER, VALUE, 0, 32, access, "the whole word")
#define HM_FORMAT_FIELDS(X, REGISTER)                                                                        \
  X(REGISTER, WIDTH, 0, 8, RO, "bits")                                                                       \
  X(REGISTER, INTEGER_BITS, 8, 8, RO, "before the point, sign included; a signed byte")                      \
  X(REGISTER, ROUNDING, 16, 8, RO, "numbered as SystemC's sc_q_mode")                                        \
  X(REGISTER, OVERFLOW, 24, 8, RO, "numbered as SystemC's sc_o_mode")

/* X(REGISTER, FIELD, lowest bit, width, access, meaning), in the order of the registers. Bits of no field
   read as 0, and what is written there is not looked at. */
#define HM_FIELDS(X)                                                                                         \
  HM_WHOLE_WORD(X, ID, RO)                                                                                   \
  X(VERSION, MINOR, 0, 16, RO, "what was added since the major version")                                     \
  X(VERSION, MAJOR, 16, 16, RO, "what a driver has to know")                                                 \
  HM_WHOLE_WORD(X, CAP_CELLS, RO)                                                                            \
  HM_WHOLE_WORD(X, CAP_NEURONS_PER_CELL, RO)                                                                 \
  HM_WHOLE_WORD(X, CAP_LINK_WORDS, RO)                                                                       \
  HM_WHOLE_WORD(X, CAP_WEIGHT_WORDS, RO)                                                                     \
  HM_WHOLE_WORD(X, CAP_PHASES, RO)                                                                           \
  HM_WHOLE_WORD(X, CAP_SCHEDULE, RO)                                                                         \
  HM_WHOLE_WORD(X, CAP_NORMALISER, RO)                                                                       \
  HM_WHOLE_WORD(X, CAP_RECIPROCAL_BITS, RO)                                                                  \
  HM_WHOLE_WORD(X, CAP_LANES, RO)                                                                            \
  HM_WHOLE_WORD(X, CAP_BUS_BITS, RO)                                                                         \
  HM_FORMAT_FIELDS(X, CAP_FORMAT_WEIGHT)                                                                     \
  HM_FORMAT_FIELDS(X, CAP_FORMAT_BIAS)                                                                       \
  HM_FORMAT_FIELDS(X, CAP_FORMAT_DRIVE)                                                                      \
  HM_FORMAT_FIELDS(X, CAP_FORMAT_STATE)                                                                      \
  HM_FORMAT_FIELDS(X, CAP_FORMAT_LINK)                                                                       \
  HM_FORMAT_FIELDS(X, CAP_FORMAT_ACCUMULATOR)                                                                \
  HM_WHOLE_WORD(X, CAP_OUTPUT, RO)                                                                           \
  HM_WHOLE_WORD(X, CAP_ELEMENTS, RO)                                                                         \
  HM_WHOLE_WORD(X, CAP_STAGES, RO)                                                                           \
  HM_WHOLE_WORD(X, CAP_PIPELINE, RO)                                                                         \
  X(CAP_PACKING, BIAS, 0, 8, RO, "codes in a word of BIAS")                                                  \
  X(CAP_PACKING, OUTPUT, 8, 8, RO, "codes in a word of OUTPUT")                                              \
  X(CAP_PACKING, WEIGHT, 16, 8, RO, "codes in a word of WEIGHT")                                             \
  X(CAP_PACKING, MOMENTUM, 24, 8, RO, "codes in a word of MOMENTUM")                                         \
  HM_WHOLE_WORD(X, CAP_MOMENTUM_WORDS, RO)                                                                   \
  HM_WHOLE_WORD(X, CAP_SPAN, RO)                                                                             \
  HM_WHOLE_WORD(X, CAP_WINDOW_FIRST_LINK, RO)                                                                \
  HM_WHOLE_WORD(X, CAP_WINDOW_LINK, RO)                                                                      \
  HM_WHOLE_WORD(X, CAP_WINDOW_BIAS, RO)                                                                      \
  HM_WHOLE_WORD(X, CAP_WINDOW_OUTPUT, RO)                                                                    \
  HM_WHOLE_WORD(X, CAP_WINDOW_WEIGHT, RO)                                                                    \
  HM_WHOLE_WORD(X, CAP_WINDOW_MOMENTUM, RO)                                                                  \
  HM_WHOLE_WORD(X, CAP_RELAXATION, RO)                                                                       \
  X(CONTROL, START, 0, 1, WO, "begin a run")                                                                 \
  X(CONTROL, RESET, 1, 1, WO, "registers to their resets, all memories to zero")                             \
  X(CONTROL, ABORT, 2, 1, WO, "end the run with the sweep at hand")                                          \
  X(STATUS, BUSY, 0, 1, RO, "a run or a RESET is at work")                                                   \
  X(STATUS, DONE, 1, 1, RO, "a run has ended")                                                               \
  X(STATUS, CONVERGED, 2, 1, RO, "its last sweep moved no V by more than THRESHOLD, or met STOP")            \
  X(STATUS, ABORTED, 3, 1, RO, "an ABORT came while it ran")                                                 \
  X(IRQ_ENABLE, DONE, 0, 1, RW, "a run has ended")                                                           \
  X(IRQ_ENABLE, REFUSED, 1, 1, RW, "a START, RESET or ABORT came when it could not be taken")                \
  X(IRQ_STATUS, DONE, 0, 1, W1C, "a run has ended")                                                          \
  X(IRQ_STATUS, REFUSED, 1, 1, W1C, "a START, RESET or ABORT came when it could not be taken")               \
  HM_WHOLE_WORD(X, THRESHOLD, RW)                                                                            \
  HM_WHOLE_WORD(X, MAX_SWEEPS, RW)                                                                           \
  HM_WHOLE_WORD(X, SWEEPS, RO)                                                                               \
  HM_WHOLE_WORD(X, LARGEST_CHANGE, RO)                                                                       \
  HM_WHOLE_WORD(X, CYCLES_LO, RO)                                                                            \
  HM_WHOLE_WORD(X, CYCLES_HI, RO)                                                                            \
  HM_WHOLE_WORD(X, BUS_CYCLES_LO, RO)                                                                        \
  HM_WHOLE_WORD(X, BUS_CYCLES_HI, RO)                                                                        \
  X(IRQ_TEST, DONE, 0, 1, WO, "a run has ended")                                                             \
  X(IRQ_TEST, REFUSED, 1, 1, WO, "a START, RESET or ABORT came when it could not be taken")                  \
  HM_WHOLE_WORD(X, LARGEST_SUM_LO, RO)                                                                       \
  HM_WHOLE_WORD(X, LARGEST_SUM_HI, RO)                                                                       \
  HM_WHOLE_WORD(X, SUM_THRESHOLD_LO, RW)                                                                     \
  HM_WHOLE_WORD(X, SUM_THRESHOLD_HI, RW)                                                                     \
  X(STOP, BY_SUM, 0, 1, RW, "by LARGEST_SUM, not by LARGEST_CHANGE")                                         \
  X(STOP, SHARE, 8, 6, RW, "also where LARGEST_SUM is at most 2^-SHARE of the first sweep's; 0: no share")

#endif
