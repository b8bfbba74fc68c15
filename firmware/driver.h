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

/* How a relaxation ends. By change: with a sweep that moves no output by more than the threshold. By sum:
   with one whose largest |s|, of neurons that may still move, is at most `share` of the first sweep's, taken
   as the power of two at or below (0: none), or at most what a last place of the links is worth. */
typedef struct hm_stop {
  int by_sum;
  double share;
} hm_stop;

typedef struct hm_driver {
  hm_line line;     /* no bus: not opened yet */
  uint32_t version; /* of the array's registers, as VERSION holds it */
  uint32_t normaliser, output;
  hm_format weight, bias, state;
  hm_window weights, biases, outputs, momentum;
  hm_stop stop;          /* the caller's to set; hm_driver_open sets by change */
  uint32_t stop_written; /* STOP, taken to be 0 when it was opened, as after a RESET */
  uint32_t clipped;      /* weights and biases of the last load that did not fit their format */
  uint32_t vanished;     /* those that were not 0 and became code 0 */
  int shift;             /* they were loaded times 2^shift; 0 where rows are prescaled */
} hm_driver;

/* Looks at the array behind `bus` and checks that it was built for `mesh`. `buffer` is the longest burst, 1
   word or more. HM_OK, or HM_ERROR_ID, _VERSION, _MESH, _BUS, _SPACE; with _VERSION, driver->version is what
   was found. */
int hm_driver_open(hm_driver* driver, const hm_bus* bus, const hm_mesh* mesh, uint32_t* buffer,
                   uint32_t buffer_words);

/* m of sweep after sweep, from 0 to 1, into the table of a momentum array; the last of `count`, 1 or more,
   fills the rest. hm_driver_open has filled it with the sequence of docs/method/theory.md, section 3. HM_OK,
   or HM_ERROR_SPACE where the table is shorter, or the array has none, or an error of the bus. */
int hm_driver_put_momentum(hm_driver* driver, const double* m, uint32_t count);

/* Relaxes network->output from where it is until driver->stop is met, or max_sweeps. `threshold`: of a stop
   by change. HM_OK, or an error of bus.h; on an error network->output is as it was, but for one while
   it is being read back (HM_ERROR_BUS then leaves it partly read). */
int hm_driver_relax(void* driver, const hm_mesh* mesh, hm_network* network, double threshold,
                    uint32_t max_sweeps, hm_relaxation* result);

/* Relaxes with the weights of the last hm_driver_relax, of an array whose rows are not prescaled: only
   network->bias travels, at their shift, and network->output, from where it relaxes. driver->clipped goes on
   counting. Answers as hm_driver_relax. */
int hm_driver_correct(void* driver, const hm_mesh* mesh, hm_network* network, double threshold,
                      uint32_t max_sweeps, hm_relaxation* result);

/* The largest bias that fits beside the weights of the last hm_driver_relax. */
double hm_driver_room(void* driver);

/* Puts weights of an earlier hm_driver_relax back, at the shift of then, for corrections to go on with. */
int hm_driver_restore(hm_driver* driver, const hm_mesh* mesh, const hm_network* network, int shift);

#ifdef __cplusplus
}
#endif

#endif
