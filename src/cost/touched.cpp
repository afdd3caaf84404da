#include "cost/touched.h"

#include <algorithm>

#include "gpu/canvas/resolve.h"
#include "gpu/columns.h"

namespace cost {
namespace {

constexpr std::uint64_t vram_pixel = 2, canvas_pixel = 4, depth_key = 4, shown_pixel = 4;

/// Pixels of a primitive inside its drawing area, before any test.
std::uint64_t fragments(const gpu::Primitive& p) {
  std::uint64_t count = 0;
  const auto add_row = [&](std::int32_t y, std::int32_t left, std::int32_t right) {
    if (y < p.state.top() || y > p.state.bottom()) return;
    const auto inside = std::min(right, p.state.right() + 1) - std::max(left, p.state.left());
    count += static_cast<std::uint64_t>(std::max(0, inside));
  };
  if (p.kind == gpu::Kind::rectangle) {
    for (int y = 0; y < p.height; ++y)
      add_row(p.vertices[0].y + y, p.vertices[0].x, p.vertices[0].x + p.width);
  }
  if (p.kind == gpu::Kind::polygon) {
    for (std::size_t first = 0; first + 2 < p.vertex_count; ++first) {
      gpu::Corners corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = {p.vertices[first + k].x, p.vertices[first + k].y};
      gpu::for_each_covered_row(corners, add_row);
    }
  }
  return count;
}

std::uint64_t bytes_per_texel(const gpu::Primitive& p) {
  return p.state.texel_format() == gpu::TexelFormat::direct15 ? vram_pixel : 2 * vram_pixel;
}

/// The console's own target: no counter runs in its kernels, so a watched frame is counted.
/// `in_pieces`: polygons are drawn in parts, so only what was written tells how much.
void count_vram(const gpu::Trace& trace, bool in_pieces, Touched& t) {
  std::uint64_t tested = 0;
  std::uint64_t stored = 0;
  for (const auto& event : trace.history) {
    const auto& draw = trace.draws[event.draw];
    const bool compared = event.depth != 0;
    tested += compared ? 1 : 0;
    if (in_pieces && draw.is_textured()) t.texels += bytes_per_texel(draw);
    if (event.rejected) continue;
    stored += compared && !event.blended ? 1 : 0;
    if (draw.kind <= gpu::Kind::line) t.colour += vram_pixel + (event.blended ? vram_pixel : 0);
  }
  for (const auto& draw : trace.draws) {
    if (draw.is_textured() && !in_pieces) t.texels += fragments(draw) * bytes_per_texel(draw);
    if (draw.kind == gpu::Kind::fill)
      t.colour +=
          vram_pixel * static_cast<std::uint64_t>(draw.width) * static_cast<std::uint64_t>(draw.height);
  }
  t.depth += depth_key * (tested + stored);
}

void count_canvas(const gpu::canvas::Canvas& canvas, const scene::Knobs& knobs, Touched& t) {
  const auto& c = canvas.counters();
  const auto pixels =
      static_cast<std::uint64_t>(canvas.width()) * static_cast<std::uint64_t>(canvas.height());
  t.colour = canvas_pixel * (c.cleared + c.written + c.blended);
  t.depth = depth_key * (c.tested + c.stored);
  for (const auto& buffer : canvas.buffers())
    if (buffer.name == "canvas depth") t.depth += buffer.bytes;
  t.texels = c.texel_bytes;
  const auto taps = gpu::canvas::filter_taps(canvas.options(), knobs.aa_filter);
  t.filter = pixels * (taps.size() * canvas_pixel + shown_pixel);
}

}  // namespace

base::Result<Touched> touched(Subject& subject, const scene::Knobs& knobs, const Drawn& drawn) {
  Touched t;
  t.list = 2 * std::uint64_t{drawn.stats.ram_bytes};
  const auto shown = static_cast<std::uint64_t>(subject.picture().pixels.size());
  if (subject.gpu().canvas() != nullptr) {
    count_canvas(*subject.gpu().canvas(), knobs, t);
  } else {
    const auto* plane = subject.gpu().depth_plane();
    t.depth = plane != nullptr ? plane->touched_bytes() : 0;
    t.filter = shown * (vram_pixel + shown_pixel);
    gpu::Trace trace;
    trace.keep_history = true;
    if (auto traced = subject.trace_console(knobs, trace); !traced)
      return tl::make_unexpected(traced.error());
    count_vram(trace, knobs.visibility == scene::Visibility::bsp, t);
  }
  // Filters of finished pictures read one and write one; FXAA has brightness beside it, accumulation its
  // history.
  if (knobs.antialias.kind == scene::AntialiasKind::fxaa) t.filter += shown * (2 * shown_pixel + 2 * 4);
  if (knobs.antialias.kind == scene::AntialiasKind::taa)
    t.filter += shown * 2 * shown_pixel + 2 * drawn.history_bytes;
  return t;
}

}  // namespace cost
