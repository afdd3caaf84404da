// Each axis swept down from the most accurate settings: a more accurate setting does not increase the error
// that the axis is about.

#include "cost/axes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cost/errors.h"
#include "scenes.h"

using namespace cost_test;
using cost::Axis;
using cost::Errors;

namespace {

/// Errors of the named settings of an axis, lowered one by one from the most accurate knobs.
std::vector<Errors> swept_down(const scene::Scene& scene, std::string_view axis_name,
                               const std::vector<std::string_view>& settings) {
  const Axis* axis = cost::find_axis(axis_name);
  REQUIRE(axis != nullptr);
  cost::Subject subject(scene, 0);
  cost::ErrorMeter meter(subject, {});
  std::vector<Errors> errors;
  for (const auto name : settings) {
    const auto setting = std::ranges::find(axis->settings, name, &cost::Setting::name);
    REQUIRE(setting != axis->settings.end());
    scene::Knobs base = cost::accurate_knobs({});
    if (axis->without_samples) base.antialias = {};
    const auto knobs = cost::with(base, *setting);
    REQUIRE(subject.draw(knobs));
    const auto measured = meter.measure(knobs);
    REQUIRE(measured);
    errors.push_back(*measured);
  }
  return errors;
}

void check_falling(const std::vector<Errors>& errors, cost::Measure measure) {
  for (std::size_t i = 1; i < errors.size(); ++i) {
    CAPTURE(i);
    CHECK(errors[i].of(measure) <= errors[i - 1].of(measure));
  }
  CHECK(errors.back().of(measure) < errors.front().of(measure));
}

}  // namespace

