#pragma once
// Where the texels of a primitive lie, pixel by pixel: for whoever asks what a picture depends on.

#include <cstdint>
#include <functional>

#include "gpu/primitive.h"

namespace gpu {

/// A pixel that a textured primitive covers, and the halfword its texel is in.
struct TexelRead {
  std::uint32_t pixel = 0;  ///< y * 1024 + x
  std::uint32_t place = 0;  ///< y * 1024 + x of the texel or of the halfword that its index is in
  std::uint8_t shift = 0;   ///< of the index in that halfword
  std::uint8_t mask = 0;    ///< of the index, shifted down: 15, 255, or 0 for 15-bit texels
};

using TexelSink = std::function<void(const TexelRead&)>;

/// `sink` for every pixel that a textured polygon or rectangle covers inside the drawing area, in the order
/// drawn, whether its texel lets it be written or not. Draws nothing.
void for_each_texel(const Primitive& primitive, const TexelSink& sink);

}  // namespace gpu
