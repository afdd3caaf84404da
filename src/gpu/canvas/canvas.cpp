#include "gpu/canvas/canvas.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "gpu/canvas/sample_pattern.h"
#include "gpu/canvas/stages.h"
#include "gpu/columns.h"
#include "gpu/rules.h"

namespace gpu::canvas {
namespace {

std::size_t area(const Options& o) {
  return static_cast<std::size_t>(o.width) * static_cast<std::size_t>(o.height) *
         static_cast<std::size_t>(o.scale) * static_cast<std::size_t>(o.scale);
}

std::size_t samples_per_pixel(const Options& o) { return std::max<std::size_t>(1, o.samples.size()); }

FogRamp ramp(const Fog& fog) {
  const double range = fog.far_z - fog.near_z;
  return {{fog.r, fog.g, fog.b}, fog.far_z / range, -fog.far_z * fog.near_z / range};
}

/// Texels between two coordinates, eighths of a texel. What repeats, as more texels than the window's period
/// do, may be filtered with the next one on either side.
struct Texels {
  int first, last;
  Texels(int low, int high, int period) : first((low + 4) >> 3), last(std::max(first, (high + 3) >> 3)) {
    if (last - first < period) return;
    first = low >> 3;
    last = (high + 7) >> 3;
  }
};

/// Texels that a polygon's corners span, and the mip level whose texels are as large.
TexelBox texel_box(const Primitive& p, const TextureView& view) {
  constexpr int beyond = 1 << 12;
  int u_low = beyond, u_high = -beyond, v_low = beyond, v_high = -beyond;
  for (std::size_t i = 0; i < p.vertex_count; ++i) {
    const Vertex& vertex = p.vertices[i];
    const int u = 8 * vertex.u + (p.has_texel_rests ? vertex.du : 0);
    const int v = 8 * vertex.v + (p.has_texel_rests ? vertex.dv : 0);
    u_low = std::min(u_low, u);
    u_high = std::max(u_high, u);
    v_low = std::min(v_low, v);
    v_high = std::max(v_high, v);
  }
  const Texels u(u_low, u_high, p.has_texel_rests ? view.keep_u + 1 : beyond);
  const Texels v(v_low, v_high, p.has_texel_rests ? view.keep_v + 1 : beyond);
  TexelBox box{u.first, u.last, v.first, v.last, 32 * u_low, 32 * u_high, 32 * v_low, 32 * v_high, 0};
  const auto span = static_cast<unsigned>(std::max(box.u_max - box.u_min, box.v_max - box.v_min));
  box.coarsest_level = std::max(0, static_cast<int>(std::bit_width(span)) - 1);
  return box;
}

}  // namespace

std::uint64_t Canvas::frame_bytes(const Options& o) {
  const std::uint64_t words = samples_per_pixel(o) * o.layers.size() * (o.depth ? 2 : 1) + (o.trace ? 2 : 0);
  return area(o) * words * sizeof(Pixel);
}

Canvas::Canvas(Options options)
    : options_(std::move(options)),
      grid_{0, 0, options_.scale, options_.fraction_bits},
      layer_points_(options_.layers),
      sample_points_(options_.samples) {
  const Options& o = options_;
  assert(o.width > 0 && o.width <= 1024 && o.height > 0 && o.height <= 512);
  assert(o.scale >= 1 && o.scale <= 8 && std::has_single_bit(static_cast<unsigned>(o.scale)));
  assert(!o.layers.empty() && o.samples.size() <= 8 && (o.samples.empty() || o.layers.size() == 1));
  assert(!o.temporal || (o.layers.size() == 1 && o.samples.empty()));
  layers_.resize(o.layers.size());
  for (Layer& layer : layers_) {
    layer.colour.resize(area(o) * samples_per_pixel(o));
    if (o.depth) layer.depth.resize(layer.colour.size(), DepthPlane::empty);
  }
  if (o.trace) {
    ids_.resize(area(o));
    texcoords_.resize(area(o));
  }
  if (o.scatter_seed != 0) {
    for (std::uint32_t pattern = 0; pattern < scatter_patterns; ++pattern) {
      const auto points = random_samples(static_cast<int>(o.layers.size()), o.scatter_seed + pattern);
      scatter_.insert(scatter_.end(), points.begin(), points.end());
    }
  }
  if (o.depth) depth_.emplace(*o.depth);
  if (o.fog) fog_ = ramp(*o.fog);
}

void Canvas::begin_frame(int x, int y) {
  grid_.x = watch_.x = x;
  grid_.y = watch_.y = y;
  if (has_depths_) {
    for (Layer& layer : layers_) std::ranges::fill(layer.depth, DepthPlane::empty);
  }
  has_depths_ = false;
  std::ranges::fill(ids_, 0);
  if (options_.temporal) layer_points_[0] = temporal_jitter(frames_++);
}

bool Canvas::covers(const DrawState& state) const {
  const Clip inside = clip(state);
  return !inside.columns.is_empty() && !inside.rows.is_empty();
}

bool Canvas::draw(const Primitive& p, Pass pass, const Vram& vram, const std::uint16_t* clut,
                  std::uint32_t id) {
  if (!covers(p.state)) {
    const DrawState& state = p.state;
    mips_.forget(
        {state.left(), state.top(), state.right() - state.left() + 1, state.bottom() - state.top() + 1});
    return false;
  }
  const Clip inside = clip(p.state);
  const Paint how = paint(p, pass, vram, clut, id);
  has_depths_ = has_depths_ || pass == Pass::opaque;
  watch_.draw = id - 1;
  watch_.half = 0;
  switch (p.kind) {
    case Kind::polygon:
      polygon(p, how, inside);
      return true;
    case Kind::rectangle:
      rectangle(p, how, inside);
      return true;
    case Kind::line:
      line(p, how, inside);
      return true;
    default:
      return false;
  }
}

void Canvas::put_into(std::span<std::uint16_t> vram) const {
  assert(options_.can_be_watched() && vram.size() == Vram::size);
  const auto& colour = layers_[0].colour;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const int x = static_cast<int>(i) % options_.width, y = static_cast<int>(i) / options_.width;
    vram[Vram::offset(grid_.x + x, grid_.y + y)] = to_16_bits(colour[i]);
  }
}

