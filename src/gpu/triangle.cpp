// Triangles: edges, gradients, rows. Set-up decides the speed of small ones, so it divides once, in floating
// point that gives the hardware's integer quotients exactly.

#include <algorithm>
#include <array>
#include <cmath>

#include "gpu/columns.h"
#include "gpu/depth_setup.h"
#include "gpu/edge.h"
#include "gpu/kernels.h"
#include "gpu/setup.h"

namespace gpu {

namespace {

using Three = std::array<const Vertex*, 3>;

/// Rows first .. last-1 between two edges. Coordinates outside 11 bits wrap for the test and the store, not
/// for the gradients.
void add_rows(SpanList& list, const DrawState& state, Edge left, Edge right, int first, int last,
              Point core) {
  const int area_left = state.left(), area_end = state.right() + 1, top = state.top(),
            bottom = state.bottom();
  const bool skips = state.skipped_rows != SkippedRows::none;
  for (int row = first; row < last; ++row, left.x += left.step, right.x += right.step) {
    const int y = sign_extend_11(static_cast<std::uint32_t>(row));
    if (y < top || y > bottom) continue;
    const int start = left.column(), width = right.column() - start;
    const int x = sign_extend_11(static_cast<std::uint32_t>(start));
    const int from = std::max(x, area_left), to = std::min(x + width, area_end);
    if (from >= to || (skips && state.skips(y))) continue;
    list.add(from, y, to - from, start + (from - x) - core.x, row - core.y);
  }
}

/// Top to bottom. Returns how many spans lie above the middle vertex.
std::size_t add_spans(SpanList& list, const DrawState& state, const Corners& sorted, Point core) {
  const auto& [top, middle, bottom] = sorted;
  Edge along(top, bottom);
  const bool middle_is_right = doubled_area(sorted) > 0;
  const auto add_half = [&](Point from, Point to) {
    if (from.y == to.y) return;
    const Edge across(from, to);
    add_rows(list, state, middle_is_right ? along : across, middle_is_right ? across : along, from.y, to.y,
             core);
    along.x += along.step * (to.y - from.y);
  };
  add_half(top, middle);
  const std::size_t upper = list.count;
  add_half(middle, bottom);
  return upper;
}

/// Cuts the spans to the limits and drops what is outside. Returns how many of the first `upper` are left.
std::size_t restrict_to(SpanList& list, const Limits& limits, const DrawState& state, Point core,
                        std::size_t upper) {
  std::size_t kept = 0, kept_upper = 0;
  for (std::size_t i = 0; i < list.count; ++i) {
    if (i == upper) kept_upper = kept;
    Span span = list.spans[i];
    const Columns limit = limits.at(span.dy + core.y - state.offset_y());
    const int start = span.dx + core.x - state.offset_x();  // as transmitted
    const int from = std::max(start, limit.left), to = std::min(start + span.count, limit.right);
    if (from >= to) continue;
    span.x = static_cast<std::int16_t>(span.x + from - start);
    span.dx = static_cast<std::int16_t>(span.dx + from - start);
    span.count = static_cast<std::int16_t>(to - from);
    list.spans[kept++] = span;
  }
  if (upper >= list.count) kept_upper = kept;
  list.count = kept;
  return kept_upper;
}

/// Where the spans lie; all of the drawing area if a coordinate wraps.
Box drawn_box(const DrawState& state, const Corners& c, const SpanList& list) {
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  const int top = list.spans[0].y, bottom = list.spans[list.count - 1].y;
  if (left < -1024 || right > 1023 || top > bottom)
    return {state.left(), state.top(), state.right(), state.bottom()};
  return {std::max(left, state.left()), top, std::min(right, state.right()), bottom};
}

/// Rows run away from the core vertex; lower part first unless it is on top. [docs/hardware.md#row-order]
void order_from_core(SpanList& list, std::size_t upper, const Corners& sorted, Point core) {
  if (core == sorted[0]) return;
  const auto begin = list.spans.begin(), end = begin + static_cast<std::ptrdiff_t>(list.count);
  const auto middle = begin + static_cast<std::ptrdiff_t>(upper);
  if (core == sorted[1]) {
    std::reverse(begin, middle);
    std::rotate(begin, middle, end);
  } else {
    std::reverse(begin, end);
  }
}

/// trunc(numerator * 4096 / area), one division for all gradients of a triangle. Half a unit is added to the
/// product's magnitude first: the exact quotient then lies 1/2 / area or more from every integer, while that
/// of doubles, of magnitude below 2^31 / area, goes wrong by less than 2^-20 / area.
class Quotient {
 public:
  explicit Quotient(int area) : factor_(4096.0 / area) {}
  [[nodiscard]] std::uint32_t of(int numerator) const {
    const double n = numerator;
    constexpr double half = 0.5 / 4096;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>((n + std::copysign(half, n)) * factor_));
  }

