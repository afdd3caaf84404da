#pragma once
// Recordings for tests: small ones by hand, and random ones that hold every kind of command.

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "debug/timeline.h"
#include "dump/dump.h"
#include "gpu/gpu.h"
#include "tests/random.h"

namespace tests {

using Words = std::vector<std::uint32_t>;

inline std::uint32_t xy(int x, int y) {
  return (static_cast<std::uint32_t>(x) & 0xffff) | static_cast<std::uint32_t>(y) << 16;
}

/// The whole of VRAM may be drawn into.
inline const Words everywhere{0xe3000000, 0xe4000000 | 1023 | 511 << 10};

/// Of streams that never tell the display what to show: a VSync ends a frame.
struct Timeline : debug::Timeline {
  explicit Timeline(debug::Recording recording, const debug::DrawOptions& options = {},
                    std::uint64_t limit_bytes = debug::most_bytes)
      : debug::Timeline(std::move(recording), options, limit_bytes) {
    end_frames_by(dump::FrameBy::vsync);
  }
};

inline std::vector<std::uint16_t> pixels_of(const gpu::Gpu& gpu) {
  const auto pixels = gpu.vram().pixels();
  return {pixels.begin(), pixels.end()};
}

/// Commands of all kinds at random places, textures and palettes among what is drawn.
class RandomCommands {
 public:
  explicit RandomCommands(std::uint32_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t n) { return random_.below(n); }
  std::uint32_t place() { return xy(static_cast<int>(below(256)), static_cast<int>(below(256))); }

  Words command() {
    switch (below(12)) {
      case 0:
        return {0xe1000000 | below(0x4000)};
      case 1:
        return {0xe2000000 | below(4) << 10 | below(4)};
      case 2:
        return {0xe6000000 | (below(4) == 0 ? below(4) : 0)};
      case 3:
        return {0x02000000 | below(0x1000000), place(),
                xy(static_cast<int>(below(40)), static_cast<int>(below(30)))};
      case 4:
        return {0x80000000, place(), place(),
                xy(static_cast<int>(1 + below(200)), static_cast<int>(1 + below(20)))};
      case 5:
        return upload();
      case 6:
        return {0x40000000 | below(2) << 25 | below(0x1000000), place(), place()};
      case 7:
        return {0x48000000 | below(0x1000000), place(), place(), place(), 0x55555555};
      case 8:
      case 9:
        return sprite();
      default:
        return polygon();
    }
  }

 private:
  Words upload() {
    const auto w = 1 + below(32), h = 1 + below(16);
    Words words{0xa0000000, place(), xy(static_cast<int>(w), static_cast<int>(h))};
    for (std::uint32_t n = 0; n < (w * h + 1) / 2; ++n) words.push_back(random_.word());
    return words;
  }
  std::uint32_t texcoord(std::uint32_t high) { return below(0x10000) | high << 16; }
  std::uint32_t clut() { return below(16) | below(256) << 6; }
  Words sprite() {
    const auto textured = below(2);
    Words words{0x60000000 | textured << 26 | below(4) << 24 | below(0x1000000), place()};
    if (textured != 0) words.push_back(texcoord(clut()));
    words.push_back(xy(static_cast<int>(below(60)), static_cast<int>(below(60))));
    return words;
  }
  Words polygon() {
    const auto flags = below(32);
    const bool gouraud = (flags & 16) != 0, quad = (flags & 8) != 0, textured = (flags & 4) != 0;
    Words words{0x20000000 | flags << 24 | below(0x1000000)};
    for (std::uint32_t v = 0; v < (quad ? 4U : 3U); ++v) {
      if (gouraud && v != 0) words.push_back(below(0x1000000));
      words.push_back(place());
      if (textured) words.push_back(texcoord(v == 0 ? clut() : below(0x200) & 0x1ff));
    }
    return words;
  }

  Random random_;
};

/// `frames` frames of `commands` commands; commands may be cut by packets, and by the ends of frames.
inline dump::Dump random_dump(std::uint32_t seed, int frames, int commands) {
  RandomCommands random(seed);
  dump::Dump dump;
  dump.add(dump::PacketType::port0, everywhere);
  Words held;
  for (int f = 0; f < frames; ++f) {
    for (int n = 0; n < commands; ++n) {
      const auto more = random.command();
      held.insert(held.end(), more.begin(), more.end());
      if (random.below(3) != 0) continue;
      const auto cut =
          random.below(4) == 0 ? random.below(static_cast<std::uint32_t>(held.size())) : held.size();
      dump.add(dump::PacketType::port0, std::span(held).first(cut));
      held.erase(held.begin(), held.begin() + static_cast<std::ptrdiff_t>(cut));
      if (held.empty() && random.below(4) == 0)
        dump.add(dump::PacketType::port1, Words{0x05000000 | random.below(2) * 240 << 10});
    }
    if (random.below(2) == 0) {
      dump.add(dump::PacketType::port0, held);
      held.clear();
    }
    dump.add(dump::PacketType::vsync);
    ++dump.vsyncs;
  }
  if (!held.empty()) dump.add(dump::PacketType::port0, held);
  return dump;
}

}  // namespace tests
