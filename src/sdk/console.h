#pragma once
// The console behind the program: one, as there is one console. The SDK's functions act on it.

#include <array>
#include <cstdint>

#include "gpu/gpu.h"
#include "gte/registers.h"
#include "ot/main_ram.h"
#include "sdk/depth_notes.h"
#include "sdk/feed.h"
#include "sdk/handover.h"
#include "sdk/memory.h"
#include "sdk/pads.h"
#include "sdk/program_lint.h"

namespace sdk {

struct PadBuffer {
  std::uint8_t* bytes = nullptr;  ///< the program's
  std::size_t length = 0;
};

struct Console {
  ProgramMemory memory;                ///< of the program
  ot::MainRam ram{ot::RamSize::mib8};  ///< the memory as it was when the last list was drawn
  gpu::Gpu gpu;
  gte::Registers gte;
  DepthNotes depth;
  ProgramLint lint;
  Feed feed{gpu, depth, lint};
  Handover handover;

  std::atomic<std::uint32_t> blanks{0};
  std::array<PadBuffer, 2> pad_buffers{};
  bool pads_run = false;
  std::array<PadState, 2> pads{};  ///< the host's word for this blank
  bool has_second_pad = false;
  void (*on_blank)() = nullptr;   ///< VSyncCallback
  void (*on_drawn)() = nullptr;   ///< DrawSyncCallback
  bool callbacks_allowed = true;  ///< outside critical sections
  bool blank_missed = false;      ///< in a critical section
  bool reversed = false;          ///< lists are sent near to far
  std::uint32_t last_list = 0;    ///< where the list drawn last begins

  // What a report tells.
  std::uint64_t lists = 0, nodes = 0, words = 0, bytes_copied = 0;
};

Console& the_console();

/// The low 16 bits, as a register of the console takes them.
constexpr std::int16_t half(int value) { return static_cast<std::int16_t>(value); }

/// On the program's thread, after a vertical blank: controllers, then the program's callback.
void after_blank();

/// The three timers pass the time of one blank, and their callbacks run.
void run_timers();

/// False, and a finding at `site`, if `p` is null or no address at all.
bool is_usable(const void* p, const char* call, CallSite site);

}  // namespace sdk