 private:
  double factor_;
};

/// Gradients of n attributes, 12 bits of fraction. [docs/hardware.md#attribute-interpolation]
template <std::size_t n>
void put_gradients(std::array<Gradient*, n> out, const Three& t, const Vertex& core, int area,
                   std::array<std::uint8_t Vertex::*, n> fields) {
  const int y10 = t[1]->y - t[0]->y, y21 = t[2]->y - t[1]->y;
  const int x10 = t[1]->x - t[0]->x, x21 = t[2]->x - t[1]->x;
  const Quotient quotient(area);
  for (std::size_t i = 0; i < n; ++i) {
    const int f10 = t[1]->*fields[i] - t[0]->*fields[i], f21 = t[2]->*fields[i] - t[1]->*fields[i];
    *out[i] = {.start = (std::uint32_t{core.*fields[i]} << 24) + (1U << 23),
               .dx = quotient.of(f10 * y21 - f21 * y10) << 12,
               .dy = quotient.of(x10 * f21 - x21 * f10) << 12};
  }
}

void put_gradients(Job& job, const Mode& mode, const Three& t, const Vertex& core, int area) {
  ColourGradients& c = job.shade;
  TextureGradients& x = job.texel;
  const bool is_textured = mode.surface.texture != TexelFormat::none;
  if (mode.surface.shade == Shade::gouraud && is_textured) {
    put_gradients<5>({&c.r, &c.g, &c.b, &x.u, &x.v}, t, core, area,
                     {&Vertex::r, &Vertex::g, &Vertex::b, &Vertex::u, &Vertex::v});
  } else if (mode.surface.shade == Shade::gouraud) {
    put_gradients<3>({&c.r, &c.g, &c.b}, t, core, area, {&Vertex::r, &Vertex::g, &Vertex::b});
  } else if (is_textured) {
    put_gradients<2>({&x.u, &x.v}, t, core, area, {&Vertex::u, &Vertex::v});
  }
}

/// Large surfaces hide large ones for whole rows, and to ask costs less than to shade; small ones are not
/// worth it.
void cut_hidden(const DepthJob& depth, SpanList& list, const Corners& c) {
  constexpr int least = 40;
  const auto [left, right] = std::minmax({c[0].x, c[1].x, c[2].x});
  if (right - left < least) return;
  list.count = operations().cut_hidden(depth, {list.spans.data(), list.count}, least);
}

void draw_triangle(const Surface& surface, const Primitive& primitive, Pass pass, const Mode& mode, Job& job,
                   const Three& t) {
  const Corners corners{{{t[0]->x, t[0]->y}, {t[1]->x, t[1]->y}, {t[2]->x, t[2]->y}}};
  if (is_too_large(corners)) {
    ++surface.counters.discarded;
    return;
  }
  const int area = doubled_area(corners);
  if (area == 0) return;
  ++surface.counters.triangles;
  const std::size_t core = core_vertex(t[0]->x, t[1]->x, t[2]->x);
  const Corners sorted = sorted_by_row(corners);
  // Before the spans: the processor divides while it counts rows.
  put_gradients(job, mode, t, *t[core], area);
  if (pass != Pass::console) put_depth(job.depth, *surface.depth, primitive, t, *t[core], pass);
  SpanList list;
  std::size_t upper = add_spans(list, primitive.state, sorted, corners[core]);
  if (surface.limits != nullptr)
    upper = restrict_to(list, *surface.limits, primitive.state, corners[core], upper);
  if (list.count == 0) return;
  if (pass == Pass::opaque) {
    const Box box = drawn_box(primitive.state, corners, list);
    surface.depth->touch(box.left, box.top, box.right, box.bottom);
  }
  bool in_order = false;
  if (mode.surface.texture != TexelFormat::none) {
    in_order = samples_what_it_draws(primitive.state, drawn_box(primitive.state, corners, list));
    if (in_order) order_from_core(list, upper, sorted, corners[core]);
    job.page.side_by_side = !in_order && has_adjacent_texels(job, mode.surface.texture);
  }
  if (pass != Pass::console && job.depth.is_fixed && !in_order && surface.trace == nullptr)
    cut_hidden(job.depth, list, corners);
  run(surface, mode, job, list.all(), in_order);
}

std::uint64_t triangle_pixels(const DrawState& state, const Three& t) {
  const Corners corners{{{t[0]->x, t[0]->y}, {t[1]->x, t[1]->y}, {t[2]->x, t[2]->y}}};
  if (is_too_large(corners) || doubled_area(corners) == 0) return 0;
  SpanList list;
  add_spans(list, state, sorted_by_row(corners), corners[0]);
  std::uint64_t pixels = 0;
  for (const Span& span : list.all()) pixels += static_cast<std::uint64_t>(span.count);
  return pixels;
}

}  // namespace

std::uint64_t polygon_pixels(const Primitive& primitive) {
  const auto& v = primitive.vertices;
  const std::uint64_t first = triangle_pixels(primitive.state, {&v[0], &v[1], &v[2]});
  return primitive.is_quad() ? first + triangle_pixels(primitive.state, {&v[1], &v[2], &v[3]}) : first;
}

void draw_polygon(const Surface& surface, const Primitive& primitive, Pass pass) {
  Mode mode = mode_of(primitive, is_dithered(primitive));
  mode.depth = pass != Pass::console;
  if (pass == Pass::opaque) {
    mode.blend = Blend::opaque;
    mode.masked = primitive.state.mask_test() != 0;
  }
  Job job;
  put_constants(job, surface, primitive);
  const auto& v = primitive.vertices;
  draw_triangle(surface, primitive, pass, mode, job, {&v[0], &v[1], &v[2]});
  if (!primitive.is_quad()) return;
  Surface second = surface;
  second.half = 1;
  draw_triangle(second, primitive, pass, mode, job, {&v[1], &v[2], &v[3]});
}

}  // namespace gpu
