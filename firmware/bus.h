/* The only way from the firmware to the array: five calls that a platform provides. */
#ifndef HOPMESH_FIRMWARE_BUS_H
#define HOPMESH_FIRMWARE_BUS_H

#include <stdint.h>

/* Every call returns HM_OK or a platform error below zero, which the driver passes on. */
typedef struct hm_bus {
  void* context;
  int (*read)(void* context, uint32_t address, uint32_t* word);
  int (*write)(void* context, uint32_t address, uint32_t word);
  int (*read_burst)(void* context, uint32_t address, uint32_t* words, uint32_t count);
  int (*write_burst)(void* context, uint32_t address, const uint32_t* words, uint32_t count);
  int (*wait)(void* context); /* until the array's interrupt line is up */
} hm_bus;

enum {
  HM_OK = 0,
  HM_ERROR_BUS = -1,     /* the platform's bus refused a transfer */
  HM_ERROR_ID = -2,      /* no Hopmesh array */
  HM_ERROR_MESH = -3,    /* the array was built for another mesh */
  HM_ERROR_NUMBER = -4,  /* a weight, bias or start value is not finite */
  HM_ERROR_BUSY = -5,    /* the array was running when it should not */
  HM_ERROR_SPACE = -6,   /* the caller's buffer is too small */
  HM_ERROR_STOPPED = -7, /* the platform asked to stop waiting */
  HM_ERROR_LOST = -8,    /* a node would have no finite place or velocity after the step */
  HM_ERROR_VERSION = -9  /* the array's registers are of a version that this driver does not know */
};

#endif
