#pragma once
// The console's three timers as a program's C sees them. They are counted from vertical blank to vertical
// blank; every other register of the hardware is not here.

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
  volatile uint16_t value;  ///< ticks
  volatile uint16_t
      ctrl;  ///< bit 3: begin again at `reload`; 4, 5: interrupt there, at overflow; 8, 9: clock
  volatile uint16_t reload;
} otter_timer_registers;
/// Of timer 0 (pixel clock), 1 (lines), 2 (system clock / 8); any other number is timer 2.
otter_timer_registers* otter_timer(unsigned number);

#ifdef __cplusplus
}
#endif

#define TIMER_VALUE(N) (otter_timer(N)->value)
#define TIMER_CTRL(N) (otter_timer(N)->ctrl)
#define TIMER_RELOAD(N) (otter_timer(N)->reload)
