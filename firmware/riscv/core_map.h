/* Where a core finds what stands beside it, and the registers of the bridge between it and the array: for the
   core's program, its linker script and whoever plays core and bridge. */
#ifndef HOPMESH_FIRMWARE_CORE_MAP_H
#define HOPMESH_FIRMWARE_CORE_MAP_H

#include <stdint.h>

#define HM_CORE_RAM 0x20000000u
#define HM_CORE_BRIDGE 0x30000000u
#define HM_CORE_ARRAY 0x40000000u
#define HM_CORE_ARRAY_MOST 0x40000000u /* bytes of the array that the core can see */

/* Offsets from HM_CORE_BRIDGE. */
enum {
  HM_BRIDGE_ERROR = 0x00,     /* read: the first error since the last look, HM_OK if there is none */
  HM_BRIDGE_WAIT = 0x04,      /* read: answers when the array's interrupt line is up; HM_OK or an error */
  HM_BRIDGE_ADDRESS = 0x08,   /* write: of the bus master's transfer, in the array */
  HM_BRIDGE_MEMORY = 0x0C,    /* write: the core's memory */
  HM_BRIDGE_TO_ARRAY = 0x10,  /* write: so many words go there; the next look at ERROR waits for them */
  HM_BRIDGE_TO_MEMORY = 0x14, /* write: and back */
  HM_BRIDGE_BYTES = 0x1000
};

#endif