Target Canvas::target(std::size_t index) {
  Layer& layer = layers_[index];
  const Point& offset = layer_points_[index];
  Target t{.colour = layer.colour.data(),
           .depth = layer.depth.empty() ? nullptr : layer.depth.data(),
           .width = width(),
           .height = height(),
           .offset = offset,
           .samples = {}};
  if (index == 0 && options_.trace) {
    t.ids = ids_.data();
    t.texcoords = texcoords_.data();
  }
  if (watch_.trace != nullptr && options_.can_be_watched()) t.watch = &watch_;
  t.samples =
      sample_points_.empty() ? std::span<const Point>(&offset, 1) : std::span<const Point>(sample_points_);
  return t;
}

Canvas::Clip Canvas::clip(const DrawState& state) const {
  const auto side = [this](int first, int last, int origin, int size) {
    const Range inside = intersect({first - origin, last + 1 - origin}, {0, size});
    return Range{inside.begin * options_.scale, inside.end * options_.scale};
  };
  return {side(state.left(), state.right(), grid_.x, options_.width),
          side(state.top(), state.bottom(), grid_.y, options_.height)};
}

Paint Canvas::paint(const Primitive& p, Pass pass, const Vram& vram, const std::uint16_t* clut,
                    std::uint32_t id) {
  const DrawState& state = p.state;
  const bool is_polygon = p.kind == Kind::polygon;
  const bool deep = is_polygon && p.has_depth;
  Paint paint;
  paint.mode.depth = pass != Pass::console;
  paint.mode.trace = options_.trace;
  paint.mode.blend = blend_of(p);
  paint.raw = p.is_raw();
  paint.gouraud = is_polygon && p.is_gouraud();
  paint.perspective = deep && options_.perspective && (p.is_textured() || p.is_gouraud());
  paint.dither = options_.colour == Colour::bits15 && is_dithered(p);
  paint.mask_test = state.mask_test() != 0;
  paint.mask_set = state.mask_set() != 0 ? mask_bit : 0;
  paint.quantise = options_.colour == Colour::bits15 ? 0xf8f8f8 : 0xffffff;
  paint.pass = pass;
  paint.depth = paint.mode.depth ? &*depth_ : nullptr;
  paint.fog = deep && options_.fog ? &fog_ : nullptr;
  paint.phase_x = grid_.x * options_.scale;
  paint.phase_y = grid_.y * options_.scale;
  paint.id = id;
  if (!p.is_textured()) return paint;
  paint.mode.texture = state.texel_format();
  paint.texture = {&vram,
                   clut,
                   state.page_x(),
                   state.page_y(),
                   state.window_keep_u(),
                   state.window_keep_v(),
                   state.window_set_u(),
                   state.window_set_v(),
                   options_.colour == Colour::bits24};
  if (!is_polygon) return paint;
  paint.filter = options_.filter;
  paint.box = texel_box(p, paint.texture);
  paint.is_exact = p.has_texel_rests && p.is_textured();
  if (paint.filter >= Filter::mipmap) {
    paint.mips = &mips_.chain(paint.texture, state);
    // S layers are S finer pixels to the area of one: half a level for each doubling.
    paint.level_bias = -half_log2(static_cast<float>(options_.layers.size()));
  }
  return paint;
}

