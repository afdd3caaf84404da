// The most accurate setting of an axis against a reference in float64 that shares nothing with it: rays cast
// from the eye through every pixel into the world as it was described.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "cost/axes.h"
#include "cost/errors.h"
#include "cost/subject.h"
#include "demos/demos.h"
#include "inspect/report.h"
#include "machine/machine.h"
#include "scenes.h"

using namespace cost_test;

namespace {

constexpr int width = 320, height = 240;

struct Colour {
  double r = 0, g = 0, b = 0;
};

/// The eye of a scene without camera movement: looks along -z from the origin.
struct Eye {
  double h;
  explicit Eye(const scene::Scene& s)
      : h(std::round(120 / static_cast<double>(s.world.camera.tan_half_fov))) {}
  /// x and y of the ray through a point of the screen where it is at z = -1.
  [[nodiscard]] glm::dvec2 ray(double x, double y) const { return {(x - 160) / h, (120 - y) / h}; }
};

base::Picture drawn(const scene::Scene& scene,
                    std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
  auto knobs = cost::accurate_knobs({});
  knobs.antialias = {};
  for (const auto& [knob, value] : values) REQUIRE(scene::set_knob(knobs, knob, value));
  cost::Subject subject(scene, 0);
  REQUIRE(subject.draw(knobs));
  return subject.picture();
}

/// Root mean square distance of the pixels for which there is a reference, of 255.
double distance(const base::Picture& picture, const std::function<std::optional<Colour>(int, int)>& reference,
                double* greatest = nullptr) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto expected = reference(x, y);
      if (!expected) continue;
      const auto p = picture.at(x, y);
      const double r = p.r - expected->r;
      const double g = p.g - expected->g;
      const double b = p.b - expected->b;
      sum += (r * r + g * g + b * b) / 3;
      if (greatest != nullptr) *greatest = std::max({*greatest, std::abs(r), std::abs(g), std::abs(b)});
      ++count;
    }
  }
  REQUIRE(count > 1000);
  return std::sqrt(sum / count);
}

