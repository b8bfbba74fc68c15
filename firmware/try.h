/* What the driver's units share: an error goes straight back to the caller. */
#ifndef HOPMESH_FIRMWARE_TRY_H
#define HOPMESH_FIRMWARE_TRY_H

#include "firmware/bus.h"

#define TRY(call)                                                                                            \
  do {                                                                                                       \
    const int error_ = (call);                                                                               \
    if (error_ != HM_OK) return error_;                                                                      \
  } while (0)

#endif
