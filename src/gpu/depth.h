#pragma once
// Depth formats of the z-buffer: what a view-space depth becomes when it is stored, and the plane of stored
// depths. The console has none of this; see docs/hardware.md#depth-annotation for the words that carry z.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "gpu/vram.h"

namespace gpu {

enum class DepthFormat : std::uint8_t { bits16, bits24, bits32, float32 };
enum class DepthMapping : std::uint8_t {
  hyperbolic,  ///< far / (far - near) * (1 - near / z): affine on the screen, as graphics hardware stores it
  linear,      ///< (z - near) / (far - near)
};
enum class DepthTest : std::uint8_t { less, lequal };  ///< when a fragment nearer, or at least as near, wins

/// Which fragments of a polygon with depth are drawn. Opacity is a texel's matter: one
/// polygon can have both kinds.
enum class Pass : std::uint8_t {
  console,           ///< all, untested: there is no z-buffer, or the primitive has no depth
  opaque,            ///< those that let no light through; tested and stored
  semi_transparent,  ///< the others; tested, not stored
};

struct DepthOptions {
  DepthFormat format = DepthFormat::bits24;
  DepthMapping mapping = DepthMapping::hyperbolic;
  DepthTest test = DepthTest::less;
  bool reversed = false;              ///< near is stored as 1 and far as 0, and the test turns round
  double near_z = 16, far_z = 65535;  ///< view-space units; 0 < near < far

  bool operator==(const DepthOptions&) const = default;
};

/// The largest code of a format: far, or near when reversed. As a number: 1 for float32.
std::uint32_t largest_code(DepthFormat format);
double depth_scale(DepthFormat format);

/// The stored depth of view-space z: integer formats round((0..1) * depth_scale), halves up; float32 the bits
/// of the nearest float. z outside near..far saturates. Any z, NaN excluded; z <= 0 is nearer than near.
/// Example: near 10, far 1000, bits32, hyperbolic: 20 -> 2169175402.
std::uint32_t stored_depth(const DepthOptions& options, double z);

/// View-space depth (unsigned 20.12) in the middle of bucket 0..length-1 of an ordering table whose keys are
/// OTZ = 2 z: what stands for the depth of a polygon that brings none. [ours]
constexpr std::uint32_t depth_of_bucket(std::uint32_t bucket, std::uint32_t length) {
  return static_cast<std::uint32_t>((std::uint64_t{bucket} * 2 + 1) * (65536ULL / 4 << 12) / length);
}

/// What the options come to, computed once. Depth is made from a quantity that is affine on the screen: of
/// hyperbolic depth that depth itself, 0..scale; of linear depth 1/z.
struct DepthConstants {
  explicit DepthConstants(const DepthOptions& options);

  /// From 1/z; of a vertex, whose z is known, affine_quantity (depth_setup.cpp) loses less near 0.
  [[nodiscard]] double quantity(double inverse_z) const {
    return is_linear ? inverse_z : at_infinity + per_inverse_z * inverse_z;
  }
  /// The stored depth of a quantity. One outside the range, NaN included, reads as an end of it.
  [[nodiscard]] std::uint32_t stored(double quantity) const {
    double value = quantity > low ? (quantity < high ? quantity : high) : low;
    if (is_linear) value = std::clamp(1 / value * linear_scale + linear_offset, 0.0, scale);
    if (is_float) return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    return static_cast<std::uint32_t>(value + 0.5);
  }
  [[nodiscard]] std::uint32_t key(std::uint32_t stored_depth) const;
  [[nodiscard]] bool wins(std::uint32_t key, std::uint32_t old) const {
    return key < old || (equal_wins && key == old);
  }

