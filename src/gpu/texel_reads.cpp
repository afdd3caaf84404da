#include "gpu/texel_reads.h"

#include "gpu/columns.h"
#include "gpu/raster.h"
#include "gpu/setup.h"

namespace gpu {
namespace {

TexelRead read_at(const Mode& mode, const Job& job, const Span& span, int i) {
  const TexturePage& page = job.page;
  const auto texel = [&](const Gradient& gradient) { return gradient.at(span.dx + i, span.dy) >> 24; };
  const std::uint32_t u = (texel(job.texel.u) & page.keep_u) | page.set_u;
  const std::uint32_t v = (texel(job.texel.v) & page.keep_v) | page.set_v;
  const auto place = [&](std::uint32_t column) {
    return static_cast<std::uint32_t>(
        Vram::offset(static_cast<int>(page.x + column), static_cast<int>(page.y + v)));
  };
  const auto pixel = static_cast<std::uint32_t>(Vram::offset(span.x + i, span.y));
  switch (mode.surface.texture) {
    case TexelFormat::clut4:
      return {pixel, place(u >> 2), static_cast<std::uint8_t>((u & 3) * 4), 15};
    case TexelFormat::clut8:
      return {pixel, place(u >> 1), static_cast<std::uint8_t>((u & 1) * 8), 255};
    default:
      return {pixel, place(u), 0, 0};
  }
}

}  // namespace

void tell_texels(const Mode& mode, const Job& job, std::span<const Span> spans, const TexelSink& sink) {
  if (mode.surface.texture == TexelFormat::none) return;
  for (const Span& span : spans) {
    for (int i = 0; i < span.count; ++i) sink(read_at(mode, job, span, i));
  }
}

void for_each_texel(const Primitive& primitive, const TexelSink& sink) {
  if (!primitive.is_textured()) return;
  static thread_local Vram untouched;  // 1 MiB that nothing reads or writes
  Counters counters;
  const Surface surface{.vram = untouched, .clut = nullptr, .counters = counters, .texels = &sink};
  if (primitive.kind == Kind::polygon) draw_polygon(surface, primitive, Pass::console);
  if (primitive.kind == Kind::rectangle) draw_rectangle(surface, primitive);
}

}  // namespace gpu
