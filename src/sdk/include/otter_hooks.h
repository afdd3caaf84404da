#pragma once
// What the SDK's macros call instead of instructions of the coprocessor and plain stores: the runtime must
// know where screen positions go and which packets are linked. Programs do not use this file by name.

#include <stdint.h>
#include <string.h>

#ifdef __mips__
#include "otter_console_hooks.h"
#else

#ifdef __cplusplus
extern "C" {
#endif

/// Coprocessor registers: 0..31 data (MFC2, MTC2), 32..63 control (CFC2, CTC2).
uint32_t otter_gte_get(unsigned number);
void otter_gte_put(unsigned number, uint32_t word);
/// A command word, the low 25 bits of the COP2 instruction.
void otter_gte_do(uint32_t command);
/// Stores SXY0..2 (`number` 0..2) and remembers with which depth it was made.
void otter_gte_store_xy(void* to, unsigned number);

/// Links packets first..last, which hang together, into the list that begins at `ot`: last -> what ot linked
/// to, ot -> first. A pointer that 24 bits cannot hold is reported and nothing is linked.
void otter_link(void* ot, void* first, void* last);

#ifdef __cplusplus
}
#endif

#endif  // __mips__

static inline uint32_t otter_word(const void* from, unsigned offset) {
  uint32_t word;
  memcpy(&word, (const char*)from + offset, 4);
  return word;
}
static inline uint32_t otter_half(const void* from, unsigned offset) {  // sign-extended
  int16_t half;
  memcpy(&half, (const char*)from + offset, 2);
  return (uint32_t)(int32_t)half;
}
static inline uint32_t otter_byte(const void* from, unsigned offset) {
  return ((const uint8_t*)from)[offset];
}
static inline void otter_put_word(void* to, unsigned offset, uint32_t word) {
  memcpy((char*)to + offset, &word, 4);
}
static inline void otter_put_half(void* to, unsigned offset, uint32_t word) {
  const uint16_t half = (uint16_t)word;
  memcpy((char*)to + offset, &half, 2);
}
static inline void otter_put_byte(void* to, unsigned offset, uint32_t word) {
  ((uint8_t*)to)[offset] = (uint8_t)word;
}
