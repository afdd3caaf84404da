#pragma once
// How many pixels of which kind the console would have visited: what a host weighs to keep its clock. Time
// itself is not modelled.

#include <array>
#include <cstdint>

namespace gpu {

struct Primitive;

/// A pixel counts where the primitive covers it inside the drawing area and its row is not skipped, whether a
/// texel, the mask bit or a depth test lets it be written or not; on a canvas too, as if VRAM were the
/// target.
struct PixelCounts {
  /// Index of `polygons` and so on: the sum of what applies. Raw textures are not shaded.
  static constexpr std::size_t gouraud = 1, textured = 2, semi_transparent = 4;

  std::array<std::uint64_t, 8> polygons{}, rectangles{}, lines{};
  std::uint64_t fills = 0, copies = 0;       ///< pixels written
  std::uint64_t uploads = 0, downloads = 0;  ///< of transfers, counted when one begins

  /// Counts a primitive after decoding.
  void add(const Primitive& primitive);
};

}  // namespace gpu
