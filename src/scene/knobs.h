#pragma once
// Every approximation of the console is a knob with a more accurate setting. The same words are used on the
// command line, in JSON, in the window and in the API: they stand once, in the table of knobs.cpp.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"
#include "gpu/canvas/options.h"
#include "gpu/depth.h"

namespace scene {

enum class Visibility : std::uint8_t { ot, sorted, bsp, zbuffer };
enum class Key : std::uint8_t { average, nearest, farthest };
enum class BucketOrder : std::uint8_t { lifo, fifo };
using gpu::DepthFormat, gpu::DepthMapping, gpu::DepthTest;
/// What a polygon that brings no depth does to a z-buffer.
enum class WithoutDepth : std::uint8_t {
  error,       ///< the frame is refused
  list_order,  ///< drawn where it stands in the list, neither tested nor stored
  bucket,      ///< drawn at the depth its bucket of the ordering table stands for
};
enum class Transform : std::uint8_t { gte, float32, float64 };
enum class Position : std::uint8_t {
  integer,
  quarter,
  sixteenth,
  fine
};  ///< fractions of a pixel: 1, 1/4, 1/16, 1/256
enum class TextureAddress : std::uint8_t { affine, perspective };
using gpu::canvas::Filter;
enum class Colour : std::uint8_t { bits15, bits15_dither, bits24 };
using AaFilter = gpu::canvas::Reconstruction;
using AaSpace = gpu::canvas::AverageOf;
enum class Fog : std::uint8_t { vertex, pixel };

enum class AntialiasKind : std::uint8_t { off, ssaa, rotated, random, msaa, fxaa, taa };
struct Antialias {
  AntialiasKind kind = AntialiasKind::off;
  int samples = 1;  ///< ssaa: N of N x N, 2..8; rotated, random: N samples, 2..64; msaa: 2, 4 or 8; else 1
  bool operator==(const Antialias&) const = default;
};

/// How polygons are cut, so that affine texture coordinates bend less.
enum class SubdivideBy : std::uint8_t {
  pieces,  ///< into n x n, once and for all
  size,    ///< in halves until no edge is longer than n pixels on the screen
  error,   ///< in halves until affine interpolation moves no edge's middle by more than n pixels
};
struct Subdivide {
  SubdivideBy by = SubdivideBy::pieces;
  int n = 1;  ///< pieces: 1..16; size: 4..1024; error: 1..64
  bool operator==(const Subdivide&) const = default;
  /// What is cut before any frame: n x n.
  [[nodiscard]] int pieces() const { return by == SubdivideBy::pieces ? n : 1; }
};

/// All knobs, at the console's settings.
struct Knobs {
  Visibility visibility = Visibility::ot;
  int buckets = 1024;  ///< 1..65536 entries of the ordering table
  Key key = Key::average;
  int bias = 0;  ///< added to every bucket number, -65536..65536; positive pushes away
  BucketOrder bucket_order = BucketOrder::lifo;
  DepthFormat depth = DepthFormat::bits24;
  DepthMapping depth_mapping = DepthMapping::hyperbolic;
  DepthTest depth_test = DepthTest::less;
  bool depth_reversed = false;
  double near_z = 16;    ///< view-space units; the depth formats' near and far
  double far_z = 65535;  ///< view-space units
  WithoutDepth without_depth = WithoutDepth::error;
  Transform transform = Transform::gte;
  Position position = Position::integer;
  TextureAddress texture = TextureAddress::affine;
  Subdivide subdivide{};
  Filter filter = Filter::nearest;
  Colour colour = Colour::bits15_dither;
  Antialias antialias{};
  AaFilter aa_filter = AaFilter::box;
  AaSpace aa_space = AaSpace::stored;
  Fog fog = Fog::vertex;
  int resolution = 1;  ///< 1, 2, 4 or 8 times the console's
  int width = 320;     ///< 256, 320, 368, 512 or 640
  int height = 240;    ///< 240 or 480

  bool operator==(const Knobs&) const = default;
};

/// One row of the table: how a knob is called and what may stand behind it.
struct KnobInfo {
  std::string_view name;    ///< "depth-mapping": the option without its dashes, the JSON key
  std::string_view values;  ///< "hyperbolic|linear" or "1..65536", for help and error messages
  std::string_view help;
  std::string (*get)(const Knobs&);
  bool (*set)(Knobs&, std::string_view value);  ///< false: the value is not one of `values`; knobs unchanged
};

/// The table, in the order in which help prints it.
std::span<const KnobInfo> knob_table();

/// Sets one knob by name. Error: unknown name, or a value outside what the table
/// allows (both named in the text).
base::Result<void> set_knob(Knobs& knobs, std::string_view name, std::string_view value);

/// Knobs that contradict each other (near >= far) or cannot be met by this build.
/// Call after the last set_knob.
base::Result<void> check_knobs(const Knobs& knobs);

}  // namespace scene
