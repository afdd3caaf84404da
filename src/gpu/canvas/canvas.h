#pragma once
// The accurate target beside VRAM: takes the primitives that a Gpu decodes and draws them with sub-pixel
// positions, samples, depth, perspective, texel filters and 24-bit colour, as far as its Options ask. What no
// option asks for is neither computed nor allocated.
//
// With default options a Canvas is the console's frame buffer to the bit: the edge rule, gradients,
// modulation, dither, blending and mask are the console's formulas carried over to finer positions.
//
// Rules of its own. Lines and rectangles are whole console pixels at every resolution. Textures are read from
// VRAM, never from the canvas. Not modelled: the wrap of coordinates outside -1024..1023, the interlace skip,
// and polygons that read the pixels they draw.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/canvas/kernels.h"
#include "gpu/canvas/mip.h"
#include "gpu/canvas/options.h"
#include "gpu/canvas/setup.h"
#include "gpu/columns.h"
#include "gpu/depth.h"
#include "gpu/primitive.h"
#include "gpu/vram.h"

namespace gpu::canvas {

struct Buffer {
  std::string_view name;
  std::uint64_t bytes;
};

class Canvas {
 public:
  /// All black. Needs: the limits named in options.h.
  explicit Canvas(Options options);

  [[nodiscard]] const Options& options() const { return options_; }

  /// Places the canvas over VRAM pixels (x, y)..(x + width - 1, y + height - 1), empties depth and trace.
  /// Keeps the picture, as a frame buffer does. A Gpu begins its canvas' frames itself.
  void begin_frame(int x, int y);

  /// Polygons draw inside these limits only, in canvas pixels before the drawing offset; nothing: everywhere.
  /// For a canvas of one sample a pixel, at its centre. The columns stay the caller's.
  void set_limits(const std::optional<Limits>& limits) { limits_ = limits; }
  /// Whether the drawing area touches the canvas; what is drawn under another one is VRAM's.
  [[nodiscard]] bool covers(const DrawState& state) const;
  /// Draws a polygon, rectangle or line segment if covers() says so; false: it does not, and VRAM is drawn
  /// on. Passes but the console's need options().depth and a polygon with depth. `clut`: 256 entries, read
  /// during the call. `id` is stored as the pixels' writer.
  bool draw(const Primitive& primitive, Pass pass, const Vram& vram, const std::uint16_t* clut,
            std::uint32_t id);
  /// From the next draw() on writes are noted in `trace`, as pixels of VRAM and in 16 bits; nullptr ends it.
  /// It must live until the frame has ended. Nothing is noted unless options().can_be_watched().
  void watch(Trace* trace) { watch_.trace = trace; }
  /// Needs options().can_be_watched(): puts the picture, in 16 bits, where it lies in VRAM. `vram`: 1024 x
  /// 512.
  void put_into(std::span<std::uint16_t> vram) const;

  /// VRAM was changed by a fill, copy or upload: does the same to the canvas where it was the target, and
  /// forgets mip levels. Call after VRAM is changed.
  void transfer(const Primitive& primitive, const Vram& vram);

  /// Frame buffer `layer`: samples of pixel (x, y) from (y * width + x) * samples on.
  [[nodiscard]] std::span<const Pixel> layer(std::size_t index) const { return layers_[index].colour; }
  /// With options().trace, per pixel: the id given to draw(), 0 where nobody drew; and the texture
  /// coordinates, 8.8, as u + 128 | (v + 128) << 16, meaningful where the writer is textured.
  [[nodiscard]] std::span<const std::uint32_t> ids() const { return ids_; }
  [[nodiscard]] std::span<const std::uint32_t> texcoords() const { return texcoords_; }
  [[nodiscard]] int width() const { return options_.width * options_.scale; }    ///< canvas pixels
  [[nodiscard]] int height() const { return options_.height * options_.scale; }  ///< canvas pixels
  [[nodiscard]] std::size_t samples() const { return options_.samples.empty() ? 1 : options_.samples.size(); }

  [[nodiscard]] const Counters& counters() const { return counters_; }
  void reset_counters() { counters_ = {}; }
  /// What is allocated, by purpose; empty buffers are left out.
  [[nodiscard]] std::vector<Buffer> buffers() const;
  /// What a canvas of these options will allocate for its frame, before it does.
  [[nodiscard]] static std::uint64_t frame_bytes(const Options& options);

 private:
  struct Layer {
    std::vector<Pixel> colour;
    std::vector<std::uint32_t> depth;
  };
  struct Clip {
    Range columns, rows;
  };

  [[nodiscard]] Target target(std::size_t layer);
  [[nodiscard]] Clip clip(const DrawState& state) const;
  Paint paint(const Primitive& p, Pass pass, const Vram& vram, const std::uint16_t* clut, std::uint32_t id);
  void polygon(const Primitive& p, const Paint& paint, const Clip& clip);
  void triangle(const Primitive& p, const Triangle& triangle, const Paint& paint, const Clip& clip);
  void rasterise(const std::array<Point, 3>& corners, const Planes& planes, const Paint& paint,
                 const Clip& clip, const DrawState& state);
  void rasterise_scattered(const Target& to, std::size_t layer, const std::array<Point, 3>& corners,
                           const Planes& planes, const Paint& paint, const Clip& clip);
  void rasterise_samples(const std::array<Point, 3>& corners, const Planes& planes, const Paint& paint,
                         const Clip& clip);
  void rectangle(const Primitive& p, const Paint& paint, const Clip& clip);
  void line(const Primitive& p, const Paint& paint, const Clip& clip);
  void draw_block(const Paint& paint, const Planes& planes, Range columns, Range rows, const Clip& clip);
  void fill(const Primitive& p);
  void copy(const Primitive& p, const Vram& vram);
  void upload(const Primitive& p, const Vram& vram);
  [[nodiscard]] Pixel from_vram(std::uint16_t pixel) const;
  void empty_depth(Layer& layer, std::size_t first, std::size_t count) const;

  Options options_;
  Grid grid_;
  std::optional<Limits> limits_;
  std::vector<Point> layer_points_, sample_points_;
  std::vector<Point> scatter_;  // with a scatter_seed: of each pattern the samples of all layers
  std::vector<Layer> layers_;
  std::vector<std::uint32_t> ids_, texcoords_;
  int frames_ = 0;           // begun
  bool has_depths_ = false;  // some were written since begin_frame
  std::optional<DepthConstants> depth_;
  FogRamp fog_;
  MipCache mips_;
  Counters counters_;
  Watch watch_;
};

}  // namespace gpu::canvas
