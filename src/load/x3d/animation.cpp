#include "load/x3d/animation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>

#include "load/text.h"
#include "scene/angle.h"

namespace load::x3d {
namespace {

using Value = std::array<float, 4>;

struct Kind {
  std::string_view node;
  Track::Kind kind;
  std::size_t width;  // numbers of one value
};
constexpr std::array kinds{Kind{"ScalarInterpolator", Track::Kind::linear, 1},
                           Kind{"PositionInterpolator", Track::Kind::linear, 3},
                           Kind{"ColorInterpolator", Track::Kind::linear, 3},
                           Kind{"OrientationInterpolator", Track::Kind::rotation, 4},
                           Kind{"SplinePositionInterpolator", Track::Kind::spline, 3},
                           Kind{"SplineScalarInterpolator", Track::Kind::spline, 1}};

struct Goal {
  std::string_view node, field;
  Binding::Field to;
  std::size_t width;
};
using F = Binding::Field;
constexpr std::array goals{Goal{"Transform", "translation", F::translation, 3},
                           Goal{"Transform", "rotation", F::rotation, 4},
                           Goal{"Transform", "scale", F::scale, 3},
                           Goal{"Transform", "center", F::centre, 3},
                           Goal{"Transform", "scaleOrientation", F::scale_orientation, 4},
                           Goal{"Viewpoint", "position", F::view_position, 3},
                           Goal{"Viewpoint", "orientation", F::view_orientation, 4},
                           Goal{"Viewpoint", "fieldOfView", F::view_field_of_view, 1},
                           Goal{"DirectionalLight", "direction", F::light_direction, 3},
                           Goal{"DirectionalLight", "color", F::light_colour, 3},
                           Goal{"DirectionalLight", "intensity", F::light_intensity, 1}};

Value combine(float a, const Value& x, float b, const Value& y) {
  Value out{};
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = a * x[i] + b * y[i];
  return out;
}

float length(const Value& v) {
  double sum = 0;
  for (const float x : v) sum += double{x} * double{x};
  return static_cast<float>(std::sqrt(sum));
}

// The key interval that holds `fraction`, and how far into it, 0..1.
struct Step {
  std::size_t index = 0;
  double share = 0;
};
Step step_at(const std::vector<float>& keys, double fraction) {
  if (fraction <= double{keys.front()} || keys.size() == 1) return {0, 0};
  if (fraction >= double{keys.back()}) return {keys.size() - 2, 1};
  const auto next = std::upper_bound(keys.begin(), keys.end(), fraction,
                                     [](double f, float key) { return f < double{key}; });
  const auto index = static_cast<std::size_t>(next - keys.begin()) - 1;
  const double width = double{keys[index + 1]} - double{keys[index]};
  return {index, width > 0 ? (fraction - double{keys[index]}) / width : 0};
}

// Tangents of a Hermite spline: given velocities, or half the way between the neighbours.
// [ISO/IEC 19775-1, 19.2.4]
void make_velocities(Track& track, bool normalize) {
  const std::size_t n = track.keys.size();
  if (n < 2) return;
  const std::vector<Value> given = std::move(track.velocities);
  track.velocities.assign(n, Value{});
  track.is_closed = track.is_closed && n > 2 && track.values.front() == track.values.back() && given.empty();
  if (given.size() == n) {
    track.velocities = given;
  } else {
    for (std::size_t i = 1; i + 1 < n; ++i) {
      track.velocities[i] = combine(0.5F, track.values[i + 1], -0.5F, track.values[i - 1]);
    }
    if (given.size() == 2) {
      track.velocities.front() = given[0];
      track.velocities.back() = given[1];
    } else if (track.is_closed) {
      track.velocities.front() = track.velocities.back() =
          combine(0.5F, track.values[1], -0.5F, track.values[n - 2]);
    }
  }
  if (!normalize || given.empty()) return;
  float total = 0;
  for (std::size_t i = 0; i + 1 < n; ++i)
    total += length(combine(1, track.values[i + 1], -1, track.values[i]));
  for (Value& v : track.velocities) {
    const float size = length(v);
    if (size > 0) v = combine(total / size, v, 0, v);
  }
}

// A tangent counts for two neighbouring intervals; this is the share of one of them, so that the speed in
// time does not jump where their lengths differ.
float stretch(const Track& track, std::size_t key, std::size_t interval) {
  const std::size_t last = track.keys.size() - 1;
  const auto width = [&](std::size_t i) { return track.keys[i + 1] - track.keys[i]; };
  if ((key == 0 || key == last) && !track.is_closed) return 1;
  const float before = width(key == 0 ? last - 1 : key - 1);
  const float after = width(key == last ? 0 : key);
  const float sum = before + after;
  return sum > 0 ? 2 * width(interval) / sum : 1;
}

Value sample_spline(const Track& track, const Step& at) {
  const auto s = static_cast<float>(at.share);
  const float s2 = s * s, s3 = s2 * s;
  const std::size_t i = at.index;
  const Value points = combine(2 * s3 - 3 * s2 + 1, track.values[i], -2 * s3 + 3 * s2, track.values[i + 1]);
  const Value tangents = combine((s3 - 2 * s2 + s) * stretch(track, i, i), track.velocities[i],
                                 (s3 - s2) * stretch(track, i + 1, i), track.velocities[i + 1]);
  return combine(1, points, 1, tangents);
}

glm::vec3 as_vector(const Value& v) { return {v[0], v[1], v[2]}; }

std::optional<double> fraction_of(const Clock& clock, double seconds) {
  const double cycles = (seconds - clock.start) / clock.cycle;
  if (!clock.is_on || !(cycles >= 0)) return std::nullopt;
  if (!clock.loops) return std::min(cycles, 1.0);
  return cycles - std::floor(cycles);
}

std::vector<Value> values_of(const std::vector<float>& numbers, std::size_t width) {
  std::vector<Value> out;
  for (std::size_t i = 0; i + width <= numbers.size(); i += width) {
    Value value{};
    std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(i), width, value.begin());
    out.push_back(value);
  }
  return out;
}

Track read_track(Context& context, const pugi::xml_node& node, const Kind& kind) {
  Track track;
  track.kind = kind.kind;
  track.keys = context.floats(node, "key");
  const std::vector<float> numbers = context.floats(node, "keyValue");
  if (numbers.size() != track.keys.size() * kind.width) {
    context.fail(node, "keyValue has " + std::to_string(numbers.size()) + " numbers, expected " +
                           std::to_string(kind.width) + " for each of " + std::to_string(track.keys.size()) +
                           " keys");
  }
  if (!std::is_sorted(track.keys.begin(), track.keys.end())) context.fail(node, "key is not in rising order");
  track.values = values_of(numbers, kind.width);
  if (kind.kind == Track::Kind::rotation) {
    for (const Value& v : track.values) {
      track.rotations.push_back(Rotation::about(as_vector(v), turns(double{v[3]})));
    }
  } else if (kind.kind == Track::Kind::spline) {
    track.velocities = values_of(context.floats(node, "keyVelocity"), kind.width);
    track.is_closed = context.flag(node, "closed", false);
    const bool normalize = context.flag(node, "normalizeVelocity", false);
    if (!context.error()) make_velocities(track, normalize);
  }
  return track;
}

Clock read_clock(Context& context, const pugi::xml_node& node) {
  Clock clock;
  clock.start = double{context.scalar(node, "startTime", 0)};
  clock.cycle = double{context.scalar(node, "cycleInterval", 1)};
  clock.loops = context.flag(node, "loop", false);
  clock.is_on = context.flag(node, "enabled", true);
  if (!(clock.cycle > 0)) context.fail(node, "cycleInterval is not above 0");
  return clock;
}

std::string_view field_name(const pugi::xml_attribute& attribute, std::string_view prefix,
                            std::string_view suffix) {
  std::string_view name = attribute.value();
  if (name.starts_with(prefix)) name.remove_prefix(prefix.size());
  if (name.ends_with(suffix)) name.remove_suffix(suffix.size());
  return name;
}

// Every element below root, in document order, without recursion.
template <class Visit>
void each_element(const pugi::xml_node& root, Visit&& visit) {
  for (pugi::xml_node node = root.first_child(); node;) {
    if (is_element(node)) visit(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != root && !node.next_sibling()) node = node.parent();
    node = node == root ? pugi::xml_node() : node.next_sibling();
  }
}

}  // namespace

