#include "firmware/riscv/core_bus.h"

#include "firmware/riscv/core_map.h"

static volatile uint32_t* at(uint32_t address) {
  return (volatile uint32_t*)address; // NOLINT: the core's addresses are 32 bits wide
}

static int error_so_far(void) {
  return (int)*at(HM_CORE_BRIDGE + HM_BRIDGE_ERROR);
}

static int read_word(void* none, uint32_t address, uint32_t* word) {
  (void)none;
  *word = *at(HM_CORE_ARRAY + address);
  return error_so_far();
}

static int write_word(void* none, uint32_t address, uint32_t word) {
  (void)none;
  *at(HM_CORE_ARRAY + address) = word;
  return error_so_far();
}

static int read_words(void* none, uint32_t address, uint32_t* words, uint32_t count) {
  (void)none;
  const volatile uint32_t* from = at(HM_CORE_ARRAY + address);
  for (const uint32_t* const end = words + count; words != end;) *words++ = *from++;
  return error_so_far();
}

static int write_words(void* none, uint32_t address, const uint32_t* words, uint32_t count) {
  (void)none;
  volatile uint32_t* to = at(HM_CORE_ARRAY + address);
  for (const uint32_t* const end = words + count; words != end;) *to++ = *words++;
  return error_so_far();
}

static int transfer(uint32_t start, uint32_t address, const volatile uint32_t* words, uint32_t count) {
  *at(HM_CORE_BRIDGE + HM_BRIDGE_ADDRESS) = address;
  *at(HM_CORE_BRIDGE + HM_BRIDGE_MEMORY) = (uint32_t)words;
  *at(HM_CORE_BRIDGE + start) = count;
  __asm__ volatile("" ::: "memory"); /* the bridge reads and writes what the compiler may hold */
  return error_so_far();
}

static int read_burst(void* none, uint32_t address, uint32_t* words, uint32_t count) {
  (void)none;
  return transfer(HM_BRIDGE_TO_MEMORY, address, words, count);
}

static int write_burst(void* none, uint32_t address, const uint32_t* words, uint32_t count) {
  (void)none;
  __asm__ volatile("" ::: "memory");
  return transfer(HM_BRIDGE_TO_ARRAY, address, words, count);
}

static int wait(void* none) {
  (void)none;
  return (int)*at(HM_CORE_BRIDGE + HM_BRIDGE_WAIT);
}

hm_bus hm_core_bus(uint32_t bus_master) {
  if (bus_master) return (hm_bus){0, read_word, write_word, read_burst, write_burst, wait};
  return (hm_bus){0, read_word, write_word, read_words, write_words, wait};
}
