// Nothing called for, nothing paid.

#include "cost/effects.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cost/axes.h"
#include "cost/packet_edit.h"
#include "cost/touched.h"
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

  TEST_CASE(
      "prices along a chain and what is left add up to the whole, whatever the effects do to each other") {
    // Two effects that share a canvas: each alone away saves little, both away save all.
    cost::Chain chain([] { return 100.0; });
    chain.add({.name = "first"}, [] { return 90.0; });
    chain.add({.name = "second"}, [] { return 20.0; });
    for (int round = 0; round < 4; ++round) chain.run(round, [] { return true; });
    std::vector<cost::Effect> effects;
    chain.report(effects);
    REQUIRE(effects.size() == 2);
    CHECK(effects[0].ms == 10);
    CHECK(effects[1].ms == 70);
    CHECK(chain.whole() == 100);
    CHECK(chain.remainder() == 20);
    CHECK(effects[0].ms + effects[1].ms + chain.remainder() == chain.whole());
    CHECK_FALSE(effects[0].is_within_noise());
  }

  TEST_CASE("prices of a scene's effects and what is left add up to the frame, counted in bytes") {
    cost::Subject subject(runway(true), 0);
    const auto bytes = [&](const scene::Knobs& knobs) -> base::Result<double> {
      const auto drawn = subject.draw(knobs);
      REQUIRE(drawn);
      const auto touched = cost::touched(subject, knobs, *drawn);
      REQUIRE(touched);
      return static_cast<double>(touched->total());
    };
    std::vector<scene::Knobs> less{{}};
    for (const auto& knob :
         {std::pair{"visibility", "zbuffer"}, {"texture", "perspective"}, {"colour", "24"}}) {
      auto more = less.front();
      REQUIRE(scene::set_knob(more, knob.first, knob.second));
      less.insert(less.begin(), more);
    }
    cost::Chain chain([&] { return bytes(less[0]); });
    for (std::size_t k = 1; k < less.size(); ++k) {
      chain.add({.name = std::to_string(k)}, [&, k] { return bytes(less[k]); });
    }
    for (int round = 0; round < 3; ++round) chain.run(round, [] { return true; });
    std::vector<cost::Effect> effects;
    chain.report(effects);
    double sum = chain.remainder();
    for (const auto& effect : effects) {
      CHECK(effect.spread == 0);
      CHECK(effect.ms >= 0);
      sum += effect.ms;
    }
    CHECK(sum == chain.whole());
    CHECK(chain.remainder() == *bytes({}));
  }

  TEST_CASE("a price that is no larger than its spread is within noise, and none is printed below 0") {
    cost::EffectReport report;
    report.effects = {{.name = "slow", .ms = 2, .spread = 0.5}, {.name = "noise", .ms = -0.1, .spread = 0.3}};
    const auto text = cost::to_text(report);
    CHECK(text.find("-0.1") == std::string::npos);
    CHECK(text.find("within noise") != std::string::npos);
    const auto json = nlohmann::json::parse(cost::to_json(report));
    CHECK(json["effects"][0]["within_noise"] == false);
    CHECK(json["effects"][1]["within_noise"] == true);
    CHECK(json["effects"][1]["ms"] == 0);
  }

  TEST_CASE("knobs about what is not there are listed as not needed, and no price is told of them") {
    auto knobs = plain();
    for (const auto& knob : {std::pair{"texture", "perspective"},
                             {"filter", "mipmap-linear"},
                             {"fog", "pixel"},
                             {"depth", "32"},
                             {"aa-filter", "tent"},
                             {"aa-space", "linear"}}) {
      REQUIRE(scene::set_knob(knobs, knob.first, knob.second));
    }
    const auto report = cost::find_effects(shards(true), 0, knobs, 1);
    REQUIRE(report);
    CHECK(report->not_needed == std::vector<std::string>{"depth 32", "texture perspective",
                                                         "filter mipmap-linear", "aa-filter tent",
                                                         "aa-space linear", "fog pixel"});
    for (const auto& effect : report->effects) CHECK(effect.name == "colour 15");
    CHECK(cost::to_text(*report).find("asked for, not needed\n  depth 32\n") != std::string::npos);
    CHECK(report->buffers.size() == 1);

    const auto foggy = cost::find_effects(runway(true), 0, knobs, 1);
    REQUIRE(foggy);
    CHECK(foggy->not_needed == std::vector<std::string>{"depth 32", "aa-filter tent", "aa-space linear"});
    CHECK(find(*foggy, "fog pixel") != nullptr);
    CHECK(find(*foggy, "depth cue (fog)") != nullptr);
  }
}
