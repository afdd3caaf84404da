#include "debug/needs.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gpu/texel_reads.h"
#include "gpu/texture_page.h"
#include "ot/gp1.h"

namespace debug {
namespace {

using gpu::Kind, gpu::Primitive, gpu::Vram;

/// Follows the palette cache without its contents: which draws load it.
class PaletteLoads {
 public:
  explicit PaletteLoads(const gpu::ClutCache& cache) : cache_(cache) {}

  void command(const dump::Dump& dump, const Command& command) {
    const std::uint32_t word = dump.words[command.first];
    const bool resets = command.is_control ? ot::gp1::command_of(word) == ot::gp1::Command::reset
                                           : ot::gp0::command_of(word) == ot::gp0::Command::clear_cache;
    if (resets) cache_.invalidate();
  }
  /// Whether this draw loads it.
  bool draw(const Primitive& primitive) {
    if (!primitive.is_textured()) return false;
    const auto before = cache_.loads();
    cache_.use(vram_, primitive.clut, primitive.state.texel_format());
    return cache_.loads() != before;
  }

 private:
  gpu::ClutCache cache_;
  Vram vram_;  // what is loaded does not matter
};

std::vector<bool> palette_loads(const dump::Dump& dump, const std::vector<Command>& commands,
                                const gpu::ClutCache& cache, const gpu::Trace& trace) {
  PaletteLoads loads(cache);
  std::vector<bool> result;
  std::size_t next = 0;
  for (const Primitive& draw : trace.draws) {
    const auto number = number_of(1, draw).command;
    for (; next < commands.size() && commands[next].number < number; ++next)
      loads.command(dump, commands[next]);
    result.push_back(loads.draw(draw));
  }
  return result;
}

std::uint32_t pixel_at(int x, int y) { return static_cast<std::uint32_t>(Vram::offset(x, y)); }

/// The frame from its last draw to its first.
class StepBack {
 public:
  StepBack(WatchedFrame& watched, Needs& needs) : watched_(watched), needs_(needs) {}

  std::vector<Kept> run() {
    const auto& trace = watched_.trace;
    std::size_t end = trace.history.size();
    for (std::size_t draw = trace.draws.size(); draw-- > 0;) {
      std::size_t begin = end;
      while (begin > 0 && trace.history[begin - 1].draw == draw) --begin;
      step(draw, std::span(trace.history).subspan(begin, end - begin));
      end = begin;
    }
    return std::move(kept_);
  }

 private:
  using Events = std::span<const gpu::Event>;

  void step(std::size_t number, Events events) {
    const Primitive& draw = watched_.trace.draws[number];
    const bool loads = watched_.loads_palette[number];
    const bool writes = std::ranges::any_of(events, [&](const auto& e) { return needs_.pixels[e.pixel]; });
    const bool serves = loads && needs_.palette.any();
    if (writes || serves) {
      keep(draw, loads, events);
    } else {
      undo(events);
    }
    if (serves || (loads && writes)) need_palette(draw);
  }

  void keep(const Primitive& draw, bool loads, Events events) {
    const auto number = static_cast<std::uint32_t>(number_of(1, draw).command);
    // The segments of a polyline are draws of one command.
    if (kept_.empty() || kept_.back().command != number || draw.kind != Kind::line)
      kept_.push_back(
          {.command = number, .kind = draw.kind, .loads_palette = loads, .uploaded = {}, .around = {}});
    if (draw.kind == Kind::copy) return copy(draw, events);
    const auto reads = texel_reads(draw, events);
    const bool looks = draw.state.mask_test() != 0 && draw.kind != Kind::fill;
    std::vector<std::uint32_t> overwritten;
    for (const auto& event : events) {
      if (!needs_.pixels[event.pixel]) continue;
      if (draw.kind == Kind::upload) kept_.back().uploaded[event.pixel] = event.fragment;
      if (!event.blended && !looks && !kept_back_.contains(event.pixel)) overwritten.push_back(event.pixel);
    }
    if (draw.kind == Kind::upload) note_around(events);
    undo(events);
    for (const auto pixel : overwritten) needs_.pixels[pixel] = false;
    for (const auto pixel : reads) needs_.add(pixel);
    kept_back_.clear();
  }

