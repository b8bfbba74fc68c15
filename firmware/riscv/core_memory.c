/* What compilers call for copies and zeros, word by word where they can. */
#include <stdint.h>

typedef __SIZE_TYPE__ bytes;

void* memset(void* to, int byte, bytes count);
void* memcpy(void* to, const void* from, bytes count);

void* memset(void* to, int byte, bytes count) {
  uint8_t* at = to;
  uint8_t* const end = at + count;
  const uint32_t word = (uint32_t)(uint8_t)byte * 0x01010101u;
  while (at != end && ((uint32_t)at & 3) != 0) *at++ = (uint8_t)byte;
  for (; end - at >= 32; at += 32) {
    volatile uint32_t* const w = (uint32_t*)at; /* else the compiler makes a call of memset of it */
    w[0] = w[1] = w[2] = w[3] = w[4] = w[5] = w[6] = w[7] = word;
  }
  for (; end - at >= 4; at += 4) *(volatile uint32_t*)at = word;
  while (at != end) *(volatile uint8_t*)at = (uint8_t)byte, ++at;
  return to;
}

void* memcpy(void* to, const void* from, bytes count) {
  uint8_t* at = to;
  const uint8_t* source = from;
  uint8_t* const end = at + count;
  if ((((uint32_t)at | (uint32_t)source) & 3) == 0)
    for (; end - at >= 4; at += 4, source += 4) *(volatile uint32_t*)at = *(const uint32_t*)source;
  for (; at != end; ++at, ++source) *(volatile uint8_t*)at = *source;
  return to;
}
