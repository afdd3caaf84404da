#include "gpu/raster.h"

#include <algorithm>
#include <array>
#include <vector>

#include "gpu/coverage.h"

namespace gpu {

namespace {

using u8 = std::uint8_t;
using u16 = std::uint16_t;
using u32 = std::uint32_t;

constexpr int dither_table[4][4] = {{-4, 0, -3, 1}, {2, -2, 3, -1}, {-3, 1, -4, 0}, {3, -1, 2, -2}};

struct Colour {
  int r, g, b;
};

void store(const Surface& s, int x, int y, u16 pixel, u16 fragment, bool blended) {
  u16& target = s.vram.at(x, y);
  if (s.trace != nullptr) {
    const auto at = static_cast<u32>(Vram::offset(x, y));
    s.trace->last_writer[at] = s.draw + 1;
    if (s.trace->keep_history) {
      s.trace->history.push_back({.pixel = at,
                                  .draw = s.draw,
                                  .before = target,
                                  .after = pixel,
                                  .fragment = fragment,
                                  .half = s.half,
                                  .blended = blended});
    }
  }
  target = pixel;
}

int blend_channel(Blend mode, int b, int f) {
  switch (mode) {
    case Blend::average:
      return (b + f) >> 1;
    case Blend::add:
      return std::min(31, b + f);
    case Blend::subtract:
      return std::max(0, b - f);
    default:
      return std::min(31, b + (f >> 2));
  }
}

u16 blend(Blend mode, u16 b, u16 f) {
  int result = 0;
  for (int shift = 0; shift < 15; shift += 5) {
    result |= blend_channel(mode, b >> shift & 31, f >> shift & 31) << shift;
  }
  return static_cast<u16>(result);
}

u16 fetch(const Surface& s, const DrawState& state, int u, int v) {
  u = (u & state.window_keep_u()) | state.window_set_u();
  v = (v & state.window_keep_v()) | state.window_set_v();
  const int y = state.page_y() + v;
  switch (state.texel_format()) {
    case TexelFormat::clut4:
      return s.clut[s.vram.at(state.page_x() + (u >> 2), y) >> 4 * (u & 3) & 15];
    case TexelFormat::clut8:
      return s.clut[s.vram.at(state.page_x() + (u >> 1), y) >> 8 * (u & 1) & 255];
    default:
      return s.vram.at(state.page_x() + u, y);
  }
}

/// Everything from 6.1 to 6.6 for one pixel inside the drawing area.
void shade_pixel(const Surface& s, const Primitive& p, int x, int y, Colour c, int u, int v, bool dither) {
  const DrawState& state = p.state;
  const u16 before = s.vram.at(x, y);
  if ((before & state.mask_test()) != 0) return;
  const int d = dither ? dither_table[y & 3][x & 3] : 0;
  u16 texel = 0;
  u16 colour = 0;
  if (p.is_textured()) {
    texel = fetch(s, state, u, v);
    if (texel == 0) return;
  }
  if (p.is_raw()) {
    colour = texel & 0x7fff;
  } else {
    const int in[3] = {c.r, c.g, c.b};
    for (int i = 0; i < 3; ++i) {
      const int m = p.is_textured() ? ((texel >> 5 * i & 31) * in[i]) >> 4 : in[i];
      colour = static_cast<u16>(colour | std::clamp((m + d) >> 3, 0, 31) << 5 * i);
    }
  }
  const bool blends = p.is_semi_transparent() && (!p.is_textured() || (texel & 0x8000) != 0);
  const auto top_bit = static_cast<u16>((texel & 0x8000) | state.mask_set());
  const u16 result = blends ? blend(state.blend(), before, colour) : colour;
  store(s, x, y, result | top_bit, colour | top_bit, blends);
}

/// The triangle's leftmost corner, ties as the hardware has them; gradients start there.
std::size_t core_vertex(const std::array<const Vertex*, 3>& t) {
  if (t[1]->x <= t[0]->x) return t[2]->x <= t[1]->x ? 2 : 1;
  return t[2]->x < t[0]->x ? 2 : 0;
}

struct Plane {
  u32 at_core = 0, dx = 0, dy = 0;
  [[nodiscard]] int at(int x, int y) const {
    return static_cast<int>((at_core + dx * static_cast<u32>(x) + dy * static_cast<u32>(y)) >> 24);
  }
};

Plane plane(const std::array<const Vertex*, 3>& t, std::size_t core, int area, u8 Vertex::*field) {
  const int f0 = t[0]->*field, f1 = t[1]->*field, f2 = t[2]->*field;
  const int nx = (f1 - f0) * (t[2]->y - t[1]->y) - (f2 - f1) * (t[1]->y - t[0]->y);
  const int ny = (t[1]->x - t[0]->x) * (f2 - f1) - (t[2]->x - t[1]->x) * (f1 - f0);
  const int start = t[core]->*field;
  return {(static_cast<u32>(start) * 4096 + 2048) << 12, static_cast<u32>(nx * 4096 / area) << 12,
          static_cast<u32>(ny * 4096 / area) << 12};
}

void draw_triangle(const Surface& s, const Primitive& p, std::array<const Vertex*, 3> t, Counters& counters) {
  const Corners corners{{{t[0]->x, t[0]->y}, {t[1]->x, t[1]->y}, {t[2]->x, t[2]->y}}};
  if (is_too_large(corners)) {
    ++counters.discarded;
    return;
  }
  const int area = doubled_area(corners);
  if (area == 0) return;
  ++counters.triangles;
  const std::size_t core = core_vertex(t);
  const Plane u = plane(t, core, area, &Vertex::u), v = plane(t, core, area, &Vertex::v);
  const Plane r = plane(t, core, area, &Vertex::r), g = plane(t, core, area, &Vertex::g),
              b = plane(t, core, area, &Vertex::b);
  const DrawState& state = p.state;
  const bool dither = state.dithers() && (p.is_gouraud() || (p.is_textured() && !p.is_raw()));
  const Corners sorted = sorted_by_row(corners);
  const auto row = [&](int y) {
    const int store_y = sign_extend_11(static_cast<u32>(y));
    if (store_y < state.top() || store_y > state.bottom() || state.skips(store_y)) return;
    Columns columns = covered_columns(sorted, y);
    if (s.limits != nullptr) {
      const Columns limit = s.limits->at(y - state.offset_y());
      columns.left = std::max(columns.left, limit.left + state.offset_x());
      columns.right = std::min(columns.right, limit.right + state.offset_x());
    }
    int store_x = sign_extend_11(static_cast<u32>(columns.left));
    for (int x = columns.left; x < columns.right; ++x, ++store_x) {
      if (store_x < state.left() || store_x > state.right()) continue;
      const int dx = x - t[core]->x, dy = y - t[core]->y;
      const Colour c = p.is_gouraud() ? Colour{r.at(dx, dy), g.at(dx, dy), b.at(dx, dy)}
                                      : Colour{p.vertices[0].r, p.vertices[0].g, p.vertices[0].b};
      shade_pixel(s, p, store_x, store_y, c, u.at(dx, dy), v.at(dx, dy), dither);
    }
  };
  // Rows run away from the core vertex; the lower part comes first unless the core is on top.
  const Point core_point = corners[core];
  if (core_point == sorted[0]) {
    for (int y = sorted[0].y; y < sorted[2].y; ++y) row(y);
  } else if (core_point == sorted[1]) {
    for (int y = sorted[1].y; y < sorted[2].y; ++y) row(y);
    for (int y = sorted[1].y - 1; y >= sorted[0].y; --y) row(y);
  } else {
    for (int y = sorted[2].y - 1; y >= sorted[0].y; --y) row(y);
  }
}

}  // namespace

void draw_polygon(const Surface& s, const Primitive& p, Counters& counters) {
  const auto& v = p.vertices;
  draw_triangle(s, p, {&v[0], &v[1], &v[2]}, counters);
  if (!p.is_quad()) return;
  Surface second = s;
  second.half = 1;
  draw_triangle(second, p, {&v[1], &v[2], &v[3]}, counters);
}

void draw_rectangle(const Surface& s, const Primitive& p) {
  const DrawState& state = p.state;
  const Vertex& corner = p.vertices[0];
  const int u0 = state.flips_x() ? corner.u | 1 : corner.u;
  const int du = state.flips_x() ? -1 : 1, dv = state.flips_y() ? -1 : 1;
  for (int j = 0; j < p.height; ++j) {
    const int y = corner.y + j;
    if (y < state.top() || y > state.bottom() || state.skips(y)) continue;
    for (int i = 0; i < p.width; ++i) {
      const int x = corner.x + i;
      if (x < state.left() || x > state.right()) continue;
      shade_pixel(s, p, x, y, {corner.r, corner.g, corner.b}, (u0 + i * du) & 255, (corner.v + j * dv) & 255,
                  false);
    }
  }
}

void draw_line(const Surface& s, const Primitive& p, Counters& counters) {
  const Vertex *a = &p.vertices[0], *b = &p.vertices[1];
  if (std::abs(b->x - a->x) > 1023 || std::abs(b->y - a->y) > 511) {
    ++counters.discarded;
    return;
  }
  const int k = std::max(std::abs(b->x - a->x), std::abs(b->y - a->y));
  if (k > 0 && a->x >= b->x) std::swap(a, b);
  const auto step = [k](std::int64_t d) {
    return k == 0 ? 0 : (d * (std::int64_t{1} << 32) + (d < 0 ? -(k - 1) : d > 0 ? k - 1 : 0)) / k;
  };
  const std::int64_t step_x = step(b->x - a->x), step_y = step(b->y - a->y);
  constexpr std::int64_t one = std::int64_t{1} << 32;
  std::int64_t x = a->x * one + one / 2 - 1024, y = a->y * one + one / 2 - (step_y < 0 ? 1024 : 0);
  const int from[3] = {a->r, a->g, a->b}, to[3] = {b->r, b->g, b->b};
  int c[3], step_c[3];
  for (int i = 0; i < 3; ++i) {
    c[i] = from[i] * 4096 + 2048;
    step_c[i] = k == 0 ? 0 : (to[i] - from[i]) * 4096 / k;
  }
  const DrawState& state = p.state;
  for (int i = 0; i <= k; ++i) {
    const int px = static_cast<int>(x >> 32) & 2047, py = static_cast<int>(y >> 32) & 2047;
    if (px >= state.left() && px <= state.right() && py >= state.top() && py <= state.bottom() &&
        !state.skips(py)) {
      const Colour colour = p.is_gouraud() ? Colour{c[0] >> 12, c[1] >> 12, c[2] >> 12}
                                           : Colour{p.vertices[0].r, p.vertices[0].g, p.vertices[0].b};
      shade_pixel(s, p, px, py, colour, 0, 0, state.dithers());
    }
    x += step_x;
    y += step_y;
    for (int j = 0; j < 3; ++j) c[j] += step_c[j];
  }
}

void fill_rectangle(const Surface& s, const Primitive& p) {
  const auto colour =
      static_cast<u16>((p.command >> 3 & 31) | (p.command >> 6 & 0x3e0) | (p.command >> 9 & 0x7c00));
  for (int j = 0; j < p.height; ++j) {
    const int y = (p.vertices[0].y + j) & 511;
    if (p.state.skips(y)) continue;
    for (int i = 0; i < p.width; ++i) store(s, p.vertices[0].x + i, y, colour, colour, false);
  }
}

void copy_rectangle(const Surface& s, const Primitive& p) {
  std::vector<u16> line(static_cast<std::size_t>(p.width));
  for (int j = 0; j < p.height; ++j) {
    for (int i = 0; i < p.width; ++i) {
      line[static_cast<std::size_t>(i)] = s.vram.at(p.vertices[1].x + i, p.vertices[1].y + j);
    }
    for (int i = 0; i < p.width; ++i) {
      store_transferred(s, p.state, p.vertices[0].x + i, p.vertices[0].y + j,
                        line[static_cast<std::size_t>(i)]);
    }
  }
}

void store_transferred(const Surface& s, const DrawState& state, int x, int y, u16 pixel) {
  if ((s.vram.at(x, y) & state.mask_test()) != 0) return;
  const auto stored = static_cast<u16>(pixel | state.mask_set());
  store(s, x, y, stored, stored, false);
}

}  // namespace gpu