  // Hyperbolic quantity: factor * (z - zero) / (z * range) * scale, which is at_infinity + per_inverse_z / z.
  double factor, zero, range, scale, at_infinity, per_inverse_z;
  /// Vertices whose depth is stepped in fixed point: 20.12, both inclusive; none where nearest > farthest.
  std::uint32_t nearest = 1, farthest = 0;
  double low, high;                    ///< the affine quantity from near to far, and its limits
  double linear_scale, linear_offset;  ///< linear: depth = 1 / quantity * scale + offset
  std::uint32_t flip, add;             ///< key = (stored ^ flip) + add
  bool equal_wins;                     ///< a fragment as near as what is there wins
  bool is_linear, is_float, is_reversed;
  std::uint32_t largest;  ///< largest_code()
};

/// One key per VRAM pixel. A key orders as "nearer is smaller" for every format, reversed or not, so one
/// unsigned comparison serves all; `empty` loses to every fragment, however far. A frame uses a small part of
/// VRAM: what is cleared is the box that was drawn into.
///
/// bits32 uses every code, so the two that are farthest share a key, which reads as far.
class DepthPlane {
 public:
  static constexpr std::uint32_t empty = 0xffffffff, farthest = 0xfffffffe;

  /// Keys from one row to the next. Not 1024: at a distance of 4 KiB, rows compete for the same few places of
  /// the caches, and a load waits for the store above it.
  static constexpr std::size_t stride = Vram::width + 16;
  [[nodiscard]] static constexpr std::size_t offset(int x, int y) {
    return (static_cast<std::size_t>(y) & (Vram::height - 1)) * stride +
           (static_cast<std::size_t>(x) & (Vram::width - 1));
  }

  explicit DepthPlane(const DepthOptions& options)
      : options_(options), constants_(options), keys_(stride * Vram::height + Vram::padding, empty) {}

  /// Before keys in these columns and rows are written, both ends included; rows from 512 on wrap.
  void touch(int left, int top, int right, int bottom) {
    touched_.left = std::min(touched_.left, left);
    touched_.right = std::max(touched_.right, std::min(right, Vram::width - 1));
    touched_.top = bottom < Vram::height ? std::min(touched_.top, top) : 0;
    touched_.bottom = std::max(touched_.bottom, std::min(bottom, Vram::height - 1));
  }
  void touch_all() { touch(0, 0, Vram::width - 1, Vram::height - 1); }
  /// No key was written since the last clear().
  [[nodiscard]] bool is_untouched() const { return touched_.bottom < touched_.top; }
  /// Bytes that clear() would write: the box round all that was touched.
  [[nodiscard]] std::uint64_t touched_bytes() const;

  /// Empties what was touched.
  void clear();
  /// Empties a rectangle that wraps at both edges, as far as it was touched.
  void clear(int x, int y, int width, int height);
  [[nodiscard]] const DepthOptions& options() const { return options_; }
  [[nodiscard]] const DepthConstants& constants() const { return constants_; }
  [[nodiscard]] std::uint32_t* keys() { return keys_.data(); }
  [[nodiscard]] bool is_empty(int x, int y) const { return keys_[offset(x, y)] == empty; }

  /// What the format stores at x, y (not the key); a pixel nobody wrote reads as far.
  [[nodiscard]] std::uint32_t stored(int x, int y) const;

  [[nodiscard]] std::uint64_t bytes() const { return keys_.size() * sizeof(std::uint32_t); }

 private:
  /// A box of pixels, all sides inside it.
  struct Touched {
    int left = Vram::width, top = Vram::height, right = -1, bottom = -1;
  };

  DepthOptions options_;
  DepthConstants constants_;
  Touched touched_;
  std::vector<std::uint32_t, LineAllocator<std::uint32_t>> keys_;
};

inline std::uint32_t DepthConstants::key(std::uint32_t stored_depth) const {
  return std::min((stored_depth ^ flip) + add, DepthPlane::farthest);
}

/// The key of a stored depth, and the stored depth that a key reads as; that of `empty` is far.
std::uint32_t depth_key(const DepthOptions& options, std::uint32_t stored);
std::uint32_t depth_of_key(const DepthOptions& options, std::uint32_t key);

}  // namespace gpu
