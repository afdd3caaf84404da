#pragma once
// Depth formats of the z-buffer: what a view-space depth becomes when it is stored, and the plane of stored
// depths. The console has none of this; see design.md, "z-buffer", for the annotation words that carry z.

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

struct DepthOptions {
  DepthFormat format = DepthFormat::bits24;
  DepthMapping mapping = DepthMapping::hyperbolic;
  DepthTest test = DepthTest::less;
  bool reversed = false;              ///< near is stored as 1 and far as 0, and the test turns round
  double near_z = 16, far_z = 65535;  ///< view-space units; 0 < near < far

  bool operator==(const DepthOptions&) const = default;
};

/// The largest integer a format stores; 1 for float32.
double depth_scale(DepthFormat format);

/// The stored depth of view-space z: integer formats round((0..1) * depth_scale), halves up; float32 the bits
/// of the nearest float. z outside near..far saturates. Any z, NaN excluded; z <= 0 is nearer than near.
/// Example: near 10, far 1000, bits32, hyperbolic: 20 -> 2169175402.
std::uint32_t stored_depth(const DepthOptions& options, double z);

/// One key per VRAM pixel. A key orders as "nearer is smaller" for every format, reversed or not, so one
/// unsigned comparison serves all; `empty` loses to every fragment, however far.
///
/// bits32 uses every code, so its last one also reads as empty: of two fragments at
/// or behind far the later wins.
class DepthPlane {
 public:
  static constexpr std::uint32_t empty = 0xffffffff;

  explicit DepthPlane(const DepthOptions& options)
      : options_(options), keys_(Vram::size + Vram::padding, empty) {}

  void clear();
  [[nodiscard]] const DepthOptions& options() const { return options_; }
  [[nodiscard]] std::uint32_t* keys() { return keys_.data(); }
  [[nodiscard]] bool is_empty(int x, int y) const { return keys_[Vram::offset(x, y)] == empty; }

  /// What the format stores at x, y (not the key); a pixel nobody wrote reads as far.
  [[nodiscard]] std::uint32_t stored(int x, int y) const;

  [[nodiscard]] std::uint64_t bytes() const { return keys_.size() * sizeof(std::uint32_t); }

 private:
  DepthOptions options_;
  std::vector<std::uint32_t> keys_;
};

/// Stored depth <-> key: its own inverse.
std::uint32_t depth_key(const DepthOptions& options, std::uint32_t stored);

}  // namespace gpu
