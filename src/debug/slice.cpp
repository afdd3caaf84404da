#include "debug/slice.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>

#include "debug/needs.h"
#include "debug/slice_writer.h"

namespace debug {
namespace {

base::Result<Slice> interrupted() { return base::fail("interrupted", base::Exit::interrupted); }

/// The first frame at whose end the needed pixels have the values in `vram`; `before`, the frame before which
/// they do, when none has; 0: they do before the first.
class FirstMoment {
 public:
  FirstMoment(Timeline& timeline, const Needs& needs, const std::vector<std::uint16_t>& vram)
      : timeline_(timeline) {
    for (std::uint32_t p = 0; p < needs.pixels.size(); ++p)
      if (needs.pixels[p]) wanted_.emplace_back(p, vram[p]);
  }

  std::uint64_t find(std::uint64_t before) {
    const auto has_all = [&](auto&& pixel) {
      return std::ranges::all_of(wanted_, [&](const auto& w) { return pixel(w.first) == w.second; });
    };
    const auto seen = [&](const Number& moment) {
      const auto pixels = timeline_.seek(moment).vram().pixels();
      return has_all([&](std::uint32_t p) { return pixels[p]; });
    };
    if (seen({.frame = 1, .command = 0})) return 0;
    // States along the way tell where to look first.
    const Keyframes& keys = timeline_.keyframes();
    std::size_t from = 0;
    while (from + 1 < keys.size() && !has_all([&](std::uint32_t p) { return keys.pixel(keys[from + 1], p); }))
      ++from;
    for (std::uint64_t frame = timeline_.frame_at(keys[from].place); frame < before; ++frame) {
      if (seen({.frame = frame, .command = whole_frame})) return frame;
    }
    return before;
  }

 private:
  Timeline& timeline_;
  std::vector<std::pair<std::uint32_t, std::uint16_t>> wanted_;
};

/// Everything that is kept, by frame.
struct Collected {
  std::map<std::uint64_t, std::vector<Kept>> frames;  // of each, first command first
  Needs at_start;
  std::uint64_t looked_at = 0;
};

base::Result<Collected> collect(Timeline& timeline, std::uint64_t frame,
                                std::span<const std::uint32_t> pixels,
                                const std::function<bool()>& keep_going) {
  Collected collected;
  Needs& needs = collected.at_start;
  for (const auto pixel : pixels) needs.add(pixel);
  const auto watched = std::make_unique<WatchedFrame>();
  while (frame != 0) {
    if (keep_going && !keep_going()) return base::fail("interrupted", base::Exit::interrupted);
    watch_frame(timeline, frame, *watched);
    ++collected.looked_at;
    if (watched->trace.is_full)
      return base::fail("frame " + std::to_string(frame) + ": " + watched->trace.limit_text(),
                        base::Exit::failed);
    auto kept = step_back(*watched, needs);
    std::ranges::reverse(kept);
    if (!kept.empty()) collected.frames[frame] = std::move(kept);
    // A palette that is still needed was loaded in the frame before.
    const std::uint64_t next = frame - 1;
    frame = next == 0 || needs.palette.any() ? next
                                             : FirstMoment(timeline, needs, watched->vram_after).find(next);
  }
  return collected;
}

}  // namespace

base::Result<Slice> slice(Timeline& timeline, std::uint64_t frame, std::span<const std::uint32_t> pixels,
                          const std::function<bool()>& keep_going) {
  auto collected = collect(timeline, frame, pixels, keep_going);
  if (!collected) return tl::make_unexpected(collected.error());
  Slice result;
  result.frames_looked_at = collected->looked_at;
  SliceWriter writer(timeline, result);
  writer.begin(collected->at_start);
  for (const auto& [number, kept] : collected->frames) {
    if (keep_going && !keep_going()) return interrupted();
    for (const Kept& command : kept) writer.add(number, command);
  }
  writer.end(frame);

  gpu::Gpu replayed;
  dump::replay(result.dump, replayed);
  const auto& whole = timeline.seek({.frame = frame, .command = whole_frame});
  for (const auto pixel : pixels) {
    const auto got = replayed.vram().pixels()[pixel], wanted = whole.vram().pixels()[pixel];
    if (got == wanted) continue;
    return base::fail("the slice of VRAM pixel " + std::to_string(pixel % gpu::Vram::width) + "," +
                          std::to_string(pixel / gpu::Vram::width) +
                          " does not replay to it, which is an error of ours; please report it",
                      base::Exit::failed);
  }
  return result;
}

}  // namespace debug