void Canvas::polygon(const Primitive& p, const Paint& paint, const Clip& clip) {
  const auto& v = p.vertices;
  watch_.half = 0;
  triangle(p, {&v[0], &v[1], &v[2]}, paint, clip);
  // A flat quad has the colour of its first vertex on both halves.
  if (p.is_quad()) {
    Vertex first = v[1];
    if (!p.is_gouraud()) {
      first.r = v[0].r;
      first.g = v[0].g;
      first.b = v[0].b;
    }
    watch_.half = 1;
    triangle(p, {&first, &v[2], &v[3]}, paint, clip);
  }
}

void Canvas::triangle(const Primitive& p, const Triangle& t, const Paint& paint, const Clip& clip) {
  if (is_too_large({{{t[0]->x, t[0]->y}, {t[1]->x, t[1]->y}, {t[2]->x, t[2]->y}}})) return;
  const std::array<Point, 3> corners{grid_.place(*t[0], p.has_fractions), grid_.place(*t[1], p.has_fractions),
                                     grid_.place(*t[2], p.has_fractions)};
  if (doubled_area(corners[0], corners[1], corners[2]) == 0) return;
  const bool with_inverse_z = paint.mode.depth || paint.perspective || paint.fog != nullptr;
  const Planes planes = make_planes(grid_, t, corners, paint, with_inverse_z);
  ++counters_.primitives;
  if (options_.samples.empty()) {
    rasterise(corners, planes, paint, clip, p.state);
  } else {
    rasterise_samples(corners, planes, paint, clip);
  }
}

namespace {

/// f(x, count) for pieces of `columns` no longer than a run.
template <class F>
void for_each_run(Range columns, F&& f) {
  for (int x = columns.begin; x < columns.end; x += run_length) f(x, std::min(run_length, columns.end - x));
}

Mode mode_for(const Target& target, Mode mode) {
  mode.trace = target.ids != nullptr || target.watch != nullptr;
  return mode;
}

}  // namespace

