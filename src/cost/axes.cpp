#include "cost/axes.h"

#include <array>
#include <cassert>

namespace cost {
namespace {

std::vector<Axis> make_axes() {
  const auto one = [](std::string_view knob) {
    return [knob](std::string_view value, bool in_quick = true) {
      return Setting{value, {{knob, value}}, in_quick};
    };
  };
  const auto transform = one("transform");
  const auto position = one("position");
  const auto filter = one("filter");
  const auto colour = one("colour");
  const auto antialias = one("antialias");
  const auto fog = one("fog");
  const auto table = [](std::string_view name, std::string_view buckets, std::string_view key,
                        bool in_quick) {
    return Setting{name, {{"visibility", "ot"}, {"buckets", buckets}, {"key", key}}, in_quick};
  };
  const auto zbuffer = [](std::string_view name, std::string_view depth, std::string_view mapping,
                          bool in_quick) {
    return Setting{name, {{"visibility", "zbuffer"}, {"depth", depth}, {"depth-mapping", mapping}}, in_quick};
  };
  const auto texture = [](std::string_view name, std::string_view address, std::string_view pieces,
                          bool in_quick) {
    return Setting{name, {{"texture", address}, {"subdivide", pieces}}, in_quick};
  };
  const auto resolution = [](std::string_view name, std::string_view value, bool in_quick = true) {
    return Setting{name, {{"resolution", value}}, in_quick};
  };
  const auto filtered = [](std::string_view name, std::string_view samples, std::string_view weights) {
    return Setting{name, {{"antialias", samples}, {"aa-filter", weights}}, false};
  };
  return {
      {"visibility",
       "Deciding visibility",
       Measure::wrong_surface,
       {table("ot 16", "16", "average", true),
        table("ot 64", "64", "average", false),
        table("ot 256", "256", "average", false),
        table("ot 1024", "1024", "average", true),
        table("ot 4096", "4096", "average", false),
        table("ot 1024 nearest", "1024", "nearest", false),
        table("ot 1024 farthest", "1024", "farthest", false),
        {"sorted", {{"visibility", "sorted"}}, true},
        {"bsp", {{"visibility", "bsp"}}, true},
        zbuffer("z 16 linear", "16", "linear", false),
        zbuffer("z 16", "16", "hyperbolic", false),
        zbuffer("z 24", "24", "hyperbolic", true),
        zbuffer("z 32", "32", "hyperbolic", false),
        zbuffer("z float", "float", "hyperbolic", false)},
       3,
       true},
      {"transform",
       "Transforming vertices",
       Measure::geometric,
       {transform("gte"), transform("float"), transform("double")},
       0,
       false},
      {"position",
       "Placing vertices",
       Measure::geometric,
       {position("integer"), position("4", false), position("16", false), position("256")},
       0,
       false},
      {"texture",
       "Interpolating texture coordinates",
       Measure::texel,
       {texture("affine", "affine", "1", true), texture("affine 2x2", "affine", "2", false),
        texture("affine 4x4", "affine", "4", true), texture("affine 8x8", "affine", "8", false),
        texture("affine size-32", "affine", "size-32", false),
        texture("affine error-1", "affine", "error-1", true),
        texture("perspective", "perspective", "1", true)},
       0,
       false},
      {"filter",
       "Filtering textures",
       Measure::colour,
       {filter("nearest"), filter("bilinear"), filter("mipmap", false), filter("mipmap-linear")},
       0,
       true},
      {"colour",
       "Keeping colours",
       Measure::block_colour,
       {colour("15"), colour("15-dither"), colour("24")},
       1,
       false},
      {"antialias",
       "Smoothing edges",
       Measure::edge,
       {antialias("none"), antialias("fxaa"), antialias("taa"), antialias("msaa-2", false),
        antialias("msaa-4"), antialias("msaa-8", false), antialias("ssaa-2x2"), antialias("random-4", false),
        antialias("rotated-4"), antialias("rotated-8", false), antialias("ssaa-4x4", false),
        filtered("rotated-16 tent", "rotated-16", "tent"),
        filtered("rotated-16 gauss", "rotated-16", "gauss"), antialias("rotated-16"),
        antialias("ssaa-8x8", false)},
       0,
       true},
      {"fog", "Fading into fog", Measure::colour, {fog("vertex"), fog("pixel")}, 0, false},
      {"resolution",
       "Drawing at a higher resolution",
       Measure::edge,
       {resolution("x1", "1"), resolution("x2", "2"), resolution("x4", "4", false),
        resolution("x8", "8", false)},
       0,
       true},
  };
}

scene::Knobs set(scene::Knobs knobs, std::initializer_list<Setting::Value> values) {
  for (const auto& [knob, value] : values) {
    [[maybe_unused]] const auto done = scene::set_knob(knobs, knob, value);
    assert(done);
  }
  return knobs;
}

}  // namespace

const MeasureInfo& info(Measure measure) {
  static constexpr std::array<MeasureInfo, measure_count> table{{
      {"wrong_surface", "share of wrong-surface pixels", "%"},
      {"geometric_px", "vertex error", "pixels"},
      {"texel", "texture-coordinate error", "texels"},
      {"colour_rms", "colour error", "rms of 255"},
      {"block_rms", "error of 4x4 means", "rms of 255"},
      {"edge_rms", "edge error against area coverage", "rms of 1"},
  }};
  return table[static_cast<std::size_t>(measure)];
}

std::span<const Axis> axes() {
  static const std::vector<Axis> table = make_axes();
  return table;
}

const Axis* find_axis(std::string_view name) {
  for (const auto& axis : axes()) {
    if (axis.name == name) return &axis;
  }
  return nullptr;
}

scene::Knobs with(const scene::Knobs& base, const Setting& setting) {
  scene::Knobs knobs = base;
  for (const auto& [knob, value] : setting.values) knobs = set(knobs, {{knob, value}});
  return knobs;
}

scene::Knobs console_knobs(const scene::Knobs& given) {
  scene::Knobs knobs;
  knobs.width = given.width;
  knobs.height = given.height;
  knobs.buckets = given.buckets;
  knobs.near_z = given.near_z;
  knobs.far_z = given.far_z;
  return knobs;
}

scene::Knobs accurate_knobs(const scene::Knobs& given) {
  return set(console_knobs(given), {{"visibility", "zbuffer"},
                                    {"depth", "32"},
                                    {"transform", "double"},
                                    {"position", "256"},
                                    {"texture", "perspective"},
                                    {"filter", "mipmap-linear"},
                                    {"colour", "24"},
                                    {"antialias", "rotated-16"},
                                    {"fog", "pixel"}});
}

scene::Knobs reference_knobs(const scene::Knobs& given) {
  // 64 samples a pixel integrate the texture too; a mip map on top would blur it.
  return set(accurate_knobs(given), {{"antialias", "ssaa-8x8"}, {"filter", "bilinear"}});
}

std::vector<Combination> combinations(const scene::Knobs& given, bool quick) {
  struct Choice {
    std::string_view name;
    std::vector<Setting::Value> values;
  };
  const std::vector<Choice> surfaces{{"ot", {}}, {"z 24", {{"visibility", "zbuffer"}}}};
  const std::vector<Choice> textures{{"affine", {}},
                                     {"affine 4x4", {{"subdivide", "4"}}},
                                     {"affine error-1", {{"subdivide", "error-1"}}},
                                     {"perspective", {{"texture", "perspective"}}}};
  const std::vector<Choice> positions{{"whole pixels", {}},
                                      {"1/256 pixel", {{"position", "256"}, {"transform", "double"}}}};
  const std::vector<Choice> colours{{"15-dither", {}}, {"24", {{"colour", "24"}, {"fog", "pixel"}}}};
  const std::vector<Choice> filters{{"nearest", {}}, {"mipmap-linear", {{"filter", "mipmap-linear"}}}};
  std::vector<Choice> edges{{"none", {}}};
  for (const auto mode : {"fxaa", "msaa-4", "rotated-4", "msaa-8", "rotated-8", "rotated-16", "ssaa-8x8"})
    edges.push_back({mode, {{"antialias", mode}}});
  constexpr std::size_t cheap_edges = 4;  // the others cost more than all else, which is then at its best
  std::vector<Combination> list;
  const scene::Knobs base = console_knobs(given);
  const auto add = [&](std::initializer_list<const Choice*> choices) {
    scene::Knobs knobs = base;
    std::string name;
    for (const Choice* choice : choices) {
      if (!name.empty()) name += ", ";
      name += choice->name;
      for (const auto& value : choice->values) knobs = set(knobs, {value});
    }
    list.push_back({std::move(name), knobs});
  };
  for (const auto& surface : surfaces) {
    for (const auto& texture : textures) {
      for (const auto& position : positions) {
        for (const auto& colour : colours) {
          for (const auto& filter : filters) {
            // A quick report takes all of what is accurate together or none of it.
            const bool is_mixed = texture.values.empty() != position.values.empty() ||
                                  position.values.empty() != colour.values.empty() ||
                                  colour.values.empty() != filter.values.empty();
            if (quick && is_mixed) continue;
            const std::size_t most = quick ? 3 : colour.values.empty() ? cheap_edges : edges.size();
            for (const auto& edge : std::span(edges).first(most))
              add({&surface, &texture, &position, &colour, &filter, &edge});
          }
        }
      }
    }
  }
  return list;
}

}  // namespace cost
