#include "cost/errors.h"

#include <algorithm>
#include <cmath>

#include "cost/metrics.h"
#include "inspect/report.h"

namespace cost {
namespace {

/// The knobs of these names, as a key.
std::string key_of(const scene::Knobs& knobs, std::initializer_list<std::string_view> names) {
  std::string key;
  for (const auto& knob : scene::knob_table()) {
    if (std::ranges::find(names, knob.name) != names.end()) key += knob.get(knobs) + " ";
  }
  return key;
}

Distance summary(std::vector<double>& distances) {
  if (distances.empty()) return {};
  double sum = 0;
  for (const double d : distances) sum += d;
  return {sum / static_cast<double>(distances.size()), percentile(distances, 0.95),
          std::ranges::max(distances)};
}

int fraction_mask(scene::Position position) {
  constexpr std::array masks{0, 0xc0, 0xf0, 0xff};
  return masks[static_cast<std::size_t>(position)];
}

/// Polygons of one face, as it comes in the list of a frame.
struct Group {
  std::uint32_t instance, face;
  std::size_t first, count;
};
std::vector<Group> groups(const std::vector<scene::ScreenPolygon>& list) {
  std::vector<Group> result;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (result.empty() || result.back().instance != list[i].instance || result.back().face != list[i].face) {
      result.push_back({list[i].instance, list[i].face, i, 0});
    }
    ++result.back().count;
  }
  return result;
}

/// u and v of one pixel of a trace, texels.
std::array<double, 2> texcoord(std::uint32_t word) {
  return {(static_cast<double>(word & 0xffff) - 128) / 256, (static_cast<double>(word >> 16) - 128) / 256};
}

/// a - b where coordinates repeat after `period` texels.
double wrapped(double difference, double period) {
  return difference - period * std::round(difference / period);
}

/// Texels after which a texture window repeats; 256 without one.
double period(std::uint32_t window_mask) { return 256.0 - 8.0 * (window_mask & 31); }

/// True if two draws show the same picture: then their coordinates can be compared.
bool same_texture(const gpu::Primitive& a, const gpu::Primitive& b) {
  return a.is_textured() && b.is_textured() && a.clut == b.clut && a.state.page_x() == b.state.page_x() &&
         a.state.page_y() == b.state.page_y() && a.state.texture_window == b.state.texture_window;
}

}  // namespace

double Errors::of(Measure measure) const {
  switch (measure) {
    case Measure::wrong_surface:
      return 100 * wrong_share();
    case Measure::geometric:
      return geometric_px.mean;
    case Measure::texel:
      return texel.mean;
    case Measure::colour:
      return colour_rms;
    case Measure::block_colour:
      return block_rms;
    case Measure::edge:
      break;
  }
  return edge_rms;
}

ErrorMeter::ErrorMeter(Subject& subject, const scene::Knobs& given) : subject_(subject), given_(given) {}

base::Result<void> ErrorMeter::prepare() {
  if (reference_.width != 0) return {};
  const auto drawn = subject_.draw(reference_knobs(given_));
  if (!drawn) return tl::make_unexpected(drawn.error());
  reference_ = subject_.picture();
  return {};
}

base::Result<Errors> ErrorMeter::measure(const scene::Knobs& knobs) {
  Errors errors;
  const auto shown = shrunk(subject_.picture(), knobs.resolution);
  if (auto ready = prepare(); !ready) return tl::make_unexpected(ready.error());
  errors.colour_rms = rms(shown, reference_);
  errors.block_rms = block_rms(shown, reference_);
  errors.psnr = psnr(errors.colour_rms);
  errors.ssim = ssim(shown, reference_);
  if (auto judged = judge_surfaces(knobs, errors); !judged) return tl::make_unexpected(judged.error());
  errors.geometric_px = geometric(knobs);
  errors.edge_rms = edge(knobs);
  const auto texels = texel(knobs);
  if (!texels) return tl::make_unexpected(texels.error());
  errors.texel = *texels;
  return errors;
}

/// What decides which surface wins is the same in any colours, and judged at one sample a pixel.
base::Result<void> ErrorMeter::judge_surfaces(const scene::Knobs& knobs, Errors& errors) {
  const auto key = key_of(
      knobs, {"visibility", "buckets", "key", "bias", "bucket-order", "depth", "depth-mapping", "depth-test",
              "depth-reversed", "near", "far", "transform", "subdivide", "position", "texture", "filter"});
  auto found = verdicts_.find(key);
  if (found == verdicts_.end()) {
    gpu::Trace trace;
    trace.keep_history = true;
    if (auto traced = subject_.trace_surfaces(knobs, trace); !traced) return traced;
    const auto order = knobs.visibility == scene::Visibility::zbuffer ? inspect::Order::depth
                       : knobs.visibility == scene::Visibility::bsp   ? inspect::Order::exact
                                                                      : inspect::Order::list;
    const auto report =
        inspect::inspect(trace, {.order = order, .scene = subject_.name(), .frame = subject_.frame()});
    Errors verdict;
    verdict.pixels_drawn = report.pixels_drawn;
    verdict.wrong_pixels = report.wrong_pixels();
    verdict.causes = report.causes;
    found = verdicts_.emplace(key, verdict).first;
  }
  errors.pixels_drawn = found->second.pixels_drawn;
  errors.wrong_pixels = found->second.wrong_pixels;
  errors.causes = found->second.causes;
  return {};
}