std::array<float, 4> sample(const Track& track, double fraction) {
  if (track.values.empty()) return {};
  if (track.values.size() == 1) return track.values[0];
  const Step at = step_at(track.keys, fraction);
  if (track.kind == Track::Kind::spline) return sample_spline(track, at);
  const auto share = static_cast<float>(at.share);
  return combine(1 - share, track.values[at.index], share, track.values[at.index + 1]);
}

Rotation sample_rotation(const Track& track, double fraction) {
  if (track.rotations.empty()) return {};
  if (track.rotations.size() == 1) return track.rotations[0];
  const Step at = step_at(track.keys, fraction);
  return between(track.rotations[at.index], track.rotations[at.index + 1], at.share);
}

void Animation::set(Fields& fields, double seconds) const {
  for (const Binding& binding : bindings) {
    const Track& track = tracks[binding.track];
    const auto fraction = fraction_of(clocks[track.clock], seconds);
    if (!fraction || track.keys.empty()) continue;
    if (track.kind == Track::Kind::rotation) {
      const Rotation value = sample_rotation(track, *fraction);
      if (binding.field == F::rotation) fields.transforms[binding.index].rotation = value;
      if (binding.field == F::scale_orientation) fields.transforms[binding.index].scale_orientation = value;
      if (binding.field == F::view_orientation) fields.view.orientation = value;
      continue;
    }
    const Value value = sample(track, *fraction);
    switch (binding.field) {
      case F::translation:
        fields.transforms[binding.index].translation = as_vector(value);
        break;
      case F::scale:
        fields.transforms[binding.index].scale = as_vector(value);
        break;
      case F::centre:
        fields.transforms[binding.index].centre = as_vector(value);
        break;
      case F::view_position:
        fields.view.position = as_vector(value);
        break;
      case F::view_field_of_view:
        fields.view.field_of_view = value[0];
        break;
      case F::light_direction:
        fields.lights[binding.index].direction = as_vector(value);
        break;
      case F::light_colour:
        fields.lights[binding.index].colour = as_vector(value);
        break;
      case F::light_intensity:
        fields.lights[binding.index].intensity = value[0];
        break;
      case F::rotation:
      case F::scale_orientation:
      case F::view_orientation:
        break;  // rotation tracks only, above
    }
  }
}

