#pragma once
// One frame taken out of where it came from: the state of the GPU before it, and everything it sends. It can
// be drawn again on any GPU, changed, and written as a dump.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dump/dump.h"
#include "gpu/gpu.h"
#include "inspect/lint.h"
#include "ot/main_ram.h"

namespace debug {

class Timeline;

/// A command, or a part of one that a word of the other port cut.
struct Item {
  std::uint32_t number = 0;  ///< K of F:K, from 1; 0: the rest of a command that another frame began
  bool is_control = false;   ///< one word of port 1
  bool is_rest = false;      ///< goes on with a command that began before
  std::uint32_t bucket = gpu::no_bucket;
  std::uint32_t address = 0;           ///< of its packet's tag, for a list in RAM
  std::optional<std::uint32_t> key{};  ///< what it was sorted by, if that is known
  std::string origin{};  ///< where it comes from, the same from frame to frame; empty: not known
  /// Of port 0 with the annotation words before it, and all its pixels. A node may hold several commands.
  std::vector<std::uint32_t> words{};

  /// The first word behind the annotations; `words.size()` if there is none.
  [[nodiscard]] std::size_t command_at() const;
  [[nodiscard]] bool is_drawing() const;
  /// In words: "triangle, gouraud (0,0) ...".
  [[nodiscard]] std::string text() const;
};

/// Words as they were sent, and where they come from. A command may go on in the words sent next.
struct Sent {
  bool is_control = false;  ///< one word of port 1
  std::uint32_t bucket = gpu::no_bucket;
  std::uint32_t address = 0;  ///< of its packet's tag; 0: it lies in no list
  std::string origin{};
  std::vector<std::uint32_t> words{};
};
/// The commands in what was sent, with their annotations and pixels.
std::vector<Item> items_of(const std::vector<Sent>& sent);

struct Clip {
  std::vector<std::byte> state;  ///< of the GPU before the first item, as gpu::Gpu::save() has it
  std::vector<Item> items;
  std::uint32_t buckets = 0;            ///< length of the ordering table; 0: none is known
  bool is_list_in_ram = false;          ///< items have addresses
  std::vector<inspect::LintItem> lint;  ///< of the list, what has a place as "123000h" first
  std::vector<std::string> notes{};     ///< about where it comes from, lines for people
};

/// Frame `frame` of a recording, 1..frames().
Clip clip_of(Timeline& timeline, std::uint64_t frame);

/// The list that lies in `ram` from `head` on; as far as it is good. `state`: of the GPU that is to draw it.
Clip clip_of_list(const ot::MainRam& ram, std::uint32_t head, const std::optional<inspect::TableRange>& table,
                  std::vector<std::byte> state);

struct PlayOptions {
  std::optional<gpu::DepthOptions> depth{};  ///< a z-buffer
  gpu::Trace* trace = nullptr;               ///< cleared, and told of buckets
  /// Called before each item.
  std::function<void(std::size_t item)> before{};
};
/// Draws the clip on `gpu`, whatever its state, and ends the frame.
gpu::FrameEnd play(const Clip& clip, gpu::Gpu& gpu, const PlayOptions& options);

/// Goes on from a state that gpu::Gpu::save() made in this program; of nothing it stays as it is.
void go_on_from(std::span<const std::byte> state, gpu::Gpu& gpu);

/// The packets that make a state on a new GPU, and PacketType::trace_begin behind them.
void add_state(std::span<const std::byte> state, dump::Dump& dump);

/// A dump that makes the state first, behind a PacketType::trace_begin packet sends the items, and ends with
/// a VSync. Replayed on a new GPU it leaves what playing the clip leaves.
void write_clip(const Clip& clip, dump::DumpWriter& writer);

}  // namespace debug
