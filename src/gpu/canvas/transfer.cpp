// Fills, copies and uploads: what changes VRAM without drawing changes the canvas alike.

#include "gpu/transfer.h"

#include <algorithm>
#include <array>

#include "gpu/canvas/canvas.h"
#include "gpu/canvas/texel.h"

namespace gpu::canvas {
namespace {

/// f(x, y) for every VRAM pixel of a rectangle that wraps at both edges of VRAM, row by row.
template <class F>
void for_each_pixel(Vertex corner, int width, int height, F&& f) {
  for (int j = 0; j < height; ++j) {
    for (int i = 0; i < width; ++i) {
      f((corner.x + i) & (Vram::width - 1), (corner.y + j) & (Vram::height - 1));
    }
  }
}

/// The columns x .. x + width - 1 of VRAM, which wrap: to the right edge, and from the left one.
std::array<Range, 2> parts(int x, int width) {
  x &= Vram::width - 1;
  const int end = x + width;
  return {Range{x, std::min(end, Vram::width)}, Range{0, std::min(x, end - Vram::width)}};
}

/// The samples of one VRAM pixel in every layer: `scale` rows of `scale` pixels.
class Blocks {
 public:
  Blocks(const Grid& grid, const Options& options, std::size_t samples)
      : grid_(grid), options_(options), samples_(samples) {}

  [[nodiscard]] bool contains(int x, int y) const {
    return x >= grid_.x && x < grid_.x + options_.width && y >= grid_.y && y < grid_.y + options_.height;
  }
  /// Samples of one row of the block.
  [[nodiscard]] std::size_t row_length() const { return static_cast<std::size_t>(options_.scale) * samples_; }
  [[nodiscard]] std::size_t length() const { return row_length() * static_cast<std::size_t>(options_.scale); }
  /// Index of the first sample of row `row` of the block of VRAM pixel (x, y).
  [[nodiscard]] std::size_t row(int x, int y, int row) const {
    const auto line = static_cast<std::size_t>((y - grid_.y) * options_.scale + row);
    const auto width = static_cast<std::size_t>(options_.width * options_.scale);
    return (line * width + static_cast<std::size_t>((x - grid_.x) * options_.scale)) * samples_;
  }

 private:
  const Grid& grid_;
  const Options& options_;
  std::size_t samples_;
};

}  // namespace

void Canvas::transfer(const Primitive& p, const Vram& vram) {
  mips_.forget({p.vertices[0].x, p.vertices[0].y, p.width, p.height});
  switch (p.kind) {
    case Kind::fill:
      return fill(p);
    case Kind::copy:
      return copy(p, vram);
    case Kind::upload:
      return upload(p, vram);
    default:
      return;
  }
}

void Canvas::fill(const Primitive& p) {
  const Blocks blocks(grid_, options_, samples());
  const Pixel quantise = options_.colour == Colour::bits15 ? 0xf8f8f8 : 0xffffff;
  const Pixel colour = p.command & quantise;
  for (int j = 0; j < p.height; ++j) {
    const int y = (p.vertices[0].y + j) & (Vram::height - 1);
    for (const Range part : parts(p.vertices[0].x, p.width)) {
      const Range columns = intersect(part, {grid_.x, grid_.x + options_.width});
      if (columns.is_empty() || !blocks.contains(columns.begin, y)) continue;
      const auto length = static_cast<std::size_t>(columns.end - columns.begin) * blocks.row_length();
      for (Layer& layer : layers_) {
        for (int row = 0; row < options_.scale; ++row) {
          const auto first = blocks.row(columns.begin, y, row);
          std::fill_n(&layer.colour[first], length, colour);
          empty_depth(layer, first, length);
          counters_.cleared += length;
        }
      }
    }
  }
}

/// Piece by piece as in VRAM. A pixel that comes from outside the canvas is what VRAM got for it; where mask
/// bits may have kept VRAM from getting it, what lies at its source now.
void Canvas::copy(const Primitive& p, const Vram& vram) {
  const Blocks blocks(grid_, options_, samples());
  const Vertex to = p.vertices[0];
  const Vertex from = p.vertices[1];
  const Pixel set = p.state.mask_set() != 0 ? mask_bit : 0;
  const Pixel test = p.state.mask_test() != 0 ? mask_bit : 0;
  std::vector<Pixel> line(static_cast<std::size_t>(copied_at_once) * blocks.length());
  for (Layer& layer : layers_) {
    for_each_copied_piece(p, [&](int first, int j, int count) {
      const int sy = (from.y + j) & (Vram::height - 1);
      const int dy = (to.y + j) & (Vram::height - 1);
      const auto each = [&](auto&& use) {
        for (int i = 0; i < count; ++i) {
          const int sx = (from.x + first + i) & (Vram::width - 1);
          const int dx = (to.x + first + i) & (Vram::width - 1);
          if (blocks.contains(dx, dy)) use(&line[static_cast<std::size_t>(i) * blocks.length()], sx, dx);
        }
      };
      const auto each_row = [&](Pixel* kept, auto&& use) {
        for (int row = 0; row < options_.scale; ++row, kept += blocks.row_length()) use(kept, row);
      };
      each([&](Pixel* kept, int sx, int dx) {
        if (!blocks.contains(sx, sy)) {
          std::fill_n(kept, blocks.length(), from_vram(test == 0 ? vram.at(dx, dy) : vram.at(sx, sy)));
          return;
        }
        each_row(kept, [&](Pixel* into, int row) {
          std::copy_n(&layer.colour[blocks.row(sx, sy, row)], blocks.row_length(), into);
        });
      });
      each([&](Pixel* kept, int, int dx) {
        each_row(kept, [&](const Pixel* source, int row) {
          const auto begin = blocks.row(dx, dy, row);
          for (std::size_t k = 0; k < blocks.row_length(); ++k) {
            Pixel& target = layer.colour[begin + k];
            if ((target & test) != 0) continue;
            target = source[k] | set;
            empty_depth(layer, begin + k, 1);
          }
        });
      });
    });
  }
}

/// What an upload brought is read back from VRAM, so a pixel that VRAM's own mask bits refused does not
/// arrive.
void Canvas::upload(const Primitive& p, const Vram& vram) {
  const Blocks blocks(grid_, options_, samples());
  const Pixel set = p.state.mask_set() != 0 ? mask_bit : 0;
  const Pixel test = p.state.mask_test() != 0 ? mask_bit : 0;
  for_each_pixel(p.vertices[0], p.width, p.height, [&](int x, int y) {
    if (!blocks.contains(x, y)) return;
    const Pixel colour = from_vram(vram.at(x, y)) | set;
    for (Layer& layer : layers_) {
      for (int row = 0; row < options_.scale; ++row) {
        const auto first = blocks.row(x, y, row);
        for (std::size_t k = first; k < first + blocks.row_length(); ++k) {
          if ((layer.colour[k] & test) != 0) continue;
          layer.colour[k] = colour;
          empty_depth(layer, k, 1);
        }
      }
    }
  });
}

/// What is written by a transfer begins anew.
void Canvas::empty_depth(Layer& layer, std::size_t first, std::size_t count) const {
  if (has_depths_) std::fill_n(&layer.depth[first], count, DepthPlane::empty);
}

/// A pixel of VRAM, its mask bit included.
Pixel Canvas::from_vram(std::uint16_t pixel) const {
  return widen(pixel, options_.colour == Colour::bits24) | ((pixel & 0x8000) != 0 ? mask_bit : 0);
}

}  // namespace gpu::canvas
