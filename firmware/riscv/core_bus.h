/* The firmware's bus on a core that reaches the array through a bridge. */
#ifndef HOPMESH_FIRMWARE_CORE_BUS_H
#define HOPMESH_FIRMWARE_CORE_BUS_H

#include "firmware/bus.h"

/* `bus_master`: bursts are the bridge's, else the core copies them word by word. */
hm_bus hm_core_bus(uint32_t bus_master);

#endif
