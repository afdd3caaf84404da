#include "scene/accurate.h"

#include "gpu/canvas/canvas.h"
#include "gpu/canvas/sample_pattern.h"
#include "gpu/gpu.h"

namespace scene {
namespace {

namespace canvas = gpu::canvas;

int fraction_bits(Position position) {
  switch (position) {
    case Position::integer:
      return 0;
    case Position::quarter:
      return 2;
    case Position::sixteenth:
      return 4;
    case Position::fine:
      break;
  }
  return 8;
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
      options.layers = canvas::random_samples(antialias.samples);
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

std::optional<canvas::Options> canvas_options(const Knobs& knobs, const World& world,
                                              double units_per_world) {
  canvas::Options o;
  o.scale = knobs.resolution;
  o.fraction_bits = fraction_bits(knobs.position);
  o.perspective = knobs.texture == TextureAddress::perspective;
  o.filter = knobs.filter;
  o.colour = knobs.colour == Colour::bits24 ? canvas::Colour::bits24 : canvas::Colour::bits15;
  o.fog = fog(knobs, world, units_per_world);
  choose_samples(knobs.antialias, o);
  if (o == canvas::Options{}) return std::nullopt;
  o.width = knobs.width;
  o.height = knobs.height;
  o.depth = depth_options(knobs);
  return o;
}

base::Result<void> use_targets(const FrameBuilder& builder, const Knobs& knobs, gpu::Gpu& gpu) {
  auto wanted = canvas_options(knobs, builder.world(), builder.units_per_world());
  if (wanted && gpu.canvas() != nullptr) wanted->trace = gpu.canvas()->options().trace;
  if (wanted && canvas::Canvas::frame_bytes(*wanted) > canvas_limit_bytes) {
    return base::fail("--resolution and --antialias ask for a frame of " +
                      std::to_string(canvas::Canvas::frame_bytes(*wanted)) + " bytes; expected at most " +
                      std::to_string(canvas_limit_bytes));
  }
  if (wanted && knobs.visibility == Visibility::bsp &&
      (wanted->layers.size() > 1 || !wanted->samples.empty() || wanted->temporal || wanted->scale > 4)) {
    return base::fail(
        "--visibility bsp splits polygons for one sample at the centre of each pixel: expected --antialias "
        "none "
        "or fxaa, and --resolution 1, 2 or 4");
  }
  const auto depth = wanted ? std::nullopt : depth_options(knobs);
  const auto* plane = gpu.depth_plane();
  if (depth != (plane != nullptr ? std::optional(plane->options()) : std::nullopt)) gpu.set_depth(depth);
  gpu.set_canvas(wanted);
  return {};
}

}  // namespace scene
