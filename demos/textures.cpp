#include "demos/textures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace demos {

using scene::Rgb8;
using scene::Rgba8;
using scene::Texture;

double grain(int x, int y, int seed) {
  auto h = static_cast<std::uint32_t>(x) * 0x8da6b343U ^ static_cast<std::uint32_t>(y) * 0xd8163841U ^
           static_cast<std::uint32_t>(seed) * 0xcb1ab31fU;
  h = (h ^ h >> 15) * 0x2c1b3c6dU;
  h = (h ^ h >> 12) * 0x297a2d39U;
  return (h ^ h >> 15) / 4294967296.0;
}

double clouds(double u, double v, int cells, int seed) {
  double sum = 0;
  double weight = 0.5;
  for (int octave = 0; octave < 3; ++octave, cells *= 2, weight /= 2) {
    const double x = u * cells;
    const double y = v * cells;
    const int x0 = static_cast<int>(std::floor(x));
    const int y0 = static_cast<int>(std::floor(y));
    const auto at = [&](int dx, int dy) {
      return grain(((x0 + dx) % cells + cells) % cells, ((y0 + dy) % cells + cells) % cells, seed + octave);
    };
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double s = smooth(x - x0);
    const double t = smooth(y - y0);
    const double above = at(0, 0) + (at(1, 0) - at(0, 0)) * s;
    const double below = at(0, 1) + (at(1, 1) - at(0, 1)) * s;
    sum += weight * (above + (below - above) * t);
  }
  return sum / 0.875;
}

Rgba8 shaded(Rgb8 colour, double light) {
  const auto channel = [light](int c) {
    const double value = light <= 1 ? c * light : c + (255 - c) * (light - 1);
    return static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
  };
  return {channel(colour.r), channel(colour.g), channel(colour.b), 255};
}

Rgba8 mixed(Rgba8 from, Rgba8 to, double t) {
  const auto channel = [t](int a, int b) {
    return static_cast<std::uint8_t>(a + (b - a) * std::clamp(t, 0.0, 1.0));
  };
  return {channel(from.r, to.r), channel(from.g, to.g), channel(from.b, to.b), channel(from.a, to.a)};
}

Texture painted(std::string name, int size, const std::function<Rgba8(int x, int y)>& paint) {
  Texture t;
  t.name = std::move(name);
  t.width = t.height = size;
  t.pixels.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) t.pixels.push_back(paint(x, y));
  return t;
}

namespace {

// Wood along x: long streaks, a few darker veins.
double wood(int x, int y, int seed) {
  const double streak = clouds(x / 256.0, y / 32.0, 8, seed);
  const double vein = clouds(x / 512.0, y / 24.0, 6, seed + 7);
  return 0.72 + 0.35 * streak - (vein > 0.62 ? 0.16 : 0.0);
}

// Light from the upper left on a raised field 0..size: bright at its left and top edge, dark at the others.
double bevel(int x, int y, int width, int height, int edge) {
  if (x < edge || y < edge) return 1.18;
  if (x >= width - edge || y >= height - edge) return 0.62;
  return 1;
}

bool is_nail(int x, int y, int cx, int cy, int radius) {
  return (x - cx) * (x - cx) + (y - cy) * (y - cy) <= radius * radius;
}

}  // namespace

Texture wooden_crate() {
  return painted("wooden crate", 128, [](int x, int y) {
    constexpr Rgb8 board{186, 128, 70};
    constexpr Rgb8 frame{206, 146, 84};
    constexpr int rim = 18;
    const bool side = x < rim || x >= 128 - rim;
    const bool end = y < rim || y >= 128 - rim;
    if (side || end) {
      const int along = side ? y : x;
      const int across = side ? (x < rim ? x : x - 128 + rim) : (y < rim ? y : y - 128 + rim);
      const int cx = x < 64 ? rim / 2 : 127 - rim / 2;
      const int cy = y < 64 ? rim / 2 : 127 - rim / 2;
      if (is_nail(x, y, cx, cy, 3)) return shaded({92, 84, 78}, is_nail(x, y, cx - 1, cy - 1, 1) ? 1.5 : 1);
      return shaded(frame, wood(along, across + (side ? 40 : 0), 3) * bevel(across, 5, rim, 11, 2));
    }
    const int diagonal = x - y;
    if (std::abs(diagonal) < 13) {
      const double edge = diagonal > 10 ? 1.15 : diagonal < -10 ? 0.6 : 1.0;
      return shaded(frame, wood((x + y) / 2, diagonal + 80, 5) * edge);
    }
    const bool shadow = diagonal < 0 && diagonal > -17;
    const int plank = (y - rim) / 23;
    const double gap = (y - rim) % 23 < 2 ? 0.42 : 1.0;
    return shaded(board, wood(x + 61 * plank, y, 11 + plank) * gap * (shadow ? 0.6 : 0.86));
  });
}

