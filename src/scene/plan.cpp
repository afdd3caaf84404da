#include "scene/plan.h"

#include <algorithm>
#include <array>

#include "gpu/canvas/sample_pattern.h"
#include "ot/packet.h"

namespace scene {
namespace {

namespace canvas = gpu::canvas;

int bits_of(Position position) {
  constexpr std::array bits{0, 2, 4, 8};
  return bits[static_cast<std::size_t>(position)];
}

std::uint8_t fraction_mask(Position position) {
  return static_cast<std::uint8_t>(0xff00 >> bits_of(position));
}

void choose_samples(const Antialias& antialias, canvas::Options& options) {
  switch (antialias.kind) {
    case AntialiasKind::off:
    case AntialiasKind::fxaa:
      break;
    case AntialiasKind::ssaa:
      options.layers = canvas::regular_grid(antialias.samples);
      break;
    case AntialiasKind::rotated:
      options.layers = canvas::rotated_grid(antialias.samples);
      break;
    case AntialiasKind::random:
      options.layers = canvas::cell_middles(antialias.samples);
      options.scatter_seed = 1;
      break;
    case AntialiasKind::msaa:
      options.samples = canvas::rotated_grid(antialias.samples);
      break;
    case AntialiasKind::taa:
      options.temporal = true;
      break;
  }
}

std::optional<canvas::Fog> fog(const Knobs& knobs, const World& world, double units) {
  const DepthCue& cue = world.depth_cue;
  if (knobs.fog != Fog::pixel || !cue.on) return std::nullopt;
  const double near = cue.near_z * units;
  const double far = cue.far_z * units;
  if (!(near > 0) || !(far > near)) return std::nullopt;
  return canvas::Fog{cue.colour.r, cue.colour.g, cue.colour.b, near, far};
}

std::uint32_t draw_mode_of(const Knobs& knobs) {
  ot::DrawMode mode;
  mode.dither = knobs.colour == Colour::bits15_dither;
  mode.draw_to_display = knobs.height == 480;
  std::array<std::uint32_t, 1> word{};
  ot::encode(mode, word);
  return word[0];
}

bool needs_fractions(const Knobs& knobs, const Shown& shown) {
  return knobs.position != Position::integer && shown.polygons;
}

bool needs_perspective(const Knobs& knobs, const Shown& shown) {
  return knobs.texture == TextureAddress::perspective && (shown.textured || shown.gouraud);
}

Filter needed_filter(const Knobs& knobs, const Shown& shown) {
  return shown.textured ? knobs.filter : Filter::nearest;
}

PacketStyle style_of(const Knobs& knobs, const PlanInput& input) {
  PacketStyle style;
  style.windows = input.windows;
  style.fractions = needs_fractions(knobs, input.shown);
  style.depth = input.annotate == Annotate::always || knobs.visibility == Visibility::zbuffer ||
                fog(knobs, input.world, input.units_per_world).has_value();
  style.depth_of_shaded = needs_perspective(knobs, input.shown);
  // The texture's own knobs ask for exact coordinates; others leave them as the console has them.
  style.texel_rests =
      input.shown.textured && (style.depth_of_shaded || needed_filter(knobs, input.shown) != Filter::nearest);
  if (style.fractions) style.fraction_mask = fraction_mask(knobs.position);
  style.draw_mode = draw_mode_of(knobs);
  return style;
}

Sorting sorting_of(Visibility visibility) {
  switch (visibility) {
    case Visibility::sorted:
      return Sorting::keys;
    case Visibility::bsp:
      return Sorting::split;
    case Visibility::ot:
    case Visibility::zbuffer:
      break;
  }
  return Sorting::table;
}

BucketRule rule_of(const Knobs& knobs) {
  switch (sorting_of(knobs.visibility)) {
    case Sorting::split:
      return {1, 0, 0};
    case Sorting::keys: {
      // A bias means the same depth as in a table.
      const auto step = std::max<std::int64_t>(1, std::int64_t{sort_keys} / knobs.buckets);
      return {sort_keys, knobs.bias * step, step};
    }
    case Sorting::table:
      break;
  }
  return {static_cast<std::uint32_t>(knobs.buckets), knobs.bias, 1};
}

}  // namespace

std::optional<gpu::DepthOptions> depth_options(const Knobs& knobs) {
  if (knobs.visibility != Visibility::zbuffer) return std::nullopt;
  gpu::DepthOptions options;
  options.format = knobs.depth;
  options.mapping = knobs.depth_mapping;
  options.test = knobs.depth_test;
  options.reversed = knobs.depth_reversed;
  options.near_z = knobs.near_z;
  options.far_z = knobs.far_z;
  return options;
}

std::optional<canvas::Options> canvas_options(const Knobs& knobs, const World& world, double units_per_world,
                                              const Shown& shown) {
  canvas::Options o;
  o.scale = knobs.resolution;
  if (needs_fractions(knobs, shown)) o.fraction_bits = bits_of(knobs.position);
  o.perspective = needs_perspective(knobs, shown);
  o.filter = needed_filter(knobs, shown);
  o.colour = knobs.colour == Colour::bits24 ? canvas::Colour::bits24 : canvas::Colour::bits15;
  if (shown.polygons) {
    o.fog = fog(knobs, world, units_per_world);
    choose_samples(knobs.antialias, o);
  }
  if (o == canvas::Options{}) return std::nullopt;
  o.width = knobs.width;
  o.height = knobs.height;
  o.depth = depth_options(knobs);
  return o;
}

Plan plan_frame(const Knobs& knobs, const PlanInput& input) {
  Plan plan;
  plan.width = knobs.width;
  plan.height = knobs.height;
  plan.sorting = sorting_of(knobs.visibility);
  plan.rule = rule_of(knobs);
  plan.order_in_bucket = knobs.bucket_order == BucketOrder::fifo ? ot::Order::fifo : ot::Order::lifo;
  plan.key = knobs.key;
  plan.transform = knobs.transform;
  const Shown& shown = plan.shown = input.shown;
  // What has one colour all over looks the same in pieces.
  if (knobs.subdivide.by != SubdivideBy::pieces && (shown.textured || shown.gouraud))
    plan.halving = knobs.subdivide;
  plan.style = style_of(knobs, input);
  // Splitting needs the depths, though the words it orders do not.
  plan.wanted = {plan.style.depth || plan.style.depth_of_shaded || plan.sorting == Sorting::split,
                 plan.style.fractions, input.world.depth_cue.on && knobs.fog == Fog::vertex};
  plan.fraction_mask = needs_fractions(knobs, shown) ? fraction_mask(knobs.position) : std::uint8_t{0};
  plan.split_scale = input.pieces == Pieces::snapped ? 1 : knobs.resolution;
  plan.default_depth_of_bucket =
      knobs.visibility == Visibility::zbuffer && knobs.without_depth == WithoutDepth::bucket;
  plan.refuses_without_depth = knobs.without_depth == WithoutDepth::error;
  plan.canvas = canvas_options(knobs, input.world, input.units_per_world, shown);
  if (!plan.canvas) plan.depth = depth_options(knobs);
  return plan;
}

}  // namespace scene
