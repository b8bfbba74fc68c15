/* What the units of the driver share: registers as the driver reads and writes them, and what each unit does
   for the others. */
#ifndef HOPMESH_FIRMWARE_DRIVER_PARTS_H
#define HOPMESH_FIRMWARE_DRIVER_PARTS_H

#include "firmware/driver.h"

#include "firmware/registers.h"
#include "firmware/try.h"

static inline int hm_read_register(const hm_driver* d, uint32_t offset, uint32_t* word) {
  return d->line.bus->read(d->line.bus->context, offset, word);
}

static inline int hm_write_register(const hm_driver* d, uint32_t offset, uint32_t word) {
  return d->line.bus->write(d->line.bus->context, offset, word);
}

static inline int hm_read_format(const hm_driver* d, uint32_t offset, hm_format* format) {
  uint32_t word;
  TRY(hm_read_register(d, offset, &word));
  /* Every format register has the fields of this one. */
  *format = (hm_format){(int)HM_FIELD(word, CAP_FORMAT_WEIGHT_WIDTH),
                        (int)(int8_t)HM_FIELD(word, CAP_FORMAT_WEIGHT_INTEGER_BITS),
                        (int)HM_FIELD(word, CAP_FORMAT_WEIGHT_ROUNDING),
                        (int)HM_FIELD(word, CAP_FORMAT_WEIGHT_OVERFLOW)};
  return HM_OK;
}

/* A threshold in last places of the state. */
uint32_t hm_driver_places(const hm_driver* driver, double threshold);
/* HM_OK, or HM_ERROR_BUSY, or an error of the bus. */
int hm_driver_expect_idle(const hm_driver* driver);
/* A run with what is loaded, until it has ended; threshold in last places. */
int hm_driver_start(const hm_driver* driver, uint32_t threshold, uint32_t max_sweeps);
/* What the registers tell of it. */
int hm_driver_read_counters(const hm_driver* driver, hm_relaxation* result);

/* Does the host divide each row by its N before it loads it? */
int hm_driver_prescales(const hm_driver* driver);

/* STOP and SUM_THRESHOLD as driver->stop wants them for this network; nothing where the array has them.
   HM_OK, or HM_ERROR_VERSION where it has no such registers, or an error of the bus. */
int hm_driver_write_stop(hm_driver* driver, const hm_mesh* mesh, const hm_network* network);

/* What hm_driver_open does for the table of m, of an array that has one. */
int hm_driver_open_momentum(hm_driver* driver);

#endif
