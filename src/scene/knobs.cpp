#include "scene/knobs.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace scene {
namespace {

using std::string_view;

// The words of each enumeration, in the order of its enumerators.
template <class E>
inline constexpr std::array<string_view, 0> words{};
template <>
inline constexpr std::array words<Visibility>{string_view("ot"), string_view("sorted"), string_view("bsp"),
                                              string_view("zbuffer")};
template <>
inline constexpr std::array words<Key>{string_view("average"), string_view("nearest"),
                                       string_view("farthest")};
template <>
inline constexpr std::array words<BucketOrder>{string_view("lifo"), string_view("fifo")};
template <>
inline constexpr std::array words<DepthFormat>{string_view("16"), string_view("24"), string_view("32"),
                                               string_view("float")};
template <>
inline constexpr std::array words<DepthMapping>{string_view("hyperbolic"), string_view("linear")};
template <>
inline constexpr std::array words<DepthTest>{string_view("less"), string_view("lequal")};
template <>
inline constexpr std::array words<WithoutDepth>{string_view("error"), string_view("list-order"),
                                                string_view("bucket")};
template <>
inline constexpr std::array words<Transform>{string_view("gte"), string_view("float"), string_view("double")};
template <>
inline constexpr std::array words<Position>{string_view("integer"), string_view("4"), string_view("16"),
                                            string_view("256")};
template <>
inline constexpr std::array words<TextureAddress>{string_view("affine"), string_view("perspective")};
template <>
inline constexpr std::array words<Filter>{string_view("nearest"), string_view("bilinear"),
                                          string_view("mipmap"), string_view("mipmap-linear")};
template <>
inline constexpr std::array words<Colour>{string_view("15"), string_view("15-dither"), string_view("24")};
template <>
inline constexpr std::array words<AaFilter>{string_view("box"), string_view("tent"), string_view("gauss")};
template <>
inline constexpr std::array words<AaSpace>{string_view("stored"), string_view("linear")};
template <>
inline constexpr std::array words<Fog>{string_view("vertex"), string_view("pixel")};
template <>
inline constexpr std::array words<bool>{string_view("off"), string_view("on")};

template <class T>
struct MemberType;
template <class T>
struct MemberType<T Knobs::*> {
  using type = T;
};
template <auto Member>
using TypeOf = typename MemberType<decltype(Member)>::type;

template <auto Member>
std::string get_word(const Knobs& knobs) {
  return std::string(words<TypeOf<Member>>[static_cast<std::size_t>(knobs.*Member)]);
}

template <auto Member>
bool set_word(Knobs& knobs, string_view value) {
  const auto& names = words<TypeOf<Member>>;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == value) {
      knobs.*Member = static_cast<TypeOf<Member>>(i);
      return true;
    }
  }
  return false;
}

template <class T>
std::optional<T> parse(string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <auto Member>
std::string get_int(const Knobs& knobs) {
  return std::to_string(knobs.*Member);
}

template <auto Member, int low, int high>
bool set_int(Knobs& knobs, string_view value) {
  const auto number = parse<int>(value);
  if (!number || *number < low || *number > high) return false;
  knobs.*Member = *number;
  return true;
}

template <auto Member>
std::string get_number(const Knobs& knobs) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), knobs.*Member);
  return {text.data(), error == std::errc() ? end : text.data()};
}

template <auto Member>
bool set_distance(Knobs& knobs, string_view value) {
  const auto number = parse<double>(value);
  if (!number || !std::isfinite(*number) || *number < 1e-6 || *number > 1e9) return false;
  knobs.*Member = *number;
  return true;
}

bool set_resolution(Knobs& knobs, string_view value) {
  const auto number = parse<int>(value);
  if (!number || (*number != 1 && *number != 2 && *number != 4 && *number != 8)) return false;
  knobs.resolution = *number;
  return true;
}

std::string get_size(const Knobs& knobs) {
  return std::to_string(knobs.width) + "x" + std::to_string(knobs.height);
}

