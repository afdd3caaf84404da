// Lines: a step of one pixel along the longer axis, both ends drawn. [docs/hardware.md#lines]
//
// One pixel at a time: neighbours lie in different rows. A kernel is the body below with its mode pinned.

#include <algorithm>
#include <array>
#include <utility>

#include "gpu/raster.h"
#include "gpu/rules.h"
#include "gpu/watch.h"

#if defined(__GNUC__) && defined(NDEBUG)
#define LINE_STAGE [[gnu::always_inline]] inline
#else
#define LINE_STAGE inline
#endif

namespace gpu {

namespace {

struct LineMode {
  bool gouraud, dither;  ///< flat lines are dithered too
  bool masked;           ///< pixels with bit 15 stay; one that is blended is read anyway
  Blend blend;

  static constexpr std::size_t count = 2 * 2 * 2 * 5;
  static constexpr LineMode at(std::size_t i) {
    return {i % 2 != 0, i / 2 % 2 != 0, i / 4 % 2 != 0, static_cast<Blend>(i / 8)};
  }
  [[nodiscard]] constexpr std::size_t index() const {
    return static_cast<std::size_t>(gouraud) + 2 * static_cast<std::size_t>(dither) +
           4 * static_cast<std::size_t>(masked) + 8 * static_cast<std::size_t>(blend);
  }
};

struct LineJob {
  std::uint16_t* pixels;
  LinePath path;
  bool may_leave_area;
  const DrawState* state;
  std::uint16_t mask_set, mask_test;
};

/// (colour + offset) >> 3, limited to 0..31, by offset + 4 and colour.
constexpr auto levels = [] {
  std::array<std::array<std::uint8_t, 256>, 8> table{};
  for (int offset = -4; offset < 4; ++offset) {
    for (int colour = 0; colour < 256; ++colour) {
      table[static_cast<std::size_t>(offset + 4)][static_cast<std::size_t>(colour)] =
          static_cast<std::uint8_t>(std::clamp(colour + offset, 0, 255) >> 3);
    }
  }
  return table;
}();

constexpr auto dither_levels = [] {
  std::array<std::array<std::uint8_t, 4>, 4> rows{};
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4; ++x) rows[y][x] = static_cast<std::uint8_t>(dither_matrix[y][x] + 4);
  }
  return rows;
}();

/// Three 5-bit channels at once; the top bit of each is added apart, so that no carry leaves a channel.
LINE_STAGE std::uint32_t blend(Blend how, std::uint32_t back, std::uint32_t front) {
  constexpr std::uint32_t top = 0x4210, low = 0x3def;
  const auto widen = [](std::uint32_t bits) { return (bits << 1) - (bits >> 4); };  // 10h -> 1Fh
  back &= 0x7fff;
  if (how == Blend::average) return (back & front) + (((back ^ front) & 0x7bde) >> 1);
  if (how == Blend::subtract) {
    const std::uint32_t difference = ((back | top) - (front & low)) ^ (~(back ^ front) & top);
    const std::uint32_t borrows = (~back & front) | (~(back ^ front) & difference);
    return difference & ~widen(borrows & top);
  }
  if (how == Blend::add_quarter) front = front >> 2 & 0x1ce7;
  const std::uint32_t sum = ((back & low) + (front & low)) ^ ((back ^ front) & top);
  const std::uint32_t carries = (back & front) | (~sum & (back | front));
  return sum | widen(carries & top);
}

LINE_STAGE bool is_inside(const DrawState& state, int x, int y) {
  return x >= state.left() && x <= state.right() && y >= state.top() && y <= state.bottom() &&
         !state.skips(y);
}

/// Nobody watches.
struct Nobody {
  void note(std::size_t, std::uint16_t, std::uint32_t, std::uint32_t, bool) const {}
};

