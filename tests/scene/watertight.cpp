// Closed surfaces round the camera, drawn additively: every pixel of the picture must be hit exactly once,
// wherever the near plane, the guard band and the 16-bit limits cut the faces.

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <random>

#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/angle.h"
#include "scene/pipeline.h"

namespace {

// Stacks x slices of quads on a sphere, each vertex at its own distance: every ray
// from the centre meets it once.
scene::Mesh shell(std::mt19937& random, int stacks, int slices, float roughness) {
  scene::Mesh mesh;
  const auto distance = [&] { return 1 + roughness * (static_cast<float>(random() % 2001) / 1000.0F - 1); };
  for (int s = 0; s <= stacks; ++s) {
    for (int k = 0; k < slices; ++k) {
      const double up = 0.5 * s / stacks - 0.25;
      const double round = static_cast<double>(k) / slices;
      const float level = static_cast<float>(scene::sin_turns(up));
      const float out = s == 0 || s == stacks ? 0 : static_cast<float>(scene::cos_turns(up));
      const glm::vec3 p(out * static_cast<float>(scene::cos_turns(round)), level,
                        out * static_cast<float>(scene::sin_turns(round)));
      const bool pole = s == 0 || s == stacks;
      mesh.positions.push_back(pole ? p : p * distance());
    }
  }
  const auto at = [&](int s, int k) {
    return static_cast<std::uint32_t>(s * slices + (s == 0 || s == stacks ? 0 : k % slices));
  };
  for (int s = 0; s < stacks; ++s) {
    for (int k = 0; k < slices; ++k) {
      scene::Face face;  // counter-clockwise seen from inside
      if (s == 0) {
        face.vertex = {at(0, 0), at(1, k + 1), at(1, k), scene::none};
      } else if (s == stacks - 1) {
        face.vertex = {at(s, k), at(s, k + 1), at(s + 1, 0), scene::none};
      } else {
        face.vertex = {at(s, k), at(s, k + 1), at(s + 1, k + 1), at(s + 1, k)};
      }
      face.colour.fill({8, 8, 8});
      mesh.faces.push_back(face);
    }
  }
  return mesh;
}

scene::Scene shell_scene(const scene::Mesh& mesh, std::mt19937& random) {
  scene::Scene s;
  auto& w = s.world;
  w.materials = {{.blend = scene::Blend::add}};
  w.meshes = {mesh};
  w.instances.resize(1);
  w.camera.near_z = 0;
  const auto turns = [&] { return static_cast<double>(random() % 10000) / 10000; };
  w.camera.orientation = scene::rotation_y(turns()) * scene::rotation_x(turns()) * scene::rotation_z(turns());
  return s;
}

struct Coverage {
  int holes = 0, doubles = 0;
  std::uint32_t clipped = 0;
};

Coverage draw(const scene::Scene& s, scene::Knobs knobs) {
  knobs.colour = scene::Colour::bits15;
  scene::FrameBuilder builder(s, knobs);
  gpu::Gpu gpu;
  ot::MainRam ram(ot::RamSize::mib8);
  builder.upload(gpu);
  const auto stats = scene::render_frame(builder, 0, knobs, ram, gpu);
  REQUIRE(stats);
  Coverage out;
  out.clipped = stats->clipped;
  for (int y = 0; y < knobs.height; ++y) {
    for (int x = 0; x < knobs.width; ++x) {
      const auto pixel = gpu.vram().at(x, y) & 31;
      out.holes += pixel == 0 ? 1 : 0;
      out.doubles += pixel > 1 ? 1 : 0;
    }
  }
  return out;
}

void check_shells(const scene::Knobs& knobs, int rounds, unsigned seed) {
  std::mt19937 random(seed);
  std::uint32_t clipped = 0;
  for (int i = 0; i < rounds; ++i) {
    const int stacks = 3 + static_cast<int>(random() % 4);
    const int slices = 4 + static_cast<int>(random() % 5);
    auto s = shell_scene(shell(random, stacks, slices, 0.2F), random);
    // From where faces pass just in front of the near plane (290 units at 480 lines) to nearly 16 bits.
    constexpr float units[] = {1200, 2500, 9000, 24000};
    s.world.units_per_world = units[i % 4];
    CAPTURE(i);
    const Coverage c = draw(s, knobs);
    CHECK(c.holes == 0);
    CHECK(c.doubles == 0);
    clipped += c.clipped;
  }
  CHECK(clipped > static_cast<std::uint32_t>(rounds));
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE(
      "a closed surface round the camera covers every pixel exactly once, cut at near plane and guard band") {
    check_shells({}, 60, 11);
  }

  TEST_CASE("the same with the accurate transforms") {
    scene::Knobs knobs;
    knobs.transform = scene::Transform::float32;
    check_shells(knobs, 16, 12);
    knobs.transform = scene::Transform::float64;
    check_shells(knobs, 16, 13);
  }

  TEST_CASE("the same in the widest and highest display modes") {
    scene::Knobs knobs;
    knobs.width = 640;
    knobs.height = 480;
    check_shells(knobs, 8, 14);
    knobs.width = 256;
    check_shells(knobs, 4, 15);
    knobs.height = 240;
    check_shells(knobs, 8, 16);
  }

  TEST_CASE("the same with a textured surface in n x n pieces") {
    std::mt19937 random(17);
    for (int i = 0; i < 12; ++i) {
      auto s = shell_scene(shell(random, 4, 5, 0.3F), random);
      scene::Texture t;
      t.width = t.height = 8;
      t.pixels.assign(64, {8, 8, 8, 128});
      s.world.textures = {t};
      s.world.materials[0].texture = 0;
      s.world.materials[0].raw_texture = true;
      s.world.units_per_world = 3000;
      for (auto& face : s.world.meshes[0].faces) face.uv = {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
      scene::Knobs knobs;
      knobs.subdivide.n = 1 + i % 6;
      CAPTURE(knobs.subdivide.n);
      const Coverage c = draw(s, knobs);
      CHECK(c.holes == 0);
      CHECK(c.doubles == 0);
    }
  }

  TEST_CASE("in pieces halved by size or by affine error no pixel is left out, and folds are rare") {
    // A face thinner than a pixel may fold over when the middles of its long edges are rounded to pixels
    // apart: what its neighbours then both cover is theirs by the vertices alone, however this face is cut.
    using By = scene::SubdivideBy;
    int folded = 0, frames = 0;
    std::mt19937 random(19);
    for (const auto transform : {scene::Transform::gte, scene::Transform::float64}) {
      for (const scene::Subdivide by : {scene::Subdivide{By::size, 8}, scene::Subdivide{By::size, 50},
                                        scene::Subdivide{By::error, 1}, scene::Subdivide{By::error, 6}}) {
        scene::Knobs knobs;
        knobs.subdivide = by;
        knobs.transform = transform;
        for (int i = 0; i < 30; ++i, ++frames) {
          auto s = shell_scene(shell(random, 3 + i % 4, 4 + i % 5, 0.2F), random);
          s.world.units_per_world = i % 2 == 0 ? 2500 : 12000;
          const Coverage c = draw(s, knobs);
          CHECK(c.holes == 0);
          folded += c.doubles;
        }
      }
    }
    MESSAGE(folded << " pixels hit twice in " << frames << " frames");
    CHECK(folded < frames * 320 * 240 / 10'000);
  }

  TEST_CASE("a mirrored instance shows the same faces") {
    std::mt19937 random(18);
    for (int i = 0; i < 8; ++i) {
      auto s = shell_scene(shell(random, 4, 6, 0.2F), random);
      s.world.units_per_world = 4000;
      s.world.instances[0].model =
          scene::scaling({i % 2 == 0 ? -1.0F : 1.0F, i % 3 == 0 ? -1.0F : 1.0F, -1.0F});
      const Coverage c = draw(s, {});
      CHECK(c.holes == 0);
      CHECK(c.doubles == 0);
    }
  }
}
