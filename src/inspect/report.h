#pragma once
// The artifact report of one frame: which pixels are wrong, why, and between whom.
//
//     gpu::Trace trace;
//     trace.keep_history = true;
//     gpu.set_trace(&trace);
//     ... draw a frame whose polygons carry depth (annotation words) ...
//     const auto report = inspect::inspect(trace, {.scene = "mine"});
//     report.wrong_pixels(), report.count(inspect::Cause::bucket_tie), inspect::to_text(report) ...

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gpu/number.h"
#include "gpu/trace.h"
#include "inspect/causes.h"
#include "inspect/lint.h"

namespace inspect {

/// A rectangle of VRAM.
struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] bool is_empty() const { return width <= 0 || height <= 0; }
  bool operator==(const Rectangle&) const = default;
};

struct Options {
  Order order = Order::list;
  std::string scene = "trace";
  std::uint32_t frame = 0;
  Rectangle
      picture{};  ///< whose top left corner is 0,0 in the report; empty: the drawing area of most polygons
};

/// One draw as the report names it.
struct DrawId {
  std::uint32_t draw = nobody;  ///< index into Trace::draws
  std::uint64_t command = 0;    ///< as gpu::Number has it, from 1; 0: going on from the frame before
  std::uint32_t bucket = gpu::no_bucket;
};

/// Two draws and one cause: `winner` is seen where `owner` should be.
struct WrongPair {
  DrawId winner, owner;
  Cause cause = Cause::blend_order;
  bool has_cause = true;  ///< false for visibility bsp
  std::uint64_t pixels = 0;
  std::uint32_t example = 0;                 ///< one of them
  double winner_depth = 0, owner_depth = 0;  ///< there, in view-space units, rounded; 0 for nobody
  /// There: which triangle of a quad is meant, 1 the second one.
  std::uint8_t winner_half = 0, owner_half = 0;
  /// There: both triangles of the draw cover the pixel, so that its half has to be named.
  bool winner_is_folded = false, owner_is_folded = false;
};

/// How full the buckets are. `known` is false for a list without a table: nothing here counts then.
struct BucketCensus {
  bool known = false;
  std::uint32_t used = 0;                ///< buckets with a polygon or line in them
  std::uint32_t largest = 0;             ///< the most in one bucket
  std::uint32_t largest_bucket = 0;      ///< which one
  std::uint64_t tied = 0;                ///< draws that share their bucket with another
  std::vector<std::uint32_t> histogram;  ///< [n]: buckets that hold 2^n .. 2^(n+1)-1 draws
};

struct Report {
  std::string scene;
  std::uint32_t frame = 0;
  Rectangle picture;
  Order order = Order::list;
  std::uint64_t pixels_drawn = 0;            ///< that a polygon, rectangle or line wrote
  std::uint64_t fragments = 0;               ///< of polygons with depth: the samples truth looked at
  std::uint32_t polygons_judged = 0;         ///< with depth
  std::uint32_t polygons_without_depth = 0;  ///< layers: nothing is known about where they belong
  std::vector<WrongPixel> wrong;             ///< by VRAM address
  std::array<std::uint64_t, cause_count> causes{}, raw_causes{};
  std::vector<WrongPair> pairs;  ///< most pixels first
  BucketCensus buckets;
  std::vector<LintItem> lint;
  exact::DecisionCounts decisions;

  [[nodiscard]] std::uint64_t wrong_pixels() const { return wrong.size(); }
  [[nodiscard]] std::uint64_t count(Cause cause) const { return causes[static_cast<std::size_t>(cause)]; }
  [[nodiscard]] std::uint64_t raw_count(Cause cause) const {
    return raw_causes[static_cast<std::size_t>(cause)];
  }
};

/// What is kept of many frames.
struct Sums {
  std::uint64_t frames = 0, pixels_drawn = 0, wrong_pixels = 0;
  std::array<std::uint64_t, cause_count> causes{}, raw_causes{};
  exact::DecisionCounts decisions;
  std::uint32_t worst_frame = 0;   ///< the one with the most wrong pixels,
  std::uint64_t worst_pixels = 0;  ///< and how many

  void add(const Report& report);
};

/// Judges every pixel of a trace that kept its history. Time grows linearly with the fragments.
/// A trace without depth gives no wrong pixel: polygons_judged says that nothing was looked at.
Report inspect(const gpu::Trace& trace, const Options& options);

/// Draw `draw` of a trace, or nobody.
DrawId draw_id(const gpu::Trace& trace, std::uint32_t draw);

/// " (second half)" of a draw whose quad is folded over itself; empty if it is not.
std::string half_name(bool is_folded, std::uint8_t half);
/// The draw's number, "3:17:512" or "3:17" (gpu/number.h); "background" for nobody.
std::string id(std::uint32_t frame, const DrawId& draw);

/// The table `otter inspect` prints.
std::string to_text(const Report& report);
/// The line or two below the tables of several frames.
std::string to_text(const Sums& sums);

}  // namespace inspect
