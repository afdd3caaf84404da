// Nothing called for, nothing paid.

#include "cost/effects.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cost/axes.h"
#include "cost/packet_edit.h"
#include "demos/demos.h"
#include "scenes.h"

using namespace cost_test;

namespace {

const cost::Effect* find(const cost::EffectReport& report, std::string_view name) {
  const auto found = std::ranges::find(report.effects, name, &cost::Effect::name);
  return found != report.effects.end() ? &*found : nullptr;
}

scene::Knobs plain() {
  scene::Knobs knobs;
  knobs.colour = scene::Colour::bits15;
  return knobs;
}

}  // namespace

TEST_SUITE("cost") {
  TEST_CASE("a flat untextured frame in list order has no effect, one kernel, and no buffer but its list") {
    const auto report = cost::find_effects(shards(true), 0, plain(), 1);
    REQUIRE(report);
    CHECK(std::ranges::none_of(report->effects,
                               [](const auto& e) { return e.primitives != 0 && e.name != "colour 15"; }));
    REQUIRE(report->kernels.size() == 1);
    CHECK(report->kernels[0].starts_with("flat colour:"));
    REQUIRE(report->buffers.size() == 1);
    CHECK(report->buffers[0].name == "list in main RAM");

    cost::Subject subject(shards(true), 0);
    REQUIRE(subject.draw(plain()));
    CHECK(subject.gpu().canvas() == nullptr);
    CHECK(subject.gpu().depth_plane() == nullptr);
    const auto words = subject.words(plain());
    REQUIRE(words);
    CHECK(std::ranges::none_of(*words, [](std::uint32_t w) { return w >> 24 >= 0xe7 && w >> 24 <= 0xef; }));
  }

  TEST_CASE("each knob that asks for a buffer gets that buffer, and no other") {
    const auto buffers = [](std::string_view knob, std::string_view value) {
      auto knobs = plain();
      REQUIRE(scene::set_knob(knobs, knob, value));
      const auto report = cost::find_effects(shards(true), 0, knobs, 1);
      REQUIRE(report);
      std::vector<std::string> names;
      for (const auto& b : report->buffers) names.push_back(b.name);
      return names;
    };
    using Names = std::vector<std::string>;
    CHECK(buffers("visibility", "zbuffer") == Names{"list in main RAM", "depth plane"});
    CHECK(buffers("position", "256") == Names{"list in main RAM", "canvas colour"});
    CHECK(buffers("antialias", "msaa-4") == Names{"list in main RAM", "canvas colour", "canvas samples"});
    CHECK(buffers("antialias", "fxaa") == Names{"list in main RAM"});
  }

  TEST_CASE(
      "semi-transparent polygons before a z-buffer ask for a queue, on the console's target and on a "
      "canvas") {
    for (const auto* colour : {"15", "24"}) {
      scene::Knobs knobs;
      REQUIRE(scene::set_knob(knobs, "visibility", "zbuffer"));
      REQUIRE(scene::set_knob(knobs, "colour", colour));
      const auto report = cost::find_effects(demos::make(*demos::find("glass")), 0, knobs, 1);
      REQUIRE(report);
      CHECK(std::ranges::any_of(report->buffers, [](const auto& b) {
        return b.name.find("queue") != std::string::npos && b.bytes > 0;
      }));
    }
  }

  TEST_CASE("Gouraud, textures, dither and blending are found with their primitives and pixels") {
    const auto shaded = cost::find_effects(shards(false), 0, {}, 1);
    REQUIRE(shaded);
    const auto* gouraud = find(*shaded, "Gouraud shading");
    REQUIRE(gouraud != nullptr);
    CHECK(gouraud->primitives > 20);
    CHECK(gouraud->pixels > 1000);
    CHECK(find(*shaded, "dither") != nullptr);
    CHECK(find(*shaded, "texture, 4-bit") == nullptr);

    const auto textured = cost::find_effects(runway(true), 0, {}, 1);
    REQUIRE(textured);
    CHECK(find(*textured, "texture, 4-bit") != nullptr);
    CHECK(find(*textured, "depth cue (fog)") != nullptr);
    CHECK(find(*textured, "lighting") == nullptr);
  }

  TEST_CASE("words without an effect ask for it no more, and for everything else as before") {
    for (const auto& demo : demos::all()) {
      cost::Subject subject(demos::make(demo), 20);
      const auto words = subject.words({});
      REQUIRE(words);
      for (std::size_t i = 0; i < cost::packet_effects().size(); ++i) {
        const auto edited = cost::without(*words, i);
        gpu::Gpu gpu;
        gpu::Trace before;
        gpu::Trace after;
        gpu.set_trace(&before);
        gpu.gp0(*words);
        gpu.set_trace(&after);
        gpu.gp0(edited);
        REQUIRE(before.draws.size() == after.draws.size());
        const auto& effect = cost::packet_effects()[i];
        CAPTURE(demo.name);
        CAPTURE(effect.name);
        CHECK(std::ranges::none_of(after.draws, effect.asks));
        if (std::ranges::none_of(before.draws, effect.asks)) CHECK(edited.size() == words->size());
      }
    }
  }

  TEST_CASE("the report as JSON has the keys that were promised") {
    const auto report = cost::find_effects(shards(false), 3, {}, 1);
    REQUIRE(report);
    const auto json = nlohmann::json::parse(cost::to_json(*report));
    CHECK(json["schema"] == "otter.effects/1");
    CHECK(json["scene"] == "shards");
    CHECK(json["frame"] == 3);
    CHECK(json["width"] == 320);
    CHECK(json["height"] == 240);
    REQUIRE(!json["effects"].empty());
    for (const auto* key : {"name", "primitives", "pixels", "ms"}) CHECK(json["effects"][0].contains(key));
    CHECK(json["kernels"].is_array());
    CHECK(json["buffers"][0].contains("bytes"));
  }
}
