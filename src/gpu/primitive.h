#pragma once
// A drawing command after decoding: what the words said, in VRAM coordinates, with
// the state it was drawn under.

#include <array>
#include <cstdint>

#include "gpu/state.h"

namespace gpu {

struct Vertex {
  std::int32_t x = 0, y = 0;  ///< after the drawing offset
  std::uint8_t r = 0, g = 0, b = 0;
  std::uint8_t u = 0, v = 0;
  std::uint8_t fx = 0, fy = 0;  ///< fractions of x and y in 1/256 pixel, from annotation words
  std::int8_t du = 0, dv = 0;   ///< what u and v leave over, eighths of a texel, from annotation words
  std::uint32_t z = 0;          ///< view-space depth, unsigned 20.12, from annotation words
};

inline constexpr std::uint32_t no_bucket = 0xffffffff;
inline constexpr std::uint32_t no_draw = 0xffffffff;  ///< the trace at hand does not know it

enum class Kind : std::uint8_t { polygon, rectangle, line, fill, copy, upload };
inline constexpr int kind_count = 6;

/// One polygon, rectangle, line segment, fill, copy or upload.
struct Primitive {
  Kind kind = Kind::polygon;
  std::uint32_t command = 0;         ///< the command word; a fill's holds its colour
  std::uint32_t command_number = 0;  ///< among the words sent since the frame began, from 0
  std::uint32_t bucket = no_bucket;  ///< of the ordering table, if whoever feeds the words knows it
  DrawState state;                   ///< for a textured polygon, after its page took effect
  std::uint16_t clut = 0;            ///< as transmitted; bit 15 means nothing
  std::uint8_t vertex_count = 0;  ///< polygon 3, 4; line 2; copy 2 (destination, source); others 1 (corner)
  bool has_depth = false;         ///< z of the vertices counts
  bool has_fractions = false;     ///< fx, fy of the vertices count
  bool has_texel_rests = false;   ///< du, dv of the vertices count: some is not 0
  std::int32_t width = 0, height = 0;  ///< rectangle, fill, copy, upload: pixels
  std::array<Vertex, 4> vertices{};

  [[nodiscard]] bool is_gouraud() const { return gp0::polygon::IsGouraud::get(command) != 0; }
  [[nodiscard]] bool is_quad() const { return vertex_count == 4; }
  [[nodiscard]] bool is_textured() const {
    return (kind == Kind::polygon || kind == Kind::rectangle) && gp0::polygon::IsTextured::get(command) != 0;
  }
  [[nodiscard]] bool is_semi_transparent() const {
    return kind <= Kind::line && gp0::polygon::IsSemiTransparent::get(command) != 0;
  }
  [[nodiscard]] bool is_raw() const { return is_textured() && gp0::polygon::IsRaw::get(command) != 0; }
};

}  // namespace gpu
