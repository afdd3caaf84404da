#pragma once
// A small stage for hand-computed frames: polygons with depth and a bucket, drawn
// in the order they are added.

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "gpu/gpu.h"
#include "inspect/report.h"
#include "ot/packet.h"

namespace tests {

struct Corner {
  int x = 0, y = 0;
  std::uint32_t z = 0;          ///< whole view-space units
  std::uint8_t fx = 0, fy = 0;  ///< fractions, 1/256 pixel: they count on a canvas alone
};

struct Look {
  std::uint32_t bucket = gpu::no_bucket;
  bool semi_transparent = false;
  ot::Rgb rgb{200, 100, 50};
  std::optional<ot::Uv> texel{};  ///< a textured polygon that shows this one texel of the page at (640,0)
};

class Stage {
 public:
  explicit Stage(const std::optional<gpu::DepthOptions>& depth = std::nullopt)
      : order_(depth ? inspect::Order::depth : inspect::Order::list) {
    trace_.keep_history = true;
    gpu_.set_depth(depth);
    move_to(0, 0);
    gpu_.begin_frame();
    gpu_.set_trace(&trace_);
  }

  /// From now on 0,0 stands for (x, y) of VRAM, and 8 x 8 pixels from there are drawn
  /// on: many small frames in one.
  void move_to(std::uint32_t x, std::uint32_t y) {
    gpu_.gp0(0xe3000000 | y << 10 | x);
    gpu_.gp0(0xe4000000 | (y + 7) << 10 | (x + 7));
    gpu_.gp0(0xe5000000 | y << 11 | x);
  }

  /// Three corners, or four in the order 0-1 / 2-3.
  void polygon(std::initializer_list<Corner> corners, const Look& look = {}) {
    raw_polygon(corners, look, 4096);
  }

  /// The same with z in 20.12.
  void raw_polygon(std::initializer_list<Corner> corners, const Look& look, std::uint32_t unit = 1) {
    ot::Polygon p{.quad = corners.size() == 4,
                  .textured = look.texel.has_value(),
                  .semi_transparent = look.semi_transparent,
                  .raw = look.texel.has_value()};
    ot::DepthAnnotation depth{.count = static_cast<int>(corners.size())};
    std::size_t i = 0;
    for (const Corner& corner : corners) {
      p.xy[i] = {static_cast<std::int16_t>(corner.x), static_cast<std::int16_t>(corner.y)};
      p.uv[i] = look.texel.value_or(ot::Uv{});
      depth.fx[i] = corner.fx;
      depth.fy[i] = corner.fy;
      depth.has_fractions = depth.has_fractions || corner.fx != 0 || corner.fy != 0;
      depth.z[i++] = corner.z * unit;
    }
    p.rgb[0] = look.rgb;
    p.texpage = ot::texpage_of(640, 0, ot::Blend::average, ot::TexelFormat::direct15);
    send(depth);
    trace_.bucket = look.bucket;
    send(p);
  }

  /// The screen rectangle x0..x1-1, y0..y1-1 with one depth on the left edge and one on the right.
  void quad(int x0, int y0, int x1, int y1, std::uint32_t z_left, std::uint32_t z_right,
            const Look& look = {}) {
    polygon({{x0, y0, z_left}, {x1, y0, z_right}, {x0, y1, z_left}, {x1, y1, z_right}}, look);
  }
  void quad(int x0, int y0, int x1, int y1, std::uint32_t z, const Look& look = {}) {
    quad(x0, y0, x1, y1, z, z, look);
  }
  /// Depth goes from the top edge to the bottom edge.
  void upright(int x0, int y0, int x1, int y1, std::uint32_t z_top, std::uint32_t z_bottom,
               const Look& look = {}) {
    polygon({{x0, y0, z_top}, {x1, y0, z_top}, {x0, y1, z_bottom}, {x1, y1, z_bottom}}, look);
  }

  void rectangle(int x0, int y0, int x1, int y1) {
    trace_.bucket = gpu::no_bucket;
    send(ot::Rectangle{.xy = {static_cast<std::int16_t>(x0), static_cast<std::int16_t>(y0)},
                       .width = static_cast<std::uint16_t>(x1 - x0),
                       .height = static_cast<std::uint16_t>(y1 - y0)});
  }

  inspect::Report report() {
    if (!ended_) gpu_.end_frame();
    ended_ = true;
    return inspect::inspect(trace_, {.order = order_, .scene = "stage"});
  }

  gpu::Gpu& gpu() { return gpu_; }
  gpu::Trace& trace() { return trace_; }

 private:
  template <class Packet>
  void send(const Packet& packet) {
    std::array<std::uint32_t, 16> words{};
    gpu_.gp0(std::span(words).first(ot::encode(packet, words)));
  }

  gpu::Gpu gpu_;
  gpu::Trace trace_;
  inspect::Order order_;
  bool ended_ = false;
};

/// All wrong pixels have this cause, and there are so many.
inline bool is_exactly(const inspect::Report& report, inspect::Cause cause, std::uint64_t pixels) {
  return report.count(cause) == pixels && report.wrong_pixels() == pixels;
}

}  // namespace tests