/// The slice that a ray meets first; nothing beside an edge, where a corner's 1/256 pixel decides.
std::optional<Colour> nearest_slice(const scene::Scene& s, const Eye& eye, int x, int y) {
  const auto hit = [&](double px, double py) {
    const auto ray = eye.ray(px, py);
    const scene::Mesh* best = nullptr;
    double nearest = 1e9;
    for (const auto& mesh : s.world.meshes) {
      const double t = -static_cast<double>(mesh.positions[0].z);
      const double wx = ray.x * t;
      const double wy = ray.y * t;
      const bool inside =
          wx > static_cast<double>(mesh.positions[0].x) && wx < static_cast<double>(mesh.positions[2].x) &&
          wy < static_cast<double>(mesh.positions[0].y) && wy > static_cast<double>(mesh.positions[1].y);
      if (inside && t < nearest) {
        nearest = t;
        best = &mesh;
      }
    }
    return best;
  };
  const auto* mesh = hit(x, y);
  constexpr double margin = 1.0 / 64;
  for (const double dx : {-margin, margin}) {
    for (const double dy : {-margin, margin}) {
      if (hit(x + dx, y + dy) != mesh) return std::nullopt;
    }
  }
  if (mesh == nullptr) return Colour{};
  const auto c = mesh->faces[0].colour[0];
  return Colour{static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

/// Half the width of a runway that is drawn in one piece, so that no split rounds its coordinates.
constexpr float narrow = 1.5F;

/// The checkerboard between its texels.
double board_at(double u, double v) {
  const auto texel = [](double iu, double iv) {
    return ((static_cast<int>(iu) / 4 + static_cast<int>(iv) / 4) & 1) != 0 ? 230.0 : 40.0;
  };
  const double iu = std::floor(u);
  const double iv = std::floor(v);
  const double fu = u - iu;
  const double fv = v - iv;
  return (texel(iu, iv) * (1 - fu) + texel(iu + 1, iv) * fu) * (1 - fv) +
         (texel(iu, iv + 1) * (1 - fu) + texel(iu + 1, iv + 1) * fu) * fv;
}

/// What a pixel of the runway shows on average: the checkerboard as described, 32 x 32 rays over the pixel.
/// Nothing where part of the pixel is beside it, or nearer than its near edge.
std::optional<Colour> runway_mean(const Eye& eye, int x, int y) {
  constexpr int rays = 32;
  Colour sum;
  for (int j = 0; j < rays; ++j) {
    for (int i = 0; i < rays; ++i) {
      const auto ray = eye.ray(x + (i + 0.5) / rays - 0.5, y + (j + 0.5) / rays - 0.5);
      if (ray.y >= 0) return std::nullopt;
      const double t = 1.5 / -ray.y;
      constexpr auto half = static_cast<double>(narrow);
      const double u = (ray.x * t + half) / (2 * half);
      const double v = 1 - (t - 3) / 37;
      if (u < 0.02 || u > 0.98 || v < 0.02 || v > 0.98) return std::nullopt;
      // The middle of texel i is at (i + 1/2) / 64; between middles the picture is bilinear.
      const double c = board_at(u * 64 - 0.5, v * 64 - 0.5);
      sum.r += c;
      sum.g += c;
      sum.b += 60;
    }
  }
  constexpr double n = rays * rays;
  return Colour{sum.r / n, sum.g / n, sum.b / n};
}

/// The wall's colour at a pixel: linear in each of the two triangles that a quad is drawn as.
std::optional<Colour> gradient_at(const scene::Scene& s, const Eye& eye, int x, int y) {
  const auto& mesh = s.world.meshes[0];
  const auto ray = eye.ray(x, y);
  const double u = (ray.x * 20 + 20) / 40;  // from the left, the wall being 40 wide and 20 away
  const double v = (14 - ray.y * 20) / 28;  // from the top
  if (u < 0.01 || u > 0.99 || v < 0.01 || v > 0.99) return std::nullopt;
  // Corners in the order of the face: top left, bottom left, bottom right, top right.
  const auto& c = mesh.faces[0].colour;
  const auto mix = [&](auto channel) {
    const double tl = channel(c[0]);
    const double bl = channel(c[1]);
    const double br = channel(c[2]);
    const double tr = channel(c[3]);
    return u + v < 1 ? tl + (tr - tl) * u + (bl - tl) * v : br + (bl - br) * (1 - u) + (tr - br) * (1 - v);
  };
  return Colour{mix([](scene::Rgb8 p) { return double{1} * p.r; }),
                mix([](scene::Rgb8 p) { return double{1} * p.g; }),
                mix([](scene::Rgb8 p) { return double{1} * p.b; })};
}

}  // namespace

TEST_SUITE("cost") {
  TEST_CASE(
      "visibility: a z-buffer of 32 bits, and a BSP, show the slice that a ray in float64 meets first") {
    const auto scene = slices();
    const Eye eye(scene);
    const auto reference = [&](int x, int y) { return nearest_slice(scene, eye, x, y); };
    for (const auto* visibility : {"zbuffer", "bsp"}) {
      double greatest = 0;
      CHECK(distance(drawn(scene, {{"depth", "32"}, {"visibility", visibility}}), reference, &greatest) == 0);
      CHECK(greatest == 0);
    }
    // And the reference tells a wrong order when it sees one.
    CHECK(distance(drawn(scene, {{"visibility", "ot"}, {"buckets", "16"}}), reference) > 1);
  }

  TEST_CASE(
      "visibility: a BSP splits what crosses, and shows with accurate knobs what a z-buffer of 32 bits "
      "shows") {
    for (const auto* name : {"cyclic", "crossing"}) {
      const auto scene = demos::make(*demos::find(name));
      for (const auto* resolution : {"1", "2", "4"}) {
        CAPTURE(name);
        CAPTURE(resolution);
        const auto shown = [&](std::string_view visibility) {
          return drawn(scene, {{"visibility", visibility}, {"depth", "32"}, {"resolution", resolution}});
        };
        CHECK(shown("bsp") == shown("zbuffer"));
        CHECK(shown("ot") != shown("zbuffer"));
      }
    }
  }

  TEST_CASE(
      "filter: linear mip maps are within 5 of 255 of the mean of 1024 rays a pixel, nearest texels are "
      "not") {
    const auto scene = runway(false, narrow, 3);
    const Eye eye(scene);
    const auto reference = [&](int x, int y) { return runway_mean(eye, x, y); };
    const double nearest = distance(drawn(scene, {{"filter", "nearest"}}), reference);
    const double mipmapped = distance(drawn(scene, {{"filter", "mipmap-linear"}}), reference);
    const double sampled =
        distance(drawn(scene, {{"filter", "bilinear"}, {"antialias", "ssaa-8x8"}}), reference);
    MESSAGE("rms of 255: nearest ", nearest, ", mipmap-linear ", mipmapped, ", 64 samples ", sampled);
    CHECK(mipmapped < nearest / 5);
    CHECK(mipmapped < 5);
    CHECK(sampled < 2.5);
  }

  TEST_CASE("colour: 24 bits are within 1 of 255 of a gradient in float64, 15 bits within 8") {
    const auto scene = gradient();
    const Eye eye(scene);
    const auto reference = [&](int x, int y) { return gradient_at(scene, eye, x, y); };
    double greatest = 0;
    distance(drawn(scene, {{"colour", "24"}}), reference, &greatest);
    CHECK(greatest <= 1);
    greatest = 0;
    distance(drawn(scene, {{"colour", "15"}}), reference, &greatest);
    CHECK(greatest > 4);
    CHECK(greatest <= 8);
  }

  TEST_CASE("the share of wrong pixels is judged where the corners are drawn, as inspect judges it") {
    const auto scene = demos::make(*demos::find("corridor"));
    std::vector<std::uint64_t> counts;
    for (const auto position : {"integer", "256"}) {
      scene::Knobs knobs;
      REQUIRE(scene::set_knob(knobs, "position", position));
      cost::Subject subject(scene, 30);
      REQUIRE(subject.draw(knobs));
      cost::ErrorMeter meter(subject, {});
      const auto errors = meter.measure(knobs);
      REQUIRE(errors);

      machine::Machine machine(scene);
      gpu::Trace trace;
      trace.keep_history = true;
      machine.gpu().set_trace(&trace);
      REQUIRE(machine.draw(0.5, knobs));
      machine.gpu().set_trace(nullptr);
      const auto report = inspect::inspect(trace, {});
      CHECK(errors->wrong_pixels == report.wrong_pixels());
      CHECK(errors->pixels_drawn == report.pixels_drawn);
      counts.push_back(errors->wrong_pixels);
    }
    CHECK(counts[0] != counts[1]);  // so that the two can be told apart
  }
}
