#include "inspect/fragments.h"

#include <algorithm>
#include <cmath>

namespace inspect {
namespace {

using gpu::Primitive;
using gpu::Vertex;
using gpu::Vram;

bool has_truth(const Primitive& p) { return p.kind == gpu::Kind::polygon && p.has_depth; }

exact::Corner corner(const Vertex& v, bool with_fractions) {
  return {v.x * 256 + (with_fractions ? v.fx : 0), v.y * 256 + (with_fractions ? v.fy : 0), v.z};
}

exact::InversePlane plane(const Primitive& p, std::size_t half, bool with_fractions) {
  return exact::InversePlane({corner(p.vertices[half], with_fractions),
                              corner(p.vertices[half + 1], with_fractions),
                              corner(p.vertices[half + 2], with_fractions)});
}

}  // namespace

Hides hides(const gpu::Event& event, const gpu::Primitive& draw) {
  if (event.rejected || event.blended || has_truth(draw)) return Hides::nothing;
  return draw.kind <= gpu::Kind::line ? Hides::covers : Hides::erases;
}

Hides hides(const gpu::Event& event, const gpu::Primitive& draw, Order order) {
  const Hides what = hides(event, draw);
  return what == Hides::covers && order != Order::depth ? Hides::erases : what;
}

bool is_folded(std::span<const Fragment> at_pixel, std::uint32_t draw) {
  const auto has = [&](std::uint8_t half) {
    return std::ranges::any_of(at_pixel, [&](const Fragment& f) { return f.draw == draw && f.half == half; });
  };
  return has(0) && has(1);
}

Surfaces::Surfaces(const gpu::Trace& trace) {
  first_.reserve(trace.draws.size());
  for (const Primitive& p : trace.draws) {
    first_.push_back(static_cast<std::uint32_t>(surfaces_.size()));
    if (!has_truth(p)) continue;
    for (std::size_t half = 0; half < (p.is_quad() ? 2 : 1); ++half) {
      Surface surface{plane(p, half, p.has_fractions), 0, 0};
      // Fractions can make a needle of a triangle that has pixels; then the whole pixels count. [ours]
      if (surface.plane.is_degenerate()) surface.plane = plane(p, half, false);
      const auto& v = p.vertices;
      surface.left = std::min({v[half].x, v[half + 1].x, v[half + 2].x});
      surface.top = std::min({v[half].y, v[half + 1].y, v[half + 2].y});
      surfaces_.push_back(surface);
    }
  }
}

// A triangle is at most 1023 columns wide and 511 rows high, so exactly one sample
// of its box lands on the pixel.
Surfaces::Sample Surfaces::sample(const Surface& surface, std::uint32_t pixel) {
  const int x = static_cast<int>(pixel % Vram::width), y = static_cast<int>(pixel / Vram::width);
  return {surface.left + ((x - surface.left) & (Vram::width - 1)),
          surface.top + ((y - surface.top) & (Vram::height - 1))};
}

std::strong_ordering Surfaces::compare(const Fragment& a, const Fragment& b, std::uint32_t pixel) {
  const Surface &surface_a = of(a), &surface_b = of(b);
  const Sample at_a = sample(surface_a, pixel), at_b = sample(surface_b, pixel);
  if (at_a.x == at_b.x && at_a.y == at_b.y) {
    return exact::compare_nearness(surface_a.plane, surface_b.plane, at_a.x, at_a.y, decisions);
  }
  return exact::compare_nearness(surface_a.plane, at_a.x, at_a.y, surface_b.plane, at_b.x, at_b.y, decisions);
}

double Surfaces::depth(const Fragment& fragment, std::uint32_t pixel) const {
  const Surface& surface = of(fragment);
  const Sample at = sample(surface, pixel);
  return 1 / surface.plane.estimate(at.x, at.y).value;
}

Fragments::Fragments(const gpu::Trace& trace, Order order) : first_(Vram::size + 1) {
  std::vector<bool> counts(trace.draws.size());
  std::transform(trace.draws.begin(), trace.draws.end(), counts.begin(), has_truth);
  std::vector<std::uint32_t> erased(Vram::size), covered(Vram::size);  // events before these are
  for (std::uint32_t i = 0; i < trace.history.size(); ++i) {
    const gpu::Event& event = trace.history[i];
    if (counts[event.draw]) {
      ++first_[event.pixel + 1];
      continue;
    }
    switch (hides(event, trace.draws[event.draw], order)) {
      case Hides::erases:
        erased[event.pixel] = i;
        first_[event.pixel + 1] = 0;
        break;
      case Hides::covers:
        covered[event.pixel] = i;
        break;
      case Hides::nothing:
        break;
    }
  }
  for (std::size_t pixel = 0; pixel < Vram::size; ++pixel) first_[pixel + 1] += first_[pixel];
  fragments_.resize(first_.back());
  auto next = first_;
  for (std::uint32_t i = 0; i < trace.history.size(); ++i) {
    const gpu::Event& event = trace.history[i];
    if (!counts[event.draw] || i < erased[event.pixel]) continue;
    fragments_[next[event.pixel]++] = {event.draw,    event.depth,    event.fragment,          event.half,
                                       event.blended, event.rejected, i < covered[event.pixel]};
  }
}

}  // namespace inspect
