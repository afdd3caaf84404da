// Every knob on scenes that lack what it is about: nothing is allocated, written or planned for it.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "ot/walker.h"
#include "scene/pipeline.h"
#include "scene/plan.h"

namespace {

struct Has {
  bool polygons = true, textured = false, gouraud = false, fog = false;
};

scene::Scene scene_with(const Has& has) {
  scene::Scene s;
  scene::World& w = s.world;
  w.units_per_world = 100;
  scene::Material material;
  material.double_sided = true;
  if (has.textured) {
    w.textures.push_back(
        {"one", 2, 2, std::vector<scene::Rgba8>(4, {200, 100, 50, 255}), scene::TexelFormat::clut4});
    material.texture = 0;
  }
  w.materials = {material};
  scene::Mesh mesh;
  mesh.positions = {{-1, 1, -5}, {-1, -1, -5}, {1, -1, -6}, {1, 1, -6}};
  if (has.polygons) {
    scene::Face face;
    face.vertex = {0, 1, 2, 3};
    face.uv = {glm::vec2{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    face.colour.fill({200, 100, 50});
    if (has.gouraud) face.colour[1] = {10, 20, 30};
    mesh.faces.push_back(face);
  }
  scene::Line line;
  line.vertex = {0, 2};
  mesh.lines.push_back(line);
  w.meshes.push_back(mesh);
  w.instances.push_back({0, glm::mat4(1.0F)});
  if (has.fog) w.depth_cue = {true, {90, 120, 200}, 2, 40};
  return s;
}

struct Paid {
  std::vector<std::uint32_t> words;
  std::uint64_t bytes = 0;  // depth, queue, canvas
  std::array<std::uint64_t, gpu::Mode::count> kernels{};
  scene::Plan plan;
  bool has_canvas = false;
  bool operator==(const Paid& o) const {
    return words == o.words && bytes == o.bytes && kernels == o.kernels && plan == o.plan;
  }
};

Paid paid(const Has& has, const scene::Knobs& knobs) {
  scene::FrameBuilder builder(scene_with(has), knobs);
  ot::MainRam ram(ot::RamSize::mib8);
  gpu::Gpu gpu;
  builder.upload(gpu);
  REQUIRE(scene::render_frame(builder, 0, knobs, ram, gpu));
  Paid out;
  out.bytes = gpu.depth_bytes() + gpu.queue_bytes();
  out.has_canvas = gpu.canvas() != nullptr;
  if (out.has_canvas) {
    for (const auto& buffer : gpu.canvas()->buffers()) out.bytes += buffer.bytes;
  }
  out.kernels = gpu.counters().kernels;
  out.plan = builder.plan();
  const auto frame = builder.build(0, knobs, ram);
  REQUIRE(frame);
  REQUIRE(ot::walk(ram, frame->head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    out.words.insert(out.words.end(), payload.begin(), payload.end());
  }));
  return out;
}

scene::Knobs with(const char* knob, const char* value) {
  scene::Knobs knobs;
  REQUIRE(scene::set_knob(knobs, knob, value));
  return knobs;
}

bool has_annotation(const std::vector<std::uint32_t>& words) {
  return std::ranges::any_of(words, [](std::uint32_t w) { return w >> 24 >= 0xe7 && w >> 24 <= 0xef; });
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("a knob about what a scene has not got costs no byte, no word and no kernel") {
    const Has flat{}, lines{.polygons = false}, shaded{.gouraud = true};
    struct Row {
      const Has* lacks;
      const char *knob, *value;
    };
    for (const Row& row : std::initializer_list<Row>{{&flat, "texture", "perspective"},
                                                     {&flat, "filter", "bilinear"},
                                                     {&flat, "filter", "mipmap"},
                                                     {&flat, "filter", "mipmap-linear"},
                                                     {&flat, "subdivide", "8"},
                                                     {&flat, "subdivide", "size-32"},
                                                     {&flat, "subdivide", "error-1"},
                                                     {&flat, "fog", "pixel"},
                                                     {&flat, "depth", "16"},
                                                     {&flat, "depth", "float"},
                                                     {&flat, "depth-mapping", "linear"},
                                                     {&flat, "depth-test", "lequal"},
                                                     {&flat, "depth-reversed", "on"},
                                                     {&flat, "near", "1"},
                                                     {&flat, "far", "5000"},
                                                     {&flat, "aa-filter", "tent"},
                                                     {&flat, "aa-space", "linear"},
                                                     {&shaded, "filter", "mipmap-linear"},
                                                     {&shaded, "fog", "pixel"},
                                                     {&lines, "position", "256"},
                                                     {&lines, "antialias", "msaa-4"},
                                                     {&lines, "antialias", "rotated-16"},
                                                     {&lines, "antialias", "taa"},
                                                     {&lines, "texture", "perspective"},
                                                     {&lines, "fog", "pixel"}}) {
      CAPTURE(std::string(row.knob));
      CAPTURE(std::string(row.value));
      const auto asked = paid(*row.lacks, with(row.knob, row.value));
      CHECK(asked == paid(*row.lacks, {}));
      CHECK_FALSE(asked.has_canvas);
      CHECK_FALSE(has_annotation(asked.words));
    }
  }

  TEST_CASE("the same knobs are paid for where their object is there") {
    CHECK(paid({.textured = true}, with("texture", "perspective")).has_canvas);
    CHECK(paid({.gouraud = true}, with("texture", "perspective")).has_canvas);
    CHECK(paid({.textured = true}, with("filter", "bilinear")).has_canvas);
    CHECK(paid({.fog = true}, with("fog", "pixel")).has_canvas);
    CHECK(paid({}, with("position", "256")).has_canvas);
    CHECK(paid({}, with("antialias", "msaa-4")).has_canvas);
    CHECK(has_annotation(paid({}, with("visibility", "zbuffer")).words));
    CHECK(has_annotation(paid({.fog = true}, with("fog", "pixel")).words));
    CHECK(has_annotation(paid({.textured = true}, with("texture", "perspective")).words));
  }

  TEST_CASE("only primitives that a knob is about bring annotation words") {
    // Beside a flat quad a textured one: perspective asks for the depth of the second alone.
    auto both = scene_with({.textured = true});
    both.world.materials.emplace_back();
    both.world.materials[1].double_sided = true;
    scene::Mesh flat = both.world.meshes[0];
    flat.faces[0].material = 1;
    flat.lines.clear();
    both.world.meshes.push_back(flat);
    both.world.instances.push_back({1, glm::mat4(1.0F)});
    const auto knobs = with("texture", "perspective");
    scene::FrameBuilder builder(both, knobs);
    ot::MainRam ram(ot::RamSize::mib8);
    const auto frame = builder.build(0, knobs, ram);
    REQUIRE(frame);
    int depths = 0;
    REQUIRE(ot::walk(ram, frame->head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
      for (const auto word : payload) depths += word >> 24 == 0xe8 ? 1 : 0;
    }));
    CHECK(depths == 1);
  }
}
