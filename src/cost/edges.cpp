// Edges against exact area coverage, on triangles of our own: a scene has no edge whose coverage is known.

#include <array>
#include <cmath>
#include <vector>

#include "cost/errors.h"
#include "cost/metrics.h"
#include "ot/packet.h"
#include "scene/plan.h"

namespace cost {
namespace {

constexpr int side = 96;

struct Real {
  double x, y;
};
using Triangle = std::array<Real, 3>;
using Outline = std::vector<Real>;

/// Fans of thin and thick triangles, their corners on a 1/256 grid off the whole pixels.
std::vector<Triangle> triangles() {
  std::vector<Triangle> list;
  std::uint32_t state = 12345;
  const auto next = [&state] {
    state = state * 1664525U + 1013904223U;
    return 4 + static_cast<double>(state >> 16) / 65536.0 * (side - 8);
  };
  for (int i = 0; i < 24; ++i) {
    Triangle t;
    for (auto& corner : t) {
      const auto grid = [](double v) { return std::floor(v * 256) / 256; };
      corner.x = grid(next());
      corner.y = grid(next());
    }
    list.push_back(t);
  }
  return list;
}

/// The part of a convex outline where a * x + b * y + c >= 0. [Sutherland, Hodgman 1974]
Outline cut(const Outline& outline, double a, double b, double c) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Real p = outline[i];
    const Real q = outline[(i + 1) % outline.size()];
    const double dp = a * p.x + b * p.y + c;
    const double dq = a * q.x + b * q.y + c;
    if (dp >= 0) kept.push_back(p);
    if ((dp > 0 && dq < 0) || (dp < 0 && dq > 0)) {
      const double t = dp / (dp - dq);
      kept.push_back({p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t});
    }
  }
  return kept;
}

double area(const Outline& o) {
  double sum = 0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const Real p = o[i];
    const Real q = o[(i + 1) % o.size()];
    sum += p.x * q.y - q.x * p.y;
  }
  return std::abs(sum) / 2;
}

double coverage(const Triangle& t, int x, int y) {
  Outline o(t.begin(), t.end());
  o = cut(o, 1, 0, 0.5 - x);
  o = cut(o, -1, 0, 0.5 + x);
  o = cut(o, 0, 1, 0.5 - y);
  o = cut(o, 0, -1, 0.5 + y);
  return area(o);
}

std::vector<std::uint32_t> words(const Triangle& t) {
  ot::Polygon polygon;
  ot::DepthAnnotation depth;
  depth.has_fractions = true;
  depth.count = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    polygon.xy[i] = {static_cast<std::int16_t>(std::floor(t[i].x)),
                     static_cast<std::int16_t>(std::floor(t[i].y))};
    depth.fx[i] = static_cast<std::uint8_t>((t[i].x - std::floor(t[i].x)) * 256);
    depth.fy[i] = static_cast<std::uint8_t>((t[i].y - std::floor(t[i].y)) * 256);
    depth.z[i] = 4096;
    polygon.rgb[i] = {255, 255, 255};
  }
  std::vector<std::uint32_t> list(32);
  auto n = ot::encode(depth, list);
  n += ot::encode(polygon, std::span(list).subspan(n));
  list.resize(n);
  return list;
}

}  // namespace

double edge_error(const scene::Knobs& given) {
  scene::Knobs knobs = given;
  knobs.visibility = scene::Visibility::ot;
  knobs.colour = scene::Colour::bits24;
  auto options = scene::canvas_options(knobs, {}, 1).value_or(gpu::canvas::Options{});
  options.width = side;
  options.height = side;
  double sum = 0;
  int pixels = 0;
  for (const auto& t : triangles()) {
    gpu::Gpu gpu;
    gpu.set_canvas(options);
    machine::Presenter presenter;
    base::Picture shown;
    std::array<std::uint32_t, 6> area_and_clear{};
    auto n = ot::encode(ot::DrawArea{.right = side - 1, .bottom = side - 1}, area_and_clear);
    n += ot::encode(ot::DrawOffset{}, std::span(area_and_clear).subspan(n));
    ot::encode(ot::Fill{.width = side, .height = side}, std::span(area_and_clear).subspan(n));
    for (int i = 0; i <= machine::Presenter::frames_before(knobs); ++i) {
      gpu.begin_frame();
      gpu.gp0(area_and_clear);
      gpu.gp0(words(t));
      gpu.end_frame();
      shown = shrunk(presenter.show(gpu, knobs), knobs.resolution);
    }
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double exact = coverage(t, x, y);
        if (exact < 1e-9 || exact > 1 - 1e-9) continue;
        const double error = shown.at(x, y).r / 255.0 - exact;
        sum += error * error;
        ++pixels;
      }
    }
  }
  return std::sqrt(sum / pixels);
}

}  // namespace cost
