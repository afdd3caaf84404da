// Vertical blanks and callbacks: VSync, DrawSync, psxetc.h, and psxapi.h's controllers, sections and
// counters.

#include <array>
#include <cstdlib>

#include "sdk/console.h"
#include "sdk/include/hwregs_c.h"
#include "sdk/include/psxapi.h"
#include "sdk/include/psxetc.h"
#include "sdk/include/psxgpu.h"

namespace sdk {
namespace {

using Callback = void (*)(void);

Callback exchange(Callback& held, Callback next) {
  const auto before = held;
  held = next;
  return before;
}

std::array<Callback, 11> interrupt_callbacks{};
std::array<Callback, 7> dma_callbacks{};
std::array<int, 7> dma_priorities{};

/// Where a callback of an interrupt is kept. The vertical blank's and the GPU's are those of VSync and
/// DrawSync.
Callback* slot(IRQ_Channel irq) {
  auto& console = the_console();
  if (irq == IRQ_VBLANK) return &console.on_blank;
  if (irq == IRQ_GPU) return &console.on_drawn;
  return irq < interrupt_callbacks.size() ? &interrupt_callbacks[irq] : nullptr;
}

void* as_pointer(Callback callback) { return reinterpret_cast<void*>(callback); }

/// Ticks of a root counter between two vertical blanks (NTSC): pixel clock at 320, lines, system clock / 8,
/// blanks.
constexpr std::array<std::uint32_t, 4> ticks_per_blank{107'520, 263, 70'650, 1};
std::array<std::uint32_t, 4> counter_zero{};  // blanks when it was set to zero

std::array<otter_timer_registers, 3> timers{};

/// Ticks of a timer between two vertical blanks, with the clock that its control register chooses.
std::uint32_t ticks_of(std::size_t timer) {
  constexpr std::uint32_t system_clock = ticks_per_blank[2] * 8;
  const unsigned source = timers[timer].ctrl >> 8 & 3;
  const bool has_own_clock = timer == 2 ? source >= 2 : (source & 1) != 0;
  return has_own_clock ? ticks_per_blank[timer] : system_clock;
}

}  // namespace

void run_timers() {
  constexpr unsigned at_reload = 1u << 3, interrupts = 3u << 4;
  for (std::size_t n = 0; n < timers.size(); ++n) {
    auto& timer = timers[n];
    const std::uint32_t period =
        (timer.ctrl & at_reload) != 0 && timer.reload != 0 ? std::uint32_t{timer.reload} + 1 : 0x10000;
    const std::uint32_t total = timer.value + ticks_of(n);
    timer.value = static_cast<std::uint16_t>(total % period);
    const auto callback = interrupt_callbacks[IRQ_TIMER0 + n];
    if (callback == nullptr || (timer.ctrl & interrupts) == 0) continue;
    for (std::uint32_t fired = 0; fired < total / period; ++fired) callback();
  }
}
}  // namespace sdk

using sdk::the_console;