void Canvas::rasterise(const std::array<Point, 3>& corners, const Planes& planes, const Paint& paint,
                       const Clip& clip, const DrawState& state) {
  // From canvas pixels to those of the limits: before the drawing offset, from VRAM's corner.
  const int shift_x = (grid_.x - state.offset_x()) * options_.scale;
  const int shift_y = (grid_.y - state.offset_y()) * options_.scale;
  const auto inside = [&](Range columns, int y) {
    if (!limits_) return columns;
    const Columns limit = limits_->at(y + shift_y);
    return intersect(columns, {limit.left - shift_x, limit.right - shift_x});
  };
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    const Target to = target(i);
    Paint how = paint;
    how.mode = mode_for(to, paint.mode);
    if (!scatter_.empty()) {
      rasterise_scattered(to, i, corners, planes, how, clip);
      continue;
    }
    Coverage coverage(corners, to.offset, clip.rows);
    for (int y = coverage.rows().begin; y < coverage.rows().end; ++y) {
      for_each_run(intersect(inside(coverage.next(), y), clip.columns), [&](int x, int count) {
        draw_run(to, how, planes, {x, y, count}, counters_);
      });
    }
  }
}

/// Where a row of pixels may have samples inside: between the lines above and below them, and at corners that
/// lie there.
void Canvas::rasterise_scattered(const Target& to, std::size_t layer, const std::array<Point, 3>& corners,
                                 const Planes& planes, const Paint& paint, const Clip& clip) {
  constexpr std::int64_t half = units_per_pixel / 2;
  const Inside inside(corners);
  const Range rows = intersect(inside.rows(), clip.rows);
  std::array<Coverage, 2> lines{Coverage(corners, {0, -half}, clip.rows),
                                Coverage(corners, {0, half - 1}, clip.rows)};
  for (int y = rows.begin; y < rows.end; ++y) {
    Range any;
    for (Coverage& line : lines) {
      if (y < line.rows().begin || y >= line.rows().end) continue;
      const Range covered = line.next();
      any = unite(any, {covered.begin - 1, covered.end + 1});
    }
    for (const Point& corner : corners) {
      if (std::abs(corner.y - y * units_per_pixel) > half) continue;
      const auto column = static_cast<int>(floor_div(corner.x, units_per_pixel));
      any = unite(any, {column - 1, column + 2});
    }
    for_each_run(intersect(any, clip.columns), [&](int x, int count) {
      std::array<std::uint8_t, run_length> covered;
      std::array<Point, run_length> shaded_at;
      std::uint8_t some = 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const int column = x + static_cast<int>(i);
        const auto pattern = scatter_pattern(column, y, options_.scatter_seed);
        shaded_at[i] = scatter_[pattern * layers_.size() + layer];
        covered[i] =
            inside.contains({column * units_per_pixel + shaded_at[i].x, y * units_per_pixel + shaded_at[i].y})
                ? 1
                : 0;
        some |= covered[i];
      }
      if (some != 0) draw_run(to, paint, planes, {x, y, count, covered.data(), shaded_at.data()}, counters_);
    });
  }
}

void Canvas::rasterise_samples(const std::array<Point, 3>& corners, const Planes& planes, const Paint& paint,
                               const Clip& clip) {
  const Target to = target(0);
  const auto count = to.samples.size();
  std::array<Coverage, 8> at_sample;
  Coverage at_centre(corners, to.offset, clip.rows);
  Range rows = at_centre.rows();
  for (std::size_t s = 0; s < count; ++s) {
    at_sample[s] = Coverage(corners, to.samples[s], clip.rows);
    rows = unite(rows, at_sample[s].rows());
  }
  const auto take = [](Coverage& coverage, int y) {
    const Range r = coverage.rows();
    return y >= r.begin && y < r.end ? coverage.next() : Range{};
  };
  for (int y = rows.begin; y < rows.end; ++y) {
    const Range centre = take(at_centre, y);
    std::array<Range, 8> covered;
    Range any;
    Range all = centre;
    for (std::size_t s = 0; s < count; ++s) {
      covered[s] = take(at_sample[s], y);
      any = unite(any, covered[s]);
      all = intersect(all, covered[s]);
    }
    any = intersect(any, clip.columns);
    all = intersect(all, any);
    if (all.is_empty()) all = {any.end, any.end};
    for_each_run(all, [&](int x, int n) { draw_run(to, paint, planes, {x, y, n}, counters_); });
    // Where some samples are out, attributes are taken at the pixel's centre if it is covered, else at the
    // first covered sample: never outside the triangle, where they would run over.
    const auto draw_edge = [&](int x, int n) {
      std::array<std::uint8_t, run_length> bits{};
      std::array<Point, run_length> shaded_at;
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        const int px = x + static_cast<int>(i);
        for (std::size_t s = 0; s < count; ++s) {
          const bool in = px >= covered[s].begin && px < covered[s].end;
          bits[i] = static_cast<std::uint8_t>(bits[i] | (in ? 1U << s : 0U));
        }
        const bool centre_in = px >= centre.begin && px < centre.end;
        const auto first = static_cast<std::size_t>(std::countr_zero(bits[i])) % 8;
        shaded_at[i] = centre_in || bits[i] == 0 ? to.offset : to.samples[first];
      }
      draw_run(to, paint, planes, {x, y, n, bits.data(), shaded_at.data()}, counters_);
    };
    for_each_run({any.begin, all.begin}, draw_edge);
    for_each_run({all.end, any.end}, draw_edge);
  }
}