TEST_SUITE("cost") {
  TEST_CASE(
      "visibility: finer tables, a sorted list and a z-buffer leave no more wrong pixels than coarser ones") {
    const auto errors = swept_down(slices(), "visibility",
                                   {"ot 16", "ot 64", "ot 256", "ot 1024", "ot 4096", "sorted", "z 24"});
    check_falling(errors, cost::Measure::wrong_surface);
    CHECK(errors.front().causes[static_cast<std::size_t>(inspect::Cause::bucket_tie)] > 0);
    CHECK(errors.back().wrong_pixels == 0);
  }

  TEST_CASE(
      "transform: float32 is no farther from the exact place than the GTE, float64 no farther than float32") {
    const auto errors = swept_down(shards(true), "transform", {"gte", "float", "double"});
    check_falling(errors, cost::Measure::geometric);
    CHECK(errors[0].geometric_px.mean < 1);
  }

  TEST_CASE("position: each finer grid brings vertices nearer to their exact place") {
    const auto errors = swept_down(shards(true), "position", {"integer", "4", "16", "256"});
    check_falling(errors, cost::Measure::geometric);
    // A corner cut off to whole pixels is on average half a pixel off in x and in y: 0.765 pixels.
    CHECK(errors[0].geometric_px.mean == doctest::Approx(0.765).epsilon(0.1));
    CHECK(errors[3].geometric_px.mean == 0);
  }

  TEST_CASE(
      "transform and position: the most accurate place agrees with a projection in float64 of our own to "
      "1/128 pixel") {
    const auto scene = shards(true);
    cost::Subject subject(scene, 0);
    const auto polygons = subject.polygons(cost::accurate_knobs({}));
    REQUIRE(polygons.size() > 20);
    const auto& mesh = scene.world.meshes[0];
    const double h = std::round(120 / static_cast<double>(scene.world.camera.tan_half_fov));
    int compared = 0;
    for (const auto& p : polygons) {
      const auto& face = mesh.faces[p.face];
      // A polygon that was cut has other corners.
      const auto place = [&](std::size_t k) {
        const glm::dvec3 v(mesh.positions[face.vertex[k]]);
        return glm::dvec2(160 + h * v.x / -v.z, 120 - h * v.y / -v.z);
      };
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = place(k);
        inside = inside && at.x > -300 && at.x < 620 && at.y > -120 && at.y < 360;
      }
      if (!inside) continue;
      // The corners may come in another order than the face has them.
      for (std::size_t k = 0; k < 3; ++k) {
        double nearest = 1e9;
        for (std::size_t j = 0; j < 3; ++j) {
          const auto at = place(j);
          nearest = std::min(nearest, std::max(std::abs(p.packet.xy[k].x + p.depth.fx[k] / 256.0 - at.x),
                                               std::abs(p.packet.xy[k].y + p.depth.fy[k] / 256.0 - at.y)));
        }
        CHECK(nearest < 1.0 / 128);
      }
      ++compared;
    }
    CHECK(compared > 10);
  }

  TEST_CASE("texture: subdivision and then perspective bring texture coordinates nearer to the exact ones") {
    const auto errors = swept_down(runway(false), "texture",
                                   {"affine", "affine 2x2", "affine 4x4", "affine 8x8", "perspective"});
    check_falling(errors, cost::Measure::texel);
    MESSAGE("texels, mean: affine ", errors[0].texel.mean, ", 2x2 ", errors[1].texel.mean, ", 4x4 ",
            errors[2].texel.mean, ", 8x8 ", errors[3].texel.mean, ", perspective ", errors[4].texel.mean);
    CHECK(errors.back().texel.mean < 1.0 / 16);
  }

  TEST_CASE("filter: bilinear and mip maps come nearer to the 64-sample reference than nearest texels") {
    check_falling(swept_down(runway(false), "filter", {"nearest", "bilinear", "mipmap-linear"}),
                  cost::Measure::colour);
  }

  TEST_CASE("colour: dither brings the means of 4 x 4 pixels nearer to the reference, 24 bits nearer still") {
    const auto errors = swept_down(gradient(), "colour", {"15", "15-dither", "24"});
    check_falling(errors, cost::Measure::block_colour);
    CHECK(errors.back().block_rms < 0.5);
  }

  TEST_CASE("antialias: more samples bring edges nearer to exact area coverage") {
    for (const auto& family :
         {std::vector<std::string_view>{"none", "ssaa-2x2", "ssaa-4x4", "ssaa-8x8"},
          std::vector<std::string_view>{"none", "msaa-2", "msaa-4", "msaa-8"},
          std::vector<std::string_view>{"none", "rotated-4", "rotated-8", "rotated-16"},
          std::vector<std::string_view>{"none", "fxaa"}, std::vector<std::string_view>{"none", "taa"}}) {
      std::vector<double> errors;
      const Axis* axis = cost::find_axis("antialias");
      for (const auto name : family) {
        const auto setting = std::ranges::find(axis->settings, name, &cost::Setting::name);
        errors.push_back(cost::edge_error(cost::with(cost::accurate_knobs({}), *setting)));
      }
      for (std::size_t i = 1; i < errors.size(); ++i) CHECK(errors[i] < errors[i - 1]);
      if (family.back() == "ssaa-8x8") CHECK(errors.back() < 0.03);
    }
  }

  TEST_CASE("fog: per pixel it comes nearer to the reference than per vertex") {
    check_falling(swept_down(runway(true), "fog", {"vertex", "pixel"}), cost::Measure::colour);
  }

  TEST_CASE("resolution: edges come nearer to exact area coverage with every doubling") {
    const Axis* axis = cost::find_axis("resolution");
    double last = 1;
    for (const auto& setting : axis->settings) {
      auto knobs = cost::with(cost::accurate_knobs({}), setting);
      knobs.antialias = {};
      const double error = cost::edge_error(knobs);
      CAPTURE(setting.name);
      CHECK(error < last);
      last = error;
    }
    CHECK(last < 0.012);  // of 64 samples a pixel
  }

  TEST_CASE("every axis names a setting of the console, and every setting is one the knobs accept") {
    for (const auto& axis : cost::axes()) {
      REQUIRE(axis.console < axis.settings.size());
      CHECK(cost::with(cost::console_knobs({}), axis.settings[axis.console]) == cost::console_knobs({}));
      for (const auto& setting : axis.settings) {
        for (const auto& value : setting.values) {
          scene::Knobs knobs;
          CHECK(scene::set_knob(knobs, value.knob, value.value));
        }
      }
    }
  }
}
