#pragma once
// A world becomes a list of GP0 packets in main RAM: animate, project, cull, clip, sort into the table.
//
// VRAM: the frame buffers stand at (0,0) and, in 240-line modes, (0,240); 480-line modes have one. Textures
// lie to the right of them, colour tables below (scene/texture.h).

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "gpu/columns.h"
#include "ot/packet.h"
#include "scene/knobs.h"
#include "scene/world.h"

namespace ot {
class MainRam;
}
namespace gpu {
class Gpu;
}

namespace scene {

/// Why a face of the scene is not in the list. None of them costs a visible pixel but `unrepresentable`.
enum class Drop : std::uint8_t {
  back_face,        ///< NCLIP: seen from behind, or no area on the screen
  outside,          ///< wholly beyond one side of the picture
  near_plane,       ///< wholly nearer than the near plane
  far_plane,        ///< wholly farther than 65535 units
  unrepresentable,  ///< its instance's matrix does not fit 1.3.12, or is not finite
};
inline constexpr std::array drop_names{"back face", "outside", "near plane", "far plane", "unrepresentable"};
inline constexpr std::size_t drop_reasons = drop_names.size();
/// The same in terms of the console.
inline constexpr std::array drop_reasons_in_words{
    "NCLIP is not positive, seen from behind or without area", "beyond one side of the picture",
    "nearer than the near plane, where FLAG tells of an overflow in the division",
    "farther than 65535, where FLAG tells of SZ saturated", "FLAG would tell of an overflow in the matrix"};
static_assert(drop_reasons_in_words.size() == drop_reasons);
/// Keys of visibility sorted: as many as AVSZ has values.
inline constexpr std::uint32_t sort_keys = 65536;

/// Primitives whose bucket, bias included, is not one of the table's. They go into its first or last.
struct OutOfRange {
  std::uint32_t below = 0;  ///< less than 0
  std::uint32_t at =
      0;  ///< the length: programs that compare with > where >= is needed write beside the table
  std::uint32_t above = 0;
  OutOfRange& operator+=(const OutOfRange& other) {
    below += other.below;
    at += other.at;
    above += other.above;
    return *this;
  }
};

/// What one frame was made of and how long each stage took.
struct FrameStats {
  std::uint32_t vertices = 0;                         ///< projected, those that clipping made included
  std::uint32_t faces = 0;                            ///< faces and lines of all instances
  std::array<std::uint32_t, drop_reasons> dropped{};  ///< faces and lines that drew nothing, by Drop
  std::uint32_t clipped = 0;                          ///< faces and lines that were cut
  std::uint32_t splits = 0;                           ///< cuts that visibility bsp made
  bool was_stopped = false;                           ///< the order of visibility bsp is not finished
  std::uint32_t snapped = 0;                          ///< pieces of polygons that became triangles (Pieces)
  std::uint32_t primitives = 0;                       ///< polygons and lines in the lists
  OutOfRange out_of_range;      ///< of them; not with visibility bsp, which has no buckets
  std::uint32_t lists = 0;      ///< 1 unless the frame did not fit into RAM at once
  std::uint32_t words = 0;      ///< payload words of all primitives and annotations
  std::uint32_t ram_bytes = 0;  ///< table and packets, the largest list
  double gte_ms = 0;            ///< animate, transform, light
  double ot_ms = 0;             ///< cull, clip, packets, insertion
  double raster_ms = 0;         ///< walk and draw (filled by render_frame)
  [[nodiscard]] std::uint32_t dropped_by(Drop reason) const {
    return dropped[static_cast<std::size_t>(reason)];
  }
};

/// Depths in the list: only if a knob needs them, or always (recording for both ways of drawing, inspection).
enum class Annotate : std::uint8_t { when_needed, always };

/// The pieces of polygons that visibility bsp split: their parents, within limits that only the marks tell,
/// or triangles of their own, which the words alone draw (scene/snap.h).
enum class Pieces : std::uint8_t { limited, snapped };

/// The list that is in RAM now. A frame that fits has one. Otherwise `nearer_lists` more follow: draw this
/// one, then FrameBuilder::next puts the next nearer one in its place.
struct Frame {
  std::uint32_t number = 0;         ///< t * 60, rounded: its parity chooses the buffer
  std::uint32_t head = 0;           ///< address of the first tag: environment, then the table, far to near
  std::uint32_t table_address = 0;  ///< bucket b's tag is at table_address + 4 * b (visibility ot, zbuffer)
  std::uint32_t buckets = 0;        ///< length of that table; 0: none (sorted, bsp)
  std::uint32_t nearer_lists = 0;   ///< lists still to come
  std::int32_t buffer_y = 0;        ///< where in VRAM this frame is drawn: (0, buffer_y)
  FrameStats stats;
};

/// What the list in RAM does not say of a node: its sort key, and the pixels that a split polygon may draw.
struct NodeMark {
  std::uint32_t tag = 0;                   ///< the first tag of the primitive's nodes
  std::uint32_t key = none;                ///< none: the order has no keys (bsp)
  std::optional<gpu::Limits> limits = {};  ///< nothing: all of its pixels
};

/// A polygon as it will be drawn: the seam for everything that orders polygons in its own way (bsp, truth).
struct ScreenPolygon {
  ot::Polygon packet;          ///< with drawing-area coordinates, before the draw offset
  ot::DepthAnnotation depth;   ///< always filled, fractions too
  std::uint32_t otz = 0;       ///< 0..65535 on the scale of the sort key, bias not added
  std::uint32_t bucket = 0;    ///< with bias, clamped to the table
  std::uint32_t instance = 0;  ///< index into World::instances
  std::uint32_t face = 0;      ///< index into its mesh's faces, as given (before subdivision)
  std::uint32_t window = 0;    ///< E2h word it needs (texture repeat)
};

struct Plan;

/// One scene, ready to be built frame by frame. Keeps its own copy of the world, which it animates.
class FrameBuilder {
 public:
  /// Scales and packs the textures, turns meshes into 16-bit vertices. Never fails:
  /// what did not fit is in report().
  FrameBuilder(const Scene& scene, const Knobs& knobs);
  ~FrameBuilder();
  FrameBuilder(FrameBuilder&&) noexcept;
  FrameBuilder& operator=(FrameBuilder&&) noexcept;
  FrameBuilder(const FrameBuilder&) = delete;
  FrameBuilder& operator=(const FrameBuilder&) = delete;

