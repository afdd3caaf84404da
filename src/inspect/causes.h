#pragma once
// Why a pixel is wrong. The first cause that matches is the pixel's; all that match are its raw causes.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "inspect/fragments.h"
#include "inspect/truth.h"

namespace inspect {

enum class Cause : std::uint8_t {
  blend_order,       ///< right owner, but the set or sequence of semi-transparent layers over it is wrong
  interpenetration,  ///< over the pixels winner and owner share, now one is nearer and now the other
  cyclic_overlap,    ///< the two are in one cycle of "must be drawn before"
  bucket_tie,        ///< equal keys, list order decided
  key_inversion,     ///< the keys have the two the wrong way round
  list_order,        ///< a list whose keys are not known has the two the wrong way round
  depth_tie,         ///< z-buffer: equal stored depths
  depth_precision,   ///< z-buffer: stored depths in the wrong order
};
inline constexpr std::array<std::string_view, 8> cause_names{
    "BlendOrder",   "Interpenetration", "CyclicOverlap", "BucketTie",
    "KeyInversion", "ListOrder",        "DepthTie",      "DepthPrecision"};
inline constexpr std::size_t cause_count = cause_names.size();
inline std::string_view name(Cause cause) { return cause_names[static_cast<std::size_t>(cause)]; }

/// A set of causes.
class CauseSet {
 public:
  void add(Cause cause) { bits_ = static_cast<std::uint16_t>(bits_ | 1U << static_cast<unsigned>(cause)); }
  [[nodiscard]] bool contains(Cause cause) const { return (bits_ >> static_cast<unsigned>(cause) & 1) != 0; }
  [[nodiscard]] std::optional<Cause> first() const;

 private:
  std::uint16_t bits_ = 0;
};

struct WrongPixel {
  std::uint32_t pixel = 0;  ///< y * 1024 + x in VRAM
  std::uint32_t winner = nobody,
                owner = nobody;  ///< draws; BlendOrder: the layer on top, and the one it hides
  std::uint8_t winner_half = 0, owner_half = 0;  ///< 1: the second triangle of a quad
  bool is_blend = false;                         ///< the opaque owner is right
  CauseSet causes;                               ///< empty with Order::exact
};

/// Fills in `causes` of every wrong pixel.
void find_causes(std::vector<WrongPixel>& wrong, const gpu::Trace& trace, const Fragments& fragments,
                 Surfaces& surfaces, Order order);

}  // namespace inspect