bool set_size(Knobs& knobs, string_view value) {
  const auto cross = value.find('x');
  if (cross == string_view::npos) return false;
  const auto width = parse<int>(value.substr(0, cross));
  const auto height = parse<int>(value.substr(cross + 1));
  constexpr std::array widths{256, 320, 368, 512, 640};
  bool known = false;
  for (const int w : widths) known = known || w == width;
  if (!known || (height != 240 && height != 480)) return false;
  knobs.width = *width;
  knobs.height = *height;
  return true;
}

struct SubdivideWord {
  string_view prefix;
  int low, high;
};
constexpr std::array subdivide_words{
    // in the order of SubdivideBy
    SubdivideWord{"", 1, 16}, SubdivideWord{"size-", 4, 1024}, SubdivideWord{"error-", 1, 64}};

std::string get_subdivide(const Knobs& knobs) {
  const auto& word = subdivide_words[static_cast<std::size_t>(knobs.subdivide.by)];
  return std::string(word.prefix) + std::to_string(knobs.subdivide.n);
}

bool set_subdivide(Knobs& knobs, string_view value) {
  for (std::size_t i = 0; i < subdivide_words.size(); ++i) {
    const auto& word = subdivide_words[i];
    if (!value.starts_with(word.prefix)) continue;
    const auto number = parse<int>(value.substr(word.prefix.size()));
    if (!number || *number < word.low || *number > word.high) continue;
    knobs.subdivide = {static_cast<SubdivideBy>(i), *number};
    return true;
  }
  return false;
}

struct AntialiasWord {
  string_view prefix;
  AntialiasKind kind;
  int low, high;  // samples; low == high == 1: no number follows
};
constexpr std::array antialias_words{
    AntialiasWord{"none", AntialiasKind::off, 1, 1},
    AntialiasWord{"ssaa-", AntialiasKind::ssaa, 2, 8},
    AntialiasWord{"rotated-", AntialiasKind::rotated, 2, 64},
    AntialiasWord{"random-", AntialiasKind::random, 2, 64},
    AntialiasWord{"msaa-", AntialiasKind::msaa, 2, 8},
    AntialiasWord{"fxaa", AntialiasKind::fxaa, 1, 1},
    AntialiasWord{"taa", AntialiasKind::taa, 1, 1},
};

std::string get_antialias(const Knobs& knobs) {
  const auto& word = antialias_words[static_cast<std::size_t>(knobs.antialias.kind)];
  std::string text(word.prefix);
  if (word.high == 1) return text;
  const auto count = std::to_string(knobs.antialias.samples);
  return word.kind == AntialiasKind::ssaa ? text + count + "x" + count : text + count;
}

bool set_antialias(Knobs& knobs, string_view value) {
  for (const auto& word : antialias_words) {
    if (word.high == 1) {
      if (value != word.prefix) continue;
      knobs.antialias = {word.kind, 1};
      return true;
    }
    if (!value.starts_with(word.prefix)) continue;
    auto count = value.substr(word.prefix.size());
    if (word.kind == AntialiasKind::ssaa) {
      const auto cross = count.find('x');
      if (cross == string_view::npos || count.substr(0, cross) != count.substr(cross + 1)) return false;
      count = count.substr(0, cross);
    }
    const auto samples = parse<int>(count);
    if (!samples || *samples < word.low || *samples > word.high) return false;
    if (word.kind == AntialiasKind::msaa && *samples != 2 && *samples != 4 && *samples != 8) return false;
    knobs.antialias = {word.kind, *samples};
    return true;
  }
  return false;
}

#define WORD(member) get_word<&Knobs::member>, set_word<&Knobs::member>