Animation read_animation(Context& context, const pugi::xml_node& root, const Targets& targets) {
  Animation animation;
  std::map<pugi::xml_node, std::uint32_t> clocks, tracks;
  std::vector<std::size_t> widths;
  std::vector<pugi::xml_node> routes;
  each_element(root, [&](const pugi::xml_node& node) {
    const std::string_view name = node.name();
    if (name == "ROUTE") routes.push_back(node);
    if (context.attribute(node, "USE")) return;
    if (name == "TimeSensor") {
      clocks[node] = static_cast<std::uint32_t>(animation.clocks.size());
      animation.clocks.push_back(read_clock(context, node));
    }
    const auto* kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.node == name; });
    if (kind != kinds.end()) {
      tracks[node] = static_cast<std::uint32_t>(animation.tracks.size());
      animation.tracks.push_back(read_track(context, node, *kind));
      widths.push_back(kind->width);
    }
  });

  const auto left_out = [&](const pugi::xml_node& route) {
    context.warn(route, "ROUTE from " + in_quotes(context.attribute(route, "fromNode").value()) + " to " +
                            in_quotes(context.attribute(route, "toNode").value()) + " " +
                            in_quotes(context.attribute(route, "toField").value()) +
                            " is not supported and left out");
  };
  // A clock drives a track; a track sets a field.
  for (const pugi::xml_node& route : routes) {
    const auto clock = clocks.find(context.named(context.attribute(route, "fromNode").value()));
    if (clock == clocks.end()) continue;
    const auto track = tracks.find(context.named(context.attribute(route, "toNode").value()));
    const bool is_fraction =
        field_name(context.attribute(route, "fromField"), "", "_changed") == "fraction" &&
        field_name(context.attribute(route, "toField"), "set_", "") == "fraction";
    if (track == tracks.end() || !is_fraction) {
      left_out(route);
    } else {
      animation.tracks[track->second].clock = clock->second;
    }
  }
  for (const pugi::xml_node& route : routes) {
    const pugi::xml_node from = context.named(context.attribute(route, "fromNode").value());
    const pugi::xml_node to = context.named(context.attribute(route, "toNode").value());
    if (!from || !to) {
      const char* missing = from ? "toNode" : "fromNode";
      context.warn(route, std::string("ROUTE: ") + missing + " " +
                              in_quotes(context.attribute(route, missing).value()) +
                              " names no DEF; left out");
      continue;
    }
    if (clocks.contains(from)) continue;
    const auto track = tracks.find(from);
    const std::string_view field = field_name(context.attribute(route, "toField"), "set_", "_changed");
    const auto* goal = std::find_if(goals.begin(), goals.end(),
                                    [&](const Goal& g) { return g.node == to.name() && g.field == field; });
    const auto transform = targets.transforms.find(to);
    const auto light = targets.lights.find(to);
    const bool is_there =
        transform != targets.transforms.end() || light != targets.lights.end() || to == targets.view;
    if (track == tracks.end() || goal == goals.end() || !is_there || widths[track->second] != goal->width) {
      left_out(route);
      continue;
    }
    if (animation.tracks[track->second].clock == none) continue;  // nothing drives it
    const std::uint32_t index = transform != targets.transforms.end() ? transform->second
                                : light != targets.lights.end()       ? light->second
                                                                      : 0;
    animation.bindings.push_back({goal->to, index, track->second});
  }
  return animation;
}

Rotation read_rotation(Context& context, const pugi::xml_node& node, const char* field) {
  const std::vector<float> v = context.floats(node, field);
  if (v.empty()) return {};
  if (v.size() != 4) {
    context.fail(node, std::string(field) + " has " + std::to_string(v.size()) + " numbers, expected 4");
    return {};
  }
  return Rotation::about({v[0], v[1], v[2]}, turns(double{v[3]}));
}

}  // namespace load::x3d
