// Palettes, fills, copies and uploads: rows of pixels that are neither shaded nor clipped.

#include "gpu/transfer.h"

#include <algorithm>

#include "gpu/kernels.h"
#include "gpu/raster.h"
#include "gpu/rules.h"
#include "gpu/texture_page.h"
#include "ot/gp0.h"

namespace gpu {

namespace {

/// f(x, y, first, count) for the one or two pieces of a row that lie inside VRAM; first
/// counts from the row's start.
template <class F>
void for_each_piece(int x, int y, int count, F&& f) {
  x &= Vram::width - 1;
  const int before_edge = std::min(count, Vram::width - x);
  f(x, y, 0, before_edge);
  if (before_edge < count) f(0, y, before_edge, count - before_edge);
}

/// A piece under mask bits, watched, or over depths that it makes void: pixel by pixel where it must be.
void store_carefully(const Surface& surface, const DrawState& state, std::size_t place,
                     const std::uint16_t* pixels, int count) {
  const Watch watch{surface.trace, surface.draw, 0};
  std::uint16_t* to = surface.vram.pixels().data() + place;
  const int x = static_cast<int>(place % Vram::width), y = static_cast<int>(place / Vram::width);
  if (state.mask == 0 && (surface.trace == nullptr || !surface.trace->keep_history)) {
    std::copy_n(pixels, count, to);
    if (surface.depth != nullptr) surface.depth->clear(x, y, count, 1);
    if (surface.trace != nullptr)
      watch.note_row(static_cast<std::uint32_t>(place), static_cast<std::uint32_t>(count));
    return;
  }
  for (int i = 0; i < count; ++i, ++to, ++place) {
    if ((*to & state.mask_test()) != 0) continue;
    const auto pixel = static_cast<std::uint16_t>(pixels[i] | state.mask_set());
    if (surface.trace != nullptr) {
      watch.note(
          {.pixel = static_cast<std::uint32_t>(place), .before = *to, .after = pixel, .fragment = pixel});
    }
    *to = pixel;
    if (surface.depth != nullptr) surface.depth->clear(x + i, y, 1, 1);
  }
}

bool is_plain(const Surface& surface, const DrawState& state) {
  return surface.trace == nullptr && state.mask == 0 &&
         (surface.depth == nullptr || surface.depth->is_untouched());
}

}  // namespace

void ClutCache::use(const Vram& vram, std::uint16_t clut, TexelFormat format) {
  if (format == TexelFormat::direct15) return;
  const std::uint32_t tag = ot::gp0::clut::All::get(clut);
  if (tag == tag_ && loaded_ >= format) return;
  tag_ = tag;
  loaded_ = format;
  ++loads_;
  const int x = static_cast<int>(ot::gp0::clut::X16::get(clut)) * 16;
  const int y = static_cast<int>(ot::gp0::clut::Y::get(clut));
  for_each_piece(x, y, palette_size(format), [&](int px, int py, int first, int count) {
    std::copy_n(vram.pixels().data() + Vram::offset(px, py), count, entries_.begin() + first);
  });
}

/// Mask bits do not matter here, but rows of the field on screen may be left alone.
void fill_rectangle(const Surface& surface, const Primitive& primitive) {
  namespace colour = ot::gp0::colour;
  const std::uint32_t word = primitive.command;
  const std::uint16_t value = to_pixel(colour::R::get(word), colour::G::get(word), colour::B::get(word));
  const Vertex& corner = primitive.vertices[0];
  const int width = primitive.width, height = primitive.height;
  const bool wraps = corner.x + width > Vram::width || corner.y + height > Vram::height;
  if (!wraps && is_plain(surface, DrawState{}) && primitive.state.skipped_rows == SkippedRows::none) {
    operations().fill(&surface.vram.at(corner.x, corner.y), width, height, value);
    return;
  }
  PixelRow row;
  row.fill(value);
  for (int y = corner.y; y < corner.y + height; ++y) {
    if (primitive.state.skips(y & (Vram::height - 1))) continue;
    for_each_piece(corner.x, y, width, [&](int px, int py, int, int count) {
      store_carefully(surface, DrawState{}, Vram::offset(px, py), row.data(), count);
    });
  }
}

void store_row(const Surface& surface, const DrawState& state, int x, int y, const PixelRow& pixels,
               int count) {
  for_each_piece(x, y, count, [&](int px, int py, int first, int piece) {
    if (is_plain(surface, state)) {
      std::copy_n(pixels.begin() + first, piece, &surface.vram.at(px, py));
    } else {
      store_carefully(surface, state, Vram::offset(px, py), pixels.data() + first, piece);
    }
  });
}

/// Overlap downwards smears, and so does overlap to the right over more than a piece.
/// [docs/hardware.md#vram-to-vram-copy]
void copy_rectangle(const Surface& surface, const Primitive& primitive) {
  const Vertex &to = primitive.vertices[0], &from = primitive.vertices[1];
  const int width = primitive.width, height = primitive.height;
  Vram& vram = surface.vram;
  const bool wraps =
      std::max(to.x, from.x) + width > Vram::width || std::max(to.y, from.y) + height > Vram::height;
  if (!wraps && is_plain(surface, primitive.state)) {
    // In different rows pieces cannot meet; in the same ones rows cannot.
    const int piece = to.y == from.y ? copied_at_once : width;
    for (int x = 0; x < width; x += piece) {
      operations().copy(&vram.at(to.x + x, to.y), &vram.at(from.x + x, from.y), std::min(piece, width - x),
                        height);
    }
    return;
  }
  PixelRow row;
  for_each_copied_piece(primitive, [&](int x, int y, int count) {
    for_each_piece(from.x + x, from.y + y, count, [&](int px, int py, int first, int piece) {
      std::copy_n(&vram.at(px, py), piece, row.begin() + first);
    });
    store_row(surface, primitive.state, to.x + x, to.y + y, row, count);
  });
}

}  // namespace gpu
