#pragma once
// What the knobs mean for one frame, decided once: below this no code of a frame sees a knob.

#include <cstdint>
#include <optional>

#include "gpu/canvas/options.h"
#include "gpu/depth.h"
#include "ot/ordering_table.h"
#include "scene/frame.h"
#include "scene/knobs.h"
#include "scene/project.h"
#include "scene/world.h"

namespace scene {

struct Primitive;

/// What the faces of a world have that a knob may be about.
struct Shown {
  bool polygons = true;
  bool textured = true;
  bool gouraud = true;  ///< colours that change across a face
  bool operator==(const Shown&) const = default;
};

/// What every packet of a frame has in common, and whose annotation nodes hold what.
struct PacketStyle {
  bool windows = false;               ///< textured primitives set their texture window
  bool depth = false;                 ///< depths of all polygons,
  bool depth_of_shaded = false;       ///< or of those with a texture or colours that change
  bool fractions = false;             ///< fractions of all polygons,
  std::uint8_t fraction_mask = 0xff;  ///< of which these bits count
  bool texel_rests = false;           ///< of textured ones what whole texture coordinates leave over
  std::uint32_t draw_mode = 0;  ///< E1h word without page and blend: dither, draw to the displayed field
  bool operator==(const PacketStyle&) const = default;
};

/// Bucket (or sort key) of a primitive: 0..length-1, far is high.
struct BucketRule {
  std::uint32_t length = 1;
  std::int64_t bias = 0;
  std::int64_t bias_step = 1;  ///< of a material's bias
  bool operator==(const BucketRule&) const = default;
  /// As the formula gives it.
  [[nodiscard]] std::int64_t wanted(const Primitive& p) const;
  /// Limited to the table.
  [[nodiscard]] std::uint32_t limited(std::int64_t wanted) const;
  [[nodiscard]] std::uint32_t of(const Primitive& p) const { return limited(wanted(p)); }
};

/// What puts the primitives of a frame in order.
enum class Sorting : std::uint8_t {
  table,  ///< an ordering table: buckets
  keys,   ///< a list sorted by key
  split,  ///< polygons are split until they have an order
};

struct Plan {
  int width = 320, height = 240;
  Sorting sorting = Sorting::table;
  BucketRule rule;  ///< the length of an order by splitting is known once it is found
  ot::Order order_in_bucket = ot::Order::lifo;
  Key key = Key::average;
  Transform transform = Transform::gte;
  std::optional<Subdivide> halving;  ///< on the screen; nothing: faces are drawn as their models have them
  PacketStyle style;
  Wanted wanted;
  std::uint8_t fraction_mask = 0;  ///< bits of the fractions that corners are drawn with; 0: whole pixels
  int split_scale = 1;             ///< samples a pixel and axis that the order by splitting is exact for
  bool default_depth_of_bucket = false;    ///< polygons that bring no depth get their bucket's
  bool refuses_without_depth = true;       ///< one that has none refuses the frame
  std::optional<gpu::DepthOptions> depth;  ///< the z-buffer beside VRAM; nothing: none, or the canvas' own
  std::optional<gpu::canvas::Options> canvas;  ///< nothing: VRAM shows the same
  Shown shown;

  /// Frames of equal plans are drawn alike: a knob that changes no plan is not called for.
  bool operator==(const Plan&) const = default;
  [[nodiscard]] std::int32_t buffer_y(std::uint32_t frame) const {
    return height == 240 && frame % 2 == 1 ? 240 : 0;
  }
};

/// What of a world the plan depends on, besides the knobs.
struct PlanInput {
  const World& world;  ///< as it is at the time of the frame
  double units_per_world = 1;
  bool windows = false;  ///< some texture needs a texture window
  Shown shown{};
  Annotate annotate = Annotate::when_needed;
  Pieces pieces = Pieces::limited;
};
[[nodiscard]] Plan plan_frame(const Knobs& knobs, const PlanInput& input);

/// The depth stage that the knobs ask for; nothing unless visibility is zbuffer.
[[nodiscard]] std::optional<gpu::DepthOptions> depth_options(const Knobs& knobs);

/// The canvas that the knobs ask for; nothing where the console's own frame buffer shows the same, as with a
/// knob about what is not there. FXAA alone needs none: it filters the finished picture.
[[nodiscard]] std::optional<gpu::canvas::Options> canvas_options(const Knobs& knobs, const World& world,
                                                                 double units_per_world,
                                                                 const Shown& shown = {});

}  // namespace scene