/// Faces that are cut or culled differently in the two lists are left out.
Distance ErrorMeter::geometric(const scene::Knobs& knobs) {
  const auto key = key_of(knobs, {"transform", "position", "subdivide"});
  if (const auto found = geometrics_.find(key); found != geometrics_.end()) return found->second;
  scene::Knobs exact = knobs;
  exact.transform = scene::Transform::float64;
  exact.position = scene::Position::fine;
  const auto ours = subject_.polygons(knobs);
  const auto theirs = subject_.polygons(exact);
  const auto place = [](const scene::ScreenPolygon& p, std::size_t v, int mask) {
    return std::array<double, 2>{p.packet.xy[v].x + (p.depth.fx[v] & mask) / 256.0,
                                 p.packet.xy[v].y + (p.depth.fy[v] & mask) / 256.0};
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Group> exact_groups;
  for (const auto& g : groups(theirs)) exact_groups[{g.instance, g.face}] = g;
  std::vector<double> distances;
  for (const auto& g : groups(ours)) {
    const auto other = exact_groups.find({g.instance, g.face});
    if (other == exact_groups.end() || other->second.count != g.count) continue;
    for (std::size_t i = 0; i < g.count; ++i) {
      const auto& a = ours[g.first + i];
      const auto& b = theirs[other->second.first + i];
      if (a.packet.quad != b.packet.quad) continue;
      for (std::size_t v = 0; v < (a.packet.quad ? 4U : 3U); ++v) {
        const auto pa = place(a, v, fraction_mask(knobs.position));
        const auto pb = place(b, v, 0xff);
        distances.push_back(std::hypot(pa[0] - pb[0], pa[1] - pb[1]));
      }
    }
  }
  return geometrics_.emplace(key, summary(distances)).first->second;
}

/// Against the same frame with exact positions and perspective, pixel by pixel, inside surfaces that both
/// show.
base::Result<Distance> ErrorMeter::texel(const scene::Knobs& knobs) {
  const auto key =
      key_of(knobs, {"visibility", "buckets", "key", "transform", "position", "texture", "subdivide"});
  if (const auto found = texels_.find(key); found != texels_.end()) return found->second;
  scene::Knobs exact = knobs;
  exact.texture = scene::TextureAddress::perspective;
  exact.subdivide = {};
  exact.position = scene::Position::fine;
  exact.transform = scene::Transform::float64;
  const auto ours = subject_.trace_canvas(knobs);
  if (!ours) return tl::make_unexpected(ours.error());
  const auto theirs = subject_.trace_canvas(exact);
  if (!theirs) return tl::make_unexpected(theirs.error());
  std::vector<double> distances;
  const auto width = static_cast<std::size_t>(knobs.width);
  const auto height = static_cast<std::size_t>(knobs.height);
  for (std::size_t y = 1; y + 1 < height; ++y) {
    for (std::size_t x = 1; x + 1 < width; ++x) {
      const auto at = y * width + x;
      const auto writer = theirs->writers[at];
      if (writer == 0 || ours->writers[at] == 0) continue;
      // Away from outlines: there another surface, with other coordinates, is a matter of position.
      const bool inside = theirs->writers[at - 1] == writer && theirs->writers[at + 1] == writer &&
                          theirs->writers[at - width] == writer && theirs->writers[at + width] == writer;
      const auto& exact_draw = theirs->draws[writer - 1];
      if (!inside || !same_texture(ours->draws[ours->writers[at] - 1], exact_draw)) continue;
      const auto a = texcoord(ours->texcoords[at]);
      const auto b = texcoord(theirs->texcoords[at]);
      const auto window = exact_draw.state.texture_window;
      distances.push_back(
          std::hypot(wrapped(a[0] - b[0], period(window)), wrapped(a[1] - b[1], period(window >> 5))));
    }
  }
  return texels_.emplace(key, summary(distances)).first->second;
}

double ErrorMeter::edge(const scene::Knobs& knobs) {
  const auto key = key_of(knobs, {"position", "antialias", "aa-filter", "resolution"});
  const auto found = edges_.find(key);
  return found != edges_.end() ? found->second : edges_.emplace(key, edge_error(knobs)).first->second;
}

}  // namespace cost
