#include "scene/clip.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "scene/project.h"

namespace scene {
namespace {

constexpr double farthest = 65535, widest = 32767;

bool comes_first(glm::dvec3 a, glm::dvec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

}  // namespace

Clipper::Clipper(const Projection& p, bool whole) : near_z_(p.near_z), whole_(whole) {
  const double h = p.h;
  // Inside: h * x <= half * z, that is, screen x at most half away from the centre.
  const auto right_of = [&](double half) { return Plane{{-h, 0, half}, 0}; };
  const auto left_of = [&](double half) { return Plane{{h, 0, half}, 0}; };
  const auto below = [&](double half) { return Plane{{0, -h, half}, 0}; };
  const auto above = [&](double half) { return Plane{{0, h, half}, 0}; };
  planes_ = {Plane{{0, 0, 1}, -near_z_},      Plane{{0, 0, -1}, farthest},   left_of(guard_band.half_width),
             right_of(guard_band.half_width), above(guard_band.half_height), below(guard_band.half_height),
             Plane{{1, 0, 0}, widest},        Plane{{-1, 0, 0}, widest},     Plane{{0, 1, 0}, widest},
             Plane{{0, -1, 0}, widest}};
  const int half_width = p.width / 2 + picture_margin, half_height = p.height / 2 + picture_margin;
  picture_ = {left_of(half_width), right_of(half_width), above(half_height), below(half_height)};
}

ClipVertex Clipper::cut(const Plane& plane, const ClipVertex& a, const ClipVertex& b, double at_a,
                        double at_b) const {
  if (comes_first(b.position, a.position)) return cut(plane, b, a, at_b, at_a);
  return point_on(a, b, at_a / (at_a - at_b), &plane == &planes_[0]);
}

ClipVertex Clipper::middle(const ClipVertex& a, const ClipVertex& b) const {
  return comes_first(b.position, a.position) ? point_on(b, a, 0.5, false) : point_on(a, b, 0.5, false);
}

ClipVertex Clipper::point_on(const ClipVertex& a, const ClipVertex& b, double t, bool near_plane) const {
  ClipVertex out;
  glm::dvec3 p = a.position + (b.position - a.position) * t;
  if (near_plane) p.z = near_z_;
  p.z = std::clamp(p.z, near_z_, farthest);
  if (whole_) {
    // The point moves along its line of sight to the next whole z, so that only the
    // rounding of x and y shows.
    const double z = std::floor(p.z + 0.5);
    p = {std::floor(p.x * z / p.z + 0.5), std::floor(p.y * z / p.z + 0.5), z};
  }
  p.x = std::clamp(p.x, -widest, widest);
  p.y = std::clamp(p.y, -widest, widest);
  out.position = p;
  const auto between = [f = static_cast<float>(t)](float from, float to) { return from + (to - from) * f; };
  for (std::size_t i = 0; i < 3; ++i) out.colour[i] = between(a.colour[i], b.colour[i]);
  for (std::size_t i = 0; i < 2; ++i) {
    out.uv[i] = between(a.uv[i], b.uv[i]);
    out.exact_uv[i] = between(a.exact_uv[i], b.exact_uv[i]);
  }
  return out;
}

void Clipper::clip(ClipPolygon& in, ClipPolygon& out) const {
  ClipPolygon* from = &in;
  ClipPolygon* to = &out;
  for (const auto& plane : planes_) {
    const auto distance = [&](const ClipVertex& v) {
      const double d = plane.distance(v.position);
      return v.is_projectable ? std::max(d, 0.0) : d;
    };
    if (std::none_of(from->vertex.begin(), from->vertex.begin() + static_cast<std::ptrdiff_t>(from->count),
                     [&](const ClipVertex& v) { return distance(v) < 0; }))
      continue;
    to->count = 0;
    const bool is_line = from->count == 2;
    for (std::size_t i = 0; i < from->count; ++i) {
      const ClipVertex& a = from->vertex[i];
      const ClipVertex& b = from->vertex[(i + 1) % from->count];
      const double at_a = distance(a);
      const double at_b = distance(b);
      if (at_a >= 0) to->add(a);
      if ((at_a < 0) != (at_b < 0) && !(is_line && i == 1)) to->add(cut(plane, a, b, at_a, at_b));
    }
    std::swap(from, to);
    if (from->count < 2) {
      out.count = 0;
      return;
    }
  }
  if (from != &out) out = *from;
}

Beyond Clipper::wholly_beyond(std::span<const ClipVertex> polygon) const {
  const auto all_outside = [&](const Plane& plane) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const ClipVertex& v) { return plane.distance(v.position) < 0; });
  };
  if (all_outside(planes_[0])) return Beyond::near_plane;
  if (all_outside(planes_[1])) return Beyond::far_plane;
  for (const auto& plane : picture_)
    if (all_outside(plane)) return Beyond::picture;
  return Beyond::nothing;
}

}  // namespace scene