  /// What else an upload writes in the rectangle of its needed pixels.
  void note_around(Events events) {
    Kept& kept = kept_.back();
    std::uint32_t left = Vram::width, right = 0;
    for (const auto& [pixel, value] : kept.uploaded) {
      left = std::min(left, pixel % Vram::width);
      right = std::max(right, pixel % Vram::width);
    }
    const std::uint32_t top = kept.uploaded.begin()->first / Vram::width;
    const std::uint32_t bottom = kept.uploaded.rbegin()->first / Vram::width;
    for (const auto& event : events) {
      const std::uint32_t x = event.pixel % Vram::width, y = event.pixel / Vram::width;
      if (x >= left && x <= right && y >= top && y <= bottom)
        kept.around.emplace(event.pixel, event.fragment);
    }
  }

  /// The texels that the needed pixels of a draw come from; their palette entries are added to the needs.
  std::vector<std::uint32_t> texel_reads(const Primitive& draw, Events events) {
    std::vector<std::uint32_t> reads;
    if (!draw.is_textured()) return reads;
    std::vector<gpu::TexelRead> all;
    gpu::for_each_texel(draw, [&](const gpu::TexelRead& read) { all.push_back(read); });
    std::map<std::uint32_t, std::uint16_t> before;  // what the draw itself changed, as it found it
    for (const auto& event : events) before.emplace(event.pixel, event.before);
    // A draw that reads what it writes: each pixel read may be needed as it was, or as the draw left it.
    std::vector<bool> wanted = needs_.pixels;
    for (bool grows = true; grows;) {
      grows = false;
      for (const auto& read : all) {
        if (!wanted[read.pixel]) continue;
        reads.push_back(read.place);
        const auto own = before.find(read.place);
        need_entry(read, own == before.end() ? nullptr : &own->second);
        if (own == before.end()) continue;
        kept_back_.emplace(read.place, true);
        if (!wanted[read.place]) grows = wanted[read.place] = true;
      }
      if (grows) reads.clear();
    }
    return reads;
  }

  /// `found`: what the draw found where it writes, too: then any of the values there may have been read.
  void need_entry(const gpu::TexelRead& read, const std::uint16_t* found) {
    if (read.mask == 0) return;
    if (found != nullptr) {
      for (std::size_t n = 0; n <= read.mask; ++n) needs_.palette.set(n);
      return;
    }
    needs_.palette.set(watched_.vram_after[read.place] >> read.shift & read.mask);
  }

  /// In the order against the one made: a piece is read whole before it is written.
  void copy(const Primitive& draw, Events events) {
    struct Piece {
      int x, y, count;
    };
    std::vector<Piece> pieces;
    gpu::for_each_copied_piece(draw, [&](int x, int y, int count) { pieces.push_back({x, y, count}); });
    undo(events);
    const auto &to = draw.vertices[0], &from = draw.vertices[1];
    std::vector<std::uint32_t> sources;
    std::ranges::reverse(pieces);
    for (const auto& [x, y, count] : pieces) {
      sources.clear();
      for (int i = 0; i < count; ++i) {
        const auto pixel = pixel_at(to.x + x + i, to.y + y);
        if (!needs_.pixels[pixel]) continue;
        sources.push_back(pixel_at(from.x + x + i, from.y + y));
        if (draw.state.mask_test() == 0) needs_.pixels[pixel] = false;
      }
      for (const auto source : sources) needs_.add(source);
    }
  }

  void need_palette(const Primitive& draw) {
    const int x = static_cast<int>(ot::gp0::clut::X16::get(draw.clut)) * 16;
    const int y = static_cast<int>(ot::gp0::clut::Y::get(draw.clut));
    const int size = gpu::palette_size(draw.state.texel_format());
    for (int n = 0; n < size; ++n) {
      if (!needs_.palette[static_cast<std::size_t>(n)]) continue;
      needs_.palette.reset(static_cast<std::size_t>(n));
      needs_.add(pixel_at(x + n, y));
    }
  }

  void undo(Events events) {
    for (std::size_t n = events.size(); n-- > 0;) watched_.vram_after[events[n].pixel] = events[n].before;
  }

  WatchedFrame& watched_;
  Needs& needs_;
  std::vector<Kept> kept_;
  std::map<std::uint32_t, bool> kept_back_;  // read by the draw that also writes them
};

}  // namespace

void watch_frame(Timeline& timeline, std::uint64_t frame, WatchedFrame& watched) {
  watched.trace.keep_history = true;
  const auto cache = timeline.seek({.frame = frame, .command = 0}).palette();
  timeline.watch(frame, watched.trace);
  watched.loads_palette = palette_loads(timeline.dump(), timeline.commands(frame), cache, watched.trace);
  const auto pixels = timeline.gpu().vram().pixels();
  watched.vram_after.assign(pixels.begin(), pixels.end());
}

std::vector<Kept> step_back(WatchedFrame& watched, Needs& needs) { return StepBack(watched, needs).run(); }

}  // namespace debug
