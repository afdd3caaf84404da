#pragma once
// Words for the canvas tests: a console and a canvas fed alike.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "tests/random.h"

namespace canvas_test {

using tests::Random;

/// A corner in 1/256 pixels with everything a polygon may say about it.
struct Corner {
  int x = 0, y = 0;       ///< 1/256 pixels
  std::uint32_t rgb = 0;  ///< BBGGRR
  int u = 0, v = 0;
  std::uint32_t z = 0;  ///< 20.12; 0: no depth is sent
};

inline std::uint32_t vertex_word(int x, int y) {
  return (static_cast<std::uint32_t>(x) & 0x7ff) | (static_cast<std::uint32_t>(y) & 0x7ff) << 16;
}

/// Annotation words and the polygon. `command` holds the opcode (20h..3Fh); quads take four corners.
inline std::vector<std::uint32_t> polygon(std::uint32_t command, const std::vector<Corner>& corners,
                                          std::uint32_t clut = 0, std::uint32_t page = 0) {
  std::vector<std::uint32_t> words;
  const bool gouraud = (command & 0x10) != 0;
  const bool textured = (command & 0x04) != 0;
  std::array<std::uint32_t, 2> high{0xe7000000, 0xe7000000};
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    const auto& c = corners[i];
    if (c.z != 0) words.push_back((0xe8 + i) << 24 | (c.z & 0xffffff));
    if (i < 3) high[0] |= c.z >> 24 << (8 * i);
    if (i == 3) high[1] |= c.z >> 24;
    const auto fx = static_cast<std::uint32_t>(c.x) & 0xff;
    const auto fy = static_cast<std::uint32_t>(c.y) & 0xff;
    words.push_back((0xec + i) << 24 | fx | fy << 8);
  }
  if (corners[0].z != 0) words.insert(words.end(), high.begin(), high.end());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& c = corners[i];
    if (i == 0) words.push_back(command << 24 | c.rgb);
    if (i != 0 && gouraud) words.push_back(c.rgb);
    words.push_back(vertex_word(c.x >> 8, c.y >> 8));
    if (textured) {
      const std::uint32_t extra = i == 0 ? clut : i == 1 ? page : 0;
      words.push_back(static_cast<std::uint32_t>(c.u) | static_cast<std::uint32_t>(c.v) << 8 | extra << 16);
    }
  }
  return words;
}

/// A drawing area over the whole region at (0, 0), no offset.
inline std::vector<std::uint32_t> area_words(int width, int height) {
  return {0xe3000000,
          0xe4000000 | static_cast<std::uint32_t>(width - 1) | static_cast<std::uint32_t>(height - 1) << 10,
          0xe5000000};
}

/// A GPU that draws on a canvas over (0, 0)..(width - 1, height - 1).
class Studio {
 public:
  explicit Studio(const gpu::canvas::Options& options) : gpu(with_canvas(options)), canvas(*gpu.canvas()) {
    gpu.begin_frame();
    gpu.gp0(area_words(canvas.options().width, canvas.options().height));
  }
  void draw(const std::vector<std::uint32_t>& words) { gpu.gp0(words); }

  gpu::Gpu gpu;
  gpu::canvas::Canvas& canvas;

 private:
  static gpu::Gpu with_canvas(const gpu::canvas::Options& options) {
    gpu::Gpu made;
    made.set_canvas(options);
    return made;
  }
};

/// A 15-bit canvas colour as VRAM would hold it.
inline std::uint16_t narrow(gpu::canvas::Pixel p) {
  return static_cast<std::uint16_t>((p >> 3 & 31) | (p >> 11 & 31) << 5 | (p >> 19 & 31) << 10 |
                                    ((p & gpu::canvas::mask_bit) != 0 ? 0x8000 : 0));
}

}  // namespace canvas_test
