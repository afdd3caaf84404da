#pragma once
// The slow, plain reading of docs/hardware.md that fast kernels are compared with: one pixel at a time, every
// condition where the rules have it, nothing shared with src/gpu but the depth formulas.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/depth.h"

namespace oracle {

/// Low 11 bits, sign-extended.
inline int sx11(std::uint32_t v) { return static_cast<int>((v & 0x7ff) ^ 0x400) - 0x400; }

class PlainGpu {
 public:
  std::vector<std::uint16_t> vram = std::vector<std::uint16_t>(1024 * 512);
  std::vector<std::uint32_t> depth;  ///< keys; empty without a z-buffer
  bool interlaced_480 = false;       ///< GP1(08h) bits 2 and 5
  bool odd_display_line = false;     ///< display start y is odd

  void gp0(std::uint32_t word);
  void gp0(std::span<const std::uint32_t> words) {
    for (const std::uint32_t word : words) gp0(word);
  }
  void set_depth(const gpu::DepthOptions& options);
  void end_frame();

 private:
  struct Vertex {
    int x = 0, y = 0, r = 0, g = 0, b = 0, u = 0, v = 0;
    std::uint32_t z = 0;
    int fx = 0, fy = 0;
  };
  enum class Pass { console, opaque, semi_transparent };
  struct Registers {
    std::uint32_t mode = 0, window = 0, top_left = 0, bottom_right = 0, offset = 0, mask = 0;
  };
  struct Plane;
  struct DepthPlane;
  struct Queued {
    std::vector<std::uint32_t> words;
    std::array<Vertex, 4> vertices;
    Registers registers;
    std::array<std::uint16_t, 256> clut;
    std::uint32_t farthest;
  };

  std::size_t length() const;
  void execute();
  void polygon();
  void rectangle();
  void line();
  void segment();
  void fill();
  void copy();
  void flush();
  void load_clut(std::uint32_t halfword);
  void draw_polygon(Pass pass);
  void triangle(std::array<const Vertex*, 3> t, Pass pass);
  void pixel(int x, int y, std::array<int, 3> colour, int u, int v, bool dither, Pass pass,
             std::uint32_t key);
  std::uint16_t texel(int u, int v) const;
  void transfer_pixel(int x, int y, std::uint16_t value);
  void empty_depth(int x, int y);
  std::uint16_t& at(int x, int y) { return vram[static_cast<std::size_t>((y & 511) * 1024 + (x & 1023))]; }
  std::uint16_t at(int x, int y) const {
    return vram[static_cast<std::size_t>((y & 511) * 1024 + (x & 1023))];
  }
  bool row_is_skipped(int y) const;
  bool in_area(int x, int y) const;
  bool is_textured() const;
  bool is_gouraud() const { return (command_ >> 28 & 1) != 0; }
  bool is_semi() const { return (command_ >> 25 & 1) != 0; }
  bool is_raw() const { return is_textured() && (command_ >> 24 & 1) != 0; }

  std::vector<std::uint32_t> words_;
  std::uint32_t command_ = 0;
  Registers reg_;
  std::array<Vertex, 4> v_{};
  std::array<Vertex, 4> note_{};
  unsigned noted_depths_ = 0;
  bool noted_fractions_ = false, second_high_ = false;
  bool fractions_ = false;
  std::array<std::uint16_t, 256> clut_{};
  std::uint32_t clut_tag_ = 0xffffffff, clut_depth_ = 0;
  bool in_polyline_ = false;
  int up_x_ = 0, up_y_ = 0, up_w_ = 0, up_h_ = 0, up_at_ = 0;
  std::optional<gpu::DepthOptions> options_;
  std::vector<Queued> queue_;
};

}  // namespace oracle
