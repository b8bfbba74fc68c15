/* Drives one array over a bus: learns its formats and sizes from the capability registers, writes a network
   as raw codes, starts it, waits for the interrupt, reads the outputs back. */
#ifndef HOPMESH_FIRMWARE_DRIVER_H
#define HOPMESH_FIRMWARE_DRIVER_H

#include "firmware/bus.h"
#include "firmware/quantise.h"
#include "firmware/relax.h"
#include "firmware/window.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hm_driver {
  hm_line line;     /* no bus: not opened yet */
  uint32_t version; /* of the array's registers, as VERSION holds it */
  uint32_t normaliser, output;
  hm_format weight, bias, state;
  hm_window weights, biases, outputs;
  uint32_t clipped;  /* weights and biases of the last load that did not fit their format */
  uint32_t vanished; /* those that were not 0 and became code 0 */
  int shift;         /* they were loaded times 2^shift; 0 where rows are prescaled */
} hm_driver;

/* Looks at the array behind `bus` and checks that it was built for `mesh`. `buffer` is the longest burst, 1
   word or more. HM_OK, or HM_ERROR_ID, _VERSION, _MESH, _BUS, _SPACE; with _VERSION, driver->version is what
   was found. */
int hm_driver_open(hm_driver* driver, const hm_bus* bus, const hm_mesh* mesh, uint32_t* buffer,
                   uint32_t buffer_words);

/* Relaxes network->output from where it is until no output moves by more than `threshold`, or max_sweeps.
   HM_OK, or an error of bus.h; on an error network->output is as it was, but for one while
   it is being read back (HM_ERROR_BUS then leaves it partly read). */
int hm_driver_relax(void* driver, const hm_mesh* mesh, hm_network* network, double threshold,
                    uint32_t max_sweeps, hm_relaxation* result);

#ifdef __cplusplus
}
#endif

#endif