  /// Lines for the user, once: scale, textures that were shrunk, repeats that were split.
  [[nodiscard]] const std::vector<std::string>& report() const;
  /// GTE units per world unit, chosen or given.
  [[nodiscard]] double units_per_world() const;

  /// Makes ready for other knobs: packs and subdivides again if the size or subdivide knob changed.
  void prepare(const Knobs& knobs);
  /// True if prepare() would have to do something, after which upload() is due.
  [[nodiscard]] bool needs_upload(const Knobs& knobs) const;
  /// GP0(A0h) uploads of all textures, display mode and range by GP1. Call once, again after prepare()
  /// changed anything or the GPU was reset. (render_frame does the former.)
  void upload(gpu::Gpu& gpu);
  /// The same words, for recording: GP0 words of the textures, GP1 words of the display.
  [[nodiscard]] std::vector<std::uint32_t> upload_gp0() const;
  [[nodiscard]] std::vector<std::uint32_t> display_gp1() const;

  /// The state of the world at `seconds`, as a list in `ram` (whose whole contents may be overwritten).
  /// Error: one bucket alone does not fit (bytes needed and available are named).
  [[nodiscard]] base::Result<Frame> build(double seconds, const Knobs& knobs, ot::MainRam& ram,
                                          Annotate annotate = Annotate::when_needed,
                                          Pieces pieces = Pieces::limited);
  /// Puts the next nearer list into `ram`; needs frame.nearer_lists > 0 and the knobs of build().
  [[nodiscard]] base::Result<void> next(Frame& frame, ot::MainRam& ram);

  /// Visibility sorted and bsp: marks of the list that is in RAM now, in list order.
  /// Valid until the next build().
  [[nodiscard]] std::vector<NodeMark> marks() const;

  /// What build() would insert, in that order, lines left out. For visibility bsp and for inspection.
  void polygons(double seconds, const Knobs& knobs, std::vector<ScreenPolygon>& out);

  /// GP1(05h) word that shows `frame` once it is drawn.
  [[nodiscard]] static std::uint32_t show_gp1(const Frame& frame);

  /// The camera that the frame is seen from; empty: the scene's own. For free flight in the window.
  void set_camera(const Camera* camera);
  /// What the knobs of the last build() meant for its frame; and what others would mean for the world as it
  /// is.
  [[nodiscard]] const Plan& plan() const;
  [[nodiscard]] Plan plan_of(const Knobs& knobs) const;
  /// Asked again and again while visibility bsp seeks an order, which may take minutes: false ends the
  /// search, and the frame has FrameStats::was_stopped. Told how much is done, 0..1.
  void set_keep_going(std::function<bool(double)> keep_going);
  /// The world as the last build() left it.
  [[nodiscard]] const World& world() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace scene