extern "C" {

int VSync(int mode) {
  auto& console = the_console();
  if (mode == 1) return 0;
  if (mode >= 0) {
    for (int i = 0; i < (mode < 2 ? 1 : mode); ++i) {
      console.handover.wait_for_blank();
      sdk::after_blank();
    }
    console.lint.sync();
  }
  return mode < 0 ? static_cast<int>(console.blanks) : 0;
}

void* VSyncHaltFunction(void (*)(void)) { return nullptr; }
void* VSyncCallback(void (*func)(void)) {
  return sdk::as_pointer(sdk::exchange(the_console().on_blank, func));
}

void SetDrawOpType(GPU_DrawOpType) {}

int EnqueueDrawOp(void (*func)(), uint32_t arg1, uint32_t arg2, uint32_t arg3) {
  if (!sdk::is_usable(reinterpret_cast<const void*>(func), "EnqueueDrawOp", __builtin_return_address(0)))
    return -1;
  reinterpret_cast<void (*)(uint32_t, uint32_t, uint32_t)>(func)(arg1, arg2, arg3);
  return 0;
}

int DrawSync(int mode) {
  if (mode == 0) the_console().lint.sync();
  return 0;
}
void* DrawSyncCallback(void (*func)(void)) {
  return sdk::as_pointer(sdk::exchange(the_console().on_drawn, func));
}

void* InterruptCallback(IRQ_Channel irq, void (*func)(void)) {
  auto* slot = sdk::slot(irq);
  return slot == nullptr ? nullptr : sdk::as_pointer(sdk::exchange(*slot, func));
}
void* GetInterruptCallback(IRQ_Channel irq) {
  const auto* slot = sdk::slot(irq);
  return slot == nullptr ? nullptr : sdk::as_pointer(*slot);
}
void* DMACallback(DMA_Channel dma, void (*func)(void)) {
  if (dma >= sdk::dma_callbacks.size()) return nullptr;
  return sdk::as_pointer(sdk::exchange(sdk::dma_callbacks[dma], func));
}
void* GetDMACallback(DMA_Channel dma) {
  return dma < sdk::dma_callbacks.size() ? sdk::as_pointer(sdk::dma_callbacks[dma]) : nullptr;
}
int SetDMAPriority(DMA_Channel dma, int priority) {
  if (dma >= sdk::dma_priorities.size()) return -1;
  const int before = sdk::dma_priorities[dma];
  sdk::dma_priorities[dma] = priority;
  return before;
}
int GetDMAPriority(DMA_Channel dma) {
  return dma < sdk::dma_priorities.size() ? sdk::dma_priorities[dma] : -1;
}

int ResetCallback(void) {
  the_console().on_blank = the_console().on_drawn = nullptr;
  return 0;
}
void RestartCallback(void) { the_console().callbacks_allowed = true; }
void StopCallback(void) { the_console().callbacks_allowed = false; }

int EnterCriticalSection(void) {
  auto& console = the_console();
  const bool before = console.callbacks_allowed;
  console.callbacks_allowed = false;
  return before ? 1 : 0;
}
void ExitCriticalSection(void) {
  auto& console = the_console();
  console.callbacks_allowed = true;
  if (console.blank_missed) {
    console.blank_missed = false;
    sdk::after_blank();
  }
}

void InitPAD(uint8_t* buff1, int len1, uint8_t* buff2, int len2) {
  the_console().pad_buffers = {sdk::PadBuffer{buff1, static_cast<std::size_t>(len1 < 0 ? 0 : len1)},
                               sdk::PadBuffer{buff2, static_cast<std::size_t>(len2 < 0 ? 0 : len2)}};
}
void StartPAD(void) { the_console().pads_run = true; }
void StopPAD(void) { the_console().pads_run = false; }
void ChangeClearPAD(int) {}
void ChangeClearRCnt(int, int) {}

int SetRCnt(int spec, uint16_t, int) { return ResetRCnt(spec); }
int GetRCnt(int spec) {
  const auto n = static_cast<unsigned>(spec) & 0xff;
  if (n >= sdk::ticks_per_blank.size()) return 0;
  return static_cast<int>((the_console().blanks - sdk::counter_zero[n]) * sdk::ticks_per_blank[n] & 0xffff);
}
int StartRCnt(int spec) { return (static_cast<unsigned>(spec) & 0xff) < sdk::ticks_per_blank.size() ? 1 : 0; }
int StopRCnt(int spec) { return StartRCnt(spec); }
int ResetRCnt(int spec) {
  if (StartRCnt(spec) == 0) return 0;
  sdk::counter_zero[static_cast<unsigned>(spec) & 0xff] = the_console().blanks;
  return 1;
}

otter_timer_registers* otter_timer(unsigned number) {
  return &sdk::timers[number < sdk::timers.size() ? number : sdk::timers.size() - 1];
}

void FlushCache(void) {}
void _boot(void) { the_console().handover.stop(sdk::ProgramState::ended); }
/// In place of the program's exit(): the host writes what was asked for.
void otter_exit(int) { the_console().handover.stop(sdk::ProgramState::ended); }

}  // extern "C"