Texture metal_crate() {
  return painted("metal crate", 128, [](int x, int y) {
    constexpr Rgb8 steel{120, 132, 146};
    const double brushed = 0.86 + 0.2 * clouds(x / 256.0, y / 20.0, 4, 21) + 0.06 * (grain(x, y, 2) - 0.5);
    if (y >= 52 && y < 76) {
      const bool yellow = (x + y) / 12 % 2 == 0;
      const double worn = clouds(x / 128.0, y / 128.0, 8, 33);
      const double edge = y < 54 ? 1.15 : y >= 74 ? 0.6 : 1.0;
      if (worn > 0.68) return shaded(steel, brushed * 0.8);
      return shaded(yellow ? Rgb8{226, 178, 32} : Rgb8{38, 36, 34}, edge * (0.85 + 0.2 * worn));
    }
    const int px = x % 64;
    const int py = y < 52 ? y : y - 76;
    for (const int cx : {7, 56})
      for (const int cy : {7, 44})
        if (is_nail(px, py, cx, cy, 3)) return shaded(steel, is_nail(px, py, cx - 1, cy - 1, 1) ? 1.6 : 0.66);
    const double rust = std::max(0.0, clouds(x / 128.0, y / 128.0, 5, 44) - 0.62) * 3;
    return mixed(shaded(steel, brushed * bevel(px, py, 64, 52, 2)), shaded({142, 78, 42}, brushed), rust);
  });
}

Texture bricks() {
  auto t = painted("bricks", 64, [](int x, int y) {
    const int row = y / 16;
    const int shifted = (x + row % 2 * 16) % 64;
    const int bx = shifted % 32;
    const int by = y % 16;
    if (bx < 2 || by < 2) return shaded({150, 140, 128}, 0.7 + 0.25 * grain(x, y, 1));
    const double tone = 0.78 + 0.3 * grain(shifted / 32, row, 9) + 0.16 * (grain(x, y, 4) - 0.5);
    const double edge = bx == 2 || by == 2 ? 1.2 : bx == 31 || by == 15 ? 0.72 : 1.0;
    return shaded({168, 76, 54}, tone * edge);
  });
  t.repeats = true;
  return t;
}

Texture planks() {
  auto t = painted("planks", 64, [](int x, int y) {
    const int board = y / 16;
    const int by = y % 16;
    const int joint = (board * 37 + 11) % 64;
    const double gap = by == 0 ? 0.4 : by == 1 ? 1.12 : x == joint ? 0.45 : 1.0;
    const double tone = 0.78 + 0.25 * grain(board, 0, 5);
    return shaded({164, 112, 66}, tone * gap * (0.8 + 0.3 * clouds(x / 64.0, y / 64.0 * 4, 4, 50 + board)));
  });
  t.repeats = true;
  return t;
}

Texture stone_tiles() {
  auto t = painted("stone tiles", 64, [](int x, int y) {
    const bool light = (x / 32 + y / 32) % 2 == 0;
    const double worn = 0.8 + 0.3 * clouds(x / 64.0, y / 64.0, 8, 61) + 0.08 * (grain(x, y, 6) - 0.5);
    return shaded(light ? Rgb8{168, 160, 146} : Rgb8{96, 100, 110}, worn * bevel(x % 32, y % 32, 32, 32, 1));
  });
  t.repeats = true;
  return t;
}

Texture plaster() {
  auto t = painted("plaster", 64, [](int x, int y) {
    const double stain = 0.86 + 0.2 * clouds(x / 64.0, y / 64.0, 4, 71);
    if (y >= 40 && y < 43) return shaded({96, 70, 48}, y == 40 ? 1.3 : 0.9);
    if (y < 40) return shaded({196, 186, 158}, stain);
    const double board = x % 16 == 0 ? 0.55 : x % 16 == 1 ? 1.15 : 1.0;
    return shaded({122, 86, 58}, stain * board * (y > 60 ? 0.7 : 1));
  });
  t.repeats = true;
  return t;
}

}  // namespace demos