void Canvas::draw_block(const Paint& paint, const Planes& planes, Range columns, Range rows,
                        const Clip& clip) {
  const auto scaled = [this](Range r, int origin) {
    return Range{(r.begin - origin) * options_.scale, (r.end - origin) * options_.scale};
  };
  const Range x_range = intersect(scaled(columns, grid_.x), clip.columns);
  const Range y_range = intersect(scaled(rows, grid_.y), clip.rows);
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    Target to = target(i);
    to.offset = {};  // whole pixels: no layer sees them from aside
    Paint how = paint;
    how.mode = mode_for(to, paint.mode);
    for (int y = y_range.begin; y < y_range.end; ++y) {
      for_each_run(x_range, [&](int x, int n) { draw_run(to, how, planes, {x, y, n}, counters_); });
    }
  }
}

void Canvas::rectangle(const Primitive& p, const Paint& paint, const Clip& clip) {
  const Vertex& corner = p.vertices[0];
  const SpriteTexels t = sprite_texels(p);
  const Planes planes = make_flat_planes(grid_, corner, grid_.place(corner, false), t.u, t.u_step, t.v_step);
  ++counters_.primitives;
  draw_block(paint, planes, {corner.x, corner.x + p.width}, {corner.y, corner.y + p.height}, clip);
}

void Canvas::line(const Primitive& p, const Paint& paint, const Clip& clip) {
  LinePath path;
  if (!put_line_path(path, p)) return;
  ++counters_.primitives;
  for (int i = 0; i <= path.steps; ++i, path.advance()) {
    Vertex dot = p.vertices[0];
    if (p.is_gouraud()) {
      dot.r = static_cast<std::uint8_t>(path.colour[0] >> 12);
      dot.g = static_cast<std::uint8_t>(path.colour[1] >> 12);
      dot.b = static_cast<std::uint8_t>(path.colour[2] >> 12);
    }
    const int x = static_cast<int>(path.x >> 32), y = static_cast<int>(path.y >> 32);
    draw_block(paint, make_flat_planes(grid_, dot, {}, 0, 1, 1), {x, x + 1}, {y, y + 1}, clip);
  }
}

std::vector<Buffer> Canvas::buffers() const {
  std::vector<Buffer> list;
  const auto add = [&list](std::string_view name, std::uint64_t bytes) {
    if (bytes != 0) list.push_back({name, bytes});
  };
  std::uint64_t colour = 0;
  std::uint64_t depth = 0;
  for (const Layer& layer : layers_) {
    colour += layer.colour.size() * sizeof(Pixel);
    depth += layer.depth.size() * sizeof(std::uint32_t);
  }
  const std::uint64_t per_sample = colour / (layers_.size() * samples());
  add("canvas colour", per_sample);
  add("canvas samples", colour - per_sample);
  add("canvas depth", depth);
  add("canvas trace", (ids_.size() + texcoords_.size()) * sizeof(std::uint32_t));
  add("mip levels", mips_.bytes());
  return list;
}

}  // namespace gpu::canvas
