// Lines: a step of one pixel along the longer axis, both ends drawn. [ps1-tests lines]
//
// One pixel at a time: neighbours lie in different rows. A kernel is the body below with its mode pinned.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "gpu/raster.h"
#include "gpu/setup.h"
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
  std::int64_t x, y, step_x, step_y;      // 32.32
  std::array<std::int32_t, 3> c, step_c;  // 8.12
  int steps;
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

constexpr std::uint8_t dither_rows[4][4] = {{0, 4, 1, 5}, {6, 2, 7, 3}, {1, 5, 0, 4}, {7, 3, 6, 2}};

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
  std::int64_t x = job.x, y = job.y;
  std::int32_t r = job.c[0], g = job.c[1], b = job.c[2];
  for (int i = 0; i <= job.steps; ++i) {
    const int column = static_cast<int>(x >> 32) & 2047, row = static_cast<int>(y >> 32) & 2047;
    if (!job.may_leave_area || is_inside(*job.state, column, row)) {
      const auto& level = levels[m.dither ? dither_rows[row & 3][column & 3] : 4];
      const auto channel = [&level](std::int32_t c) {
        return std::uint32_t{level[static_cast<std::uint32_t>(c) >> 12]};
      };
      const std::uint32_t pixel = channel(r) | channel(g) << 5 | channel(b) << 10;
      const std::size_t place = Vram::offset(column, row);
      const std::uint16_t back = job.pixels[place];
      if (m.how == Blend::opaque || (back & job.mask_test) == 0) {
        const bool blends = m.blend != Blend::opaque;
        const std::uint32_t result = (blends ? blend(m.blend, back, pixel) : pixel) | job.mask_set;
        observer.note(place, back, result, pixel | job.mask_set, blends);
        job.pixels[place] = static_cast<std::uint16_t>(result);
      }
    }
    x += job.step_x;
    y += job.step_y;
    if (m.gouraud) {
      r += job.step_c[0];
      g += job.step_c[1];
      b += job.step_c[2];
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

/// Quotients by the number of steps, one division for all of a line. Half a unit is added to the numerator's
/// magnitude first: numerators are below 2^43 and there are at most 1023 steps, so no error of the doubles
/// reaches an integer.
class PerStep {
 public:
  explicit PerStep(int steps) : factor_(steps == 0 ? 0 : 1.0 / steps), away_(std::max(steps - 1, 0)) {}
  /// 32.32, rounded away from zero so that the last step arrives.
  [[nodiscard]] std::int64_t distance(int pixels) const {
    return divide(pixels * 4294967296.0, pixels == 0 ? 0 : away_);
  }
  /// 8.12, rounded towards zero.
  [[nodiscard]] std::int32_t colour(int difference) const {
    return static_cast<std::int32_t>(divide(difference * 4096.0, 0));
  }

 private:
  [[nodiscard]] std::int64_t divide(double numerator, double more) const {
    return static_cast<std::int64_t>((numerator + std::copysign(more + 0.5, numerator)) * factor_);
  }
  double factor_, away_;
};

}  // namespace

void draw_line(const Surface& surface, const Primitive& primitive) {
  const Vertex *a = primitive.vertices.data(), *b = a + 1;
  const int width = std::abs(b->x - a->x), height = std::abs(b->y - a->y);
  if (width > 1023 || height > 511) {
    ++surface.counters.discarded;
    return;
  }
  const int steps = std::max(width, height);
  if (steps > 0 && a->x >= b->x) std::swap(a, b);

  const DrawState& state = primitive.state;
  constexpr std::int64_t one = std::int64_t{1} << 32;
  const bool is_gouraud = primitive.is_gouraud();
  const auto start = [](std::uint8_t c) { return std::int32_t{c} * 4096 + 2048; };
  const PerStep per_step(steps);
  const std::int64_t step_x = per_step.distance(b->x - a->x), step_y = per_step.distance(b->y - a->y);
  LineJob job{
      .pixels = surface.vram.pixels().data(),
      .x = a->x * one + one / 2 - 1024,
      .y = a->y * one + one / 2 - (step_y < 0 ? 1024 : 0),
      .step_x = step_x,
      .step_y = step_y,
      .c = {start(a->r), start(a->g), start(a->b)},
      .step_c = {},
      .steps = steps,
      .may_leave_area = a->x < state.left() || b->x > state.right() || std::min(a->y, b->y) < state.top() ||
                        std::max(a->y, b->y) > state.bottom() || state.skipped_rows != SkippedRows::none,
      .state = &state,
      .mask_set = state.mask_set(),
      .mask_test = state.mask_test(),
  };
  if (is_gouraud) {
    job.step_c = {per_step.colour(b->r - a->r), per_step.colour(b->g - a->g), per_step.colour(b->b - a->b)};
  }

  const LineMode mode{is_gouraud, state.dithers(), state.mask_test() != 0, blend_of(primitive)};
  if (surface.trace != nullptr) {
    draw_body(mode, job, Watcher{{surface.trace, surface.draw, 0}});
  } else {
    line_kernels[mode.index()](job);
  }
}

}  // namespace gpu
