#pragma once
// otter_hooks.h on the console itself: the coprocessor's own instructions, and plain links. Registers are
// reached through tables of instructions, because an instruction holds its register's number.

#include <stdint.h>

uint32_t otter_gte_get(unsigned number);
void otter_gte_put(unsigned number, uint32_t word);
void otter_link(void* ot, void* first, void* last);

/// The command word must be a constant; the coprocessor wants two instructions after its registers change.
#define otter_gte_do(command) \
  __asm__ volatile("nop\n nop\n cop2 %0\n nop\n nop" : : "i"((command)&0x1ffffff) : "memory")

static inline void otter_gte_store_xy(void* to, unsigned number) {
  const uint32_t word = otter_gte_get(12 + number);
  __builtin_memcpy(to, &word, 4);
}