constexpr std::array rows{
    KnobInfo{"visibility", "ot|sorted|bsp|zbuffer",
             "which surface wins: ordering table, sorted list, BSP, z-buffer", WORD(visibility)},
    KnobInfo{"buckets", "1..65536", "entries of the ordering table", get_int<&Knobs::buckets>,
             set_int<&Knobs::buckets, 1, 65536>},
    KnobInfo{"key", "average|nearest|farthest", "which depth of a polygon chooses its bucket", WORD(key)},
    KnobInfo{"bias", "-65536..65536", "added to every bucket number; positive pushes away",
             get_int<&Knobs::bias>, set_int<&Knobs::bias, -65536, 65536>},
    KnobInfo{"bucket-order", "lifo|fifo", "order inside a bucket; the console's is lifo", WORD(bucket_order)},
    KnobInfo{"depth", "16|24|32|float", "bits of the z-buffer", WORD(depth)},
    KnobInfo{"depth-mapping", "hyperbolic|linear", "how view-space z becomes a stored depth",
             WORD(depth_mapping)},
    KnobInfo{"depth-test", "less|lequal", "which of two equal depths wins: the first or the last",
             WORD(depth_test)},
    KnobInfo{"depth-reversed", "off|on", "store far as 0 and near as the greatest value",
             WORD(depth_reversed)},
    KnobInfo{"near", "1e-6..1e9", "z that is stored as the nearest depth", get_number<&Knobs::near_z>,
             set_distance<&Knobs::near_z>},
    KnobInfo{"far", "1e-6..1e9", "z that is stored as the farthest depth", get_number<&Knobs::far_z>,
             set_distance<&Knobs::far_z>},
    KnobInfo{"without-depth", "error|list-order|bucket",
             "what a polygon that brings no depth does to a z-buffer", WORD(without_depth)},
    KnobInfo{"transform", "gte|float|double", "arithmetic of the vertex transform", WORD(transform)},
    KnobInfo{"position", "integer|4|16|256", "vertex positions are multiples of 1, 1/4, 1/16 or 1/256 pixel",
             WORD(position)},
    KnobInfo{"texture", "affine|perspective", "interpolation of texture coordinates", WORD(texture)},
    KnobInfo{"subdivide", "1..16|size-4..1024|error-1..64",
             "polygons are drawn as n x n pieces, or halved by size or affine error in pixels", get_subdivide,
             set_subdivide},
    KnobInfo{"filter", "nearest|bilinear|mipmap|mipmap-linear", "texture filter", WORD(filter)},
    KnobInfo{"colour", "15|15-dither|24", "bits of a pixel", WORD(colour)},
    KnobInfo{"antialias", "none|ssaa-NxN|rotated-N|random-N|msaa-N|fxaa|taa", "how edges are smoothed",
             get_antialias, set_antialias},
    KnobInfo{"aa-filter", "box|tent|gauss", "weights of the samples of a pixel", WORD(aa_filter)},
    KnobInfo{"aa-space", "stored|linear",
             "samples are averaged as they are stored, or as light (sRGB decoded and encoded again)",
             WORD(aa_space)},
    KnobInfo{"fog", "vertex|pixel", "where depth cueing is computed", WORD(fog)},
    KnobInfo{"resolution", "1|2|4|8", "internal resolution, times the console's", get_int<&Knobs::resolution>,
             set_resolution},
    KnobInfo{"size", "256|320|368|512|640 x 240|480", "display mode, as 320x240", get_size, set_size},
};

#undef WORD

}  // namespace

std::span<const KnobInfo> knob_table() { return rows; }

base::Result<void> set_knob(Knobs& knobs, std::string_view name, std::string_view value) {
  for (const auto& knob : rows) {
    if (knob.name != name) continue;
    if (knob.set(knobs, value)) return {};
    return base::fail("--" + std::string(name) + " " + std::string(value) + ": expected " +
                      std::string(knob.values));
  }
  return base::fail("--" + std::string(name) + ": no such knob");
}

base::Result<void> check_knobs(const Knobs& knobs) {
  if (knobs.near_z < knobs.far_z) return {};
  return base::fail("--near " + get_number<&Knobs::near_z>(knobs) + " --far " +
                    get_number<&Knobs::far_z>(knobs) + ": near must be less than far");
}

}  // namespace scene
