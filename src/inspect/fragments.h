#pragma once
// A traced frame, turned from "in the order made" to "per pixel": the fragments of polygons with depth, which
// is all that truth looks at. Everything else that writes is a layer.

#include <cstdint>
#include <span>
#include <vector>

#include "exact/depth_order.h"
#include "gpu/trace.h"

namespace inspect {

inline constexpr std::uint32_t nobody = 0xffffffff;  ///< "no draw" wherever a draw number stands

/// What decided the order of fragments.
enum class Order : std::uint8_t {
  list,   ///< the list: visibility ot and sorted, dumps. Draws whose bucket is known have keys
  depth,  ///< a z-buffer
  exact,  ///< bsp: a wrong pixel has no cause, it is a bug
};

/// What becomes of the fragments drawn before an event, at its pixel.
enum class Hides : std::uint8_t {
  nothing,
  covers,  ///< an opaque layer: they are not seen any more, but a z-buffer goes on comparing with their depth
  erases,  ///< a fill, copy or upload: depth begins anew as well
};
[[nodiscard]] Hides hides(const gpu::Event& event, const gpu::Primitive& draw);
/// The same; list orders compare nothing, so there what is covered is gone.
[[nodiscard]] Hides hides(const gpu::Event& event, const gpu::Primitive& draw, Order order);

/// One polygon at one pixel.
struct Fragment {
  std::uint32_t draw = nobody;  ///< index into Trace::draws
  std::uint32_t depth = 0;      ///< z-buffer: the key it was tested with (nearer is smaller)
  std::uint16_t colour = 0;     ///< before blending
  std::uint8_t half = 0;        ///< 1: second triangle of a quad
  bool blends = false;          ///< lets through what is behind it
  bool rejected = false;        ///< lost the depth test
  bool covered = false;         ///< an opaque layer hides it; judged is what was drawn after that
};

/// Both triangles of a draw are at one pixel: a quad that folds over itself.
[[nodiscard]] bool is_folded(std::span<const Fragment> at_pixel, std::uint32_t draw);

/// The planes of 1/z of all triangles of a trace.
class Surfaces {
 public:
  /// The trace must outlive it.
  explicit Surfaces(const gpu::Trace& trace);

  /// greater: fragment a is nearer than b; both at VRAM pixel y * 1024 + x.
  std::strong_ordering compare(const Fragment& a, const Fragment& b, std::uint32_t pixel);
  /// The fragment's depth in view-space units, for people; not exact.
  [[nodiscard]] double depth(const Fragment& fragment, std::uint32_t pixel) const;

  /// The fragment's surface begins in the pixel's column: left of it lies the end of one that wraps.
  [[nodiscard]] bool begins_at(const Fragment& fragment, std::uint32_t pixel) const {
    return ((static_cast<int>(pixel) - of(fragment).left) & (gpu::Vram::width - 1)) == 0;
  }

  exact::DecisionCounts decisions;

 private:
  struct Surface {
    exact::InversePlane plane;
    int left = 0, top = 0;  // of the bounding box: which of the samples that wrap to a pixel is meant
  };
  struct Sample {
    int x, y;
  };
  [[nodiscard]] const Surface& of(const Fragment& f) const { return surfaces_[first_[f.draw] + f.half]; }
  [[nodiscard]] static Sample sample(const Surface& surface, std::uint32_t pixel);

  std::vector<std::uint32_t> first_;  // draw -> its first triangle in surfaces_
  std::vector<Surface> surfaces_;
};

/// The fragments of every VRAM pixel, in the order in which they were drawn; those that were erased are left
/// out, so covered ones, if there are any, come first.
class Fragments {
 public:
  /// Needs a trace that kept its history.
  explicit Fragments(const gpu::Trace& trace, Order order = Order::list);

  [[nodiscard]] std::span<const Fragment> at(std::uint32_t pixel) const {
    return std::span(fragments_).subspan(first_[pixel], first_[pixel + 1] - first_[pixel]);
  }
  [[nodiscard]] std::size_t size() const { return fragments_.size(); }
  /// All of them are numbered, pixel after pixel.
  [[nodiscard]] const Fragment& operator[](std::uint32_t number) const { return fragments_[number]; }
  /// The number of the first one of a pixel.
  [[nodiscard]] std::uint32_t first(std::uint32_t pixel) const {
    return static_cast<std::uint32_t>(first_[pixel]);
  }

 private:
  std::vector<std::size_t> first_;  // pixel -> its first fragment; one more at the end
  std::vector<Fragment> fragments_;
};

}  // namespace inspect