struct Watcher {
  Watch watch;
  void note(std::size_t place, std::uint16_t before, std::uint32_t after, std::uint32_t fragment,
            bool blended) const {
    watch.note({.pixel = static_cast<std::uint32_t>(place),
                .before = before,
                .after = static_cast<std::uint16_t>(after),
                .fragment = static_cast<std::uint16_t>(fragment),
                .blended = blended});
  }
};

template <class Observer>
LINE_STAGE void draw_body(LineMode m, const LineJob& job, const Observer& observer) {
  std::int64_t x = job.path.x, y = job.path.y;
  std::int32_t r = job.path.colour[0], g = job.path.colour[1], b = job.path.colour[2];
  for (int i = 0; i <= job.path.steps; ++i) {
    const auto column = static_cast<std::uint32_t>(x >> 32) & 2047,
               row = static_cast<std::uint32_t>(y >> 32) & 2047;
    if (!job.may_leave_area || is_inside(*job.state, static_cast<int>(column), static_cast<int>(row))) {
      const auto& level = levels[m.dither ? dither_levels[row & 3][column & 3] : 4];
      const auto channel = [&level](std::int32_t c) {
        return std::uint32_t{level[static_cast<std::uint32_t>(c) >> 12]};
      };
      const std::uint32_t pixel = channel(r) | channel(g) << 5 | channel(b) << 10;
      const std::size_t place = Vram::offset(static_cast<int>(column), static_cast<int>(row));
      const std::uint16_t back = job.pixels[place];
      if (!m.masked || (back & job.mask_test) == 0) {
        const bool blends = m.blend != Blend::opaque;
        const std::uint32_t result = (blends ? blend(m.blend, back, pixel) : pixel) | job.mask_set;
        observer.note(place, back, result, pixel | job.mask_set, blends);
        job.pixels[place] = static_cast<std::uint16_t>(result);
      }
    }
    x += job.path.step_x;
    y += job.path.step_y;
    if (m.gouraud) {
      r += job.path.step_c[0];
      g += job.path.step_c[1];
      b += job.path.step_c[2];
    }
  }
}

template <std::size_t index>
void line_kernel(const LineJob& job) {
  draw_body(LineMode::at(index), job, Nobody());
}

constexpr auto line_kernels = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<void (*)(const LineJob&), LineMode::count>{&line_kernel<I>...};
}
(std::make_index_sequence<LineMode::count>());

}  // namespace

std::uint64_t line_pixels(const Primitive& primitive) {
  LinePath path;
  if (!put_line_path(path, primitive)) return 0;
  std::uint64_t pixels = 0;
  for (int i = 0; i <= path.steps; ++i, path.x += path.step_x, path.y += path.step_y) {
    const int column = static_cast<int>(path.x >> 32) & 2047, row = static_cast<int>(path.y >> 32) & 2047;
    pixels += is_inside(primitive.state, column, row) ? 1 : 0;
  }
  return pixels;
}

void draw_line(const Surface& surface, const Primitive& primitive) {
  LineJob job;
  if (!put_line_path(job.path, primitive)) {
    ++surface.counters.discarded;
    return;
  }
  const DrawState& state = primitive.state;
  const Vertex &a = primitive.vertices[0], &b = primitive.vertices[1];
  job.pixels = surface.vram.pixels().data();
  job.may_leave_area = std::min(a.x, b.x) < state.left() || std::max(a.x, b.x) > state.right() ||
                       std::min(a.y, b.y) < state.top() || std::max(a.y, b.y) > state.bottom() ||
                       state.skipped_rows != SkippedRows::none;
  job.state = &state;
  job.mask_set = state.mask_set();
  job.mask_test = state.mask_test();
  const LineMode mode{primitive.is_gouraud(), is_dithered(primitive), state.mask_test() != 0,
                      blend_of(primitive)};
  if (surface.trace != nullptr) {
    draw_body(mode, job, Watcher{{surface.trace, surface.draw, 0}});
  } else {
    line_kernels[mode.index()](job);
  }
}

}  // namespace gpu
