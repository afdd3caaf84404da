#pragma once
// The one number that commands have everywhere: in listings, options, reports, panels and JSON.
//
//     F:K      command K of frame F, K from 1 in the order sent
//     F:K:B    the same, and the bucket of the ordering table it was linked into
//
// Counted is every command of port 0 and every word of port 1, those that only set state included, when the
// GPU begins to obey it: an upload when its size is known, a polyline with its first segment. Not counted are
// annotation words (E7h-EFh), which belong to the polygon behind them, so that a recording with depths and
// one without have the same numbers. Frames of recordings count from 1, those of scenes from 0 (their time),
// a list in RAM is frame 1.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gpu/primitive.h"

namespace gpu {

struct Number {
  std::uint64_t frame = 1;
  std::uint64_t command = 0;  ///< 0: before the first of the frame; what goes on from the frame before
  std::uint32_t bucket = no_bucket;

  bool operator==(const Number&) const = default;
};

/// Whether it comes before the other in the order sent.
inline bool is_before(const Number& a, const Number& b) {
  return a.frame != b.frame ? a.frame < b.frame : a.command < b.command;
}

/// "3:17", "3:17:512".
std::string to_text(const Number& number);

/// Reads what to_text writes; the bucket may be left out. Nothing: it is something else.
std::optional<Number> parse_number(std::string_view text);

/// As Primitive::command_number, of a draw that goes on from the frame before.
inline constexpr std::uint32_t going_on = 0xffffffff;

/// That of a decoded drawing command of frame `frame`.
inline Number number_of(std::uint64_t frame, const Primitive& primitive) {
  return {frame, primitive.command_number == going_on ? 0 : std::uint64_t{primitive.command_number} + 1,
          primitive.bucket};
}

}  // namespace gpu
