// Whole meshes through the whole line: neighbours that are subdivided, coordinates at the 16-bit limit,
// vertices that lie exactly on a clipping plane.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/angle.h"
#include "scene/clip.h"
#include "scene/pipeline.h"
#include "scene/project.h"
#include "stability/measure.h"
#include "stability/triangulation.h"

using glm::dvec3;
using stability::Measure;
using stability::Random;

namespace {

constexpr int cells = 7;

/// A wall of quads wider than the picture, textured, blended additively. Every vertex is moved along its line
/// of sight, so the wall is crumpled and yet covers each pixel once.
scene::Scene crumpled_wall(Random& random) {
  scene::Scene scene;
  auto& world = scene.world;
  scene::Texture texture;
  texture.width = texture.height = 8;
  texture.pixels.assign(64, {8, 8, 8, 128});
  world.textures = {texture};
  world.materials = {{.texture = 0, .blend = scene::Blend::add, .raw_texture = true}};
  scene::Mesh mesh;
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      const bool inner = x > 0 && x < cells && y > 0 && y < cells;
      const auto bend = [&] { return inner ? static_cast<float>(random.between(-200, 200)) / 1000.0F : 0; };
      const float away = 1 + static_cast<float>(random.between(0, 2000)) / 1000.0F;
      const float across = (static_cast<float>(x) + bend()) / cells - 0.5F,
                  down = (static_cast<float>(y) + bend()) / cells - 0.5F;
      mesh.positions.push_back(glm::vec3(2.2F * across, -1.8F * down, -1) * away);
    }
  }
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t at = y * (cells + 1) + x;
      scene::Face face;
      face.vertex = {at, at + cells + 1, at + cells + 2, at + 1};
      face.uv = {glm::vec2(0, 0), {0, 1}, {1, 1}, {1, 0}};
      mesh.faces.push_back(face);
    }
  }
  world.meshes = {mesh};
  world.instances.resize(1);
  world.camera.near_z = 0;
  return scene;
}

/// A box of grids of quads round the eye, bent within each wall. Whoever looks out sees every pixel covered
/// once; the walls beside the eye go on behind it, so that the near plane cuts them, neighbours and all.
scene::Scene room(Random& random, int n) {
  auto scene = crumpled_wall(random);
  auto& mesh = scene.world.meshes[0];
  mesh = {};
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
          const auto along = [&](int at) {
            const bool inner = x > 0 && x < n && y > 0 && y < n;
            const float bend = inner ? static_cast<float>(random.between(-250, 250)) / 1000.0F : 0;
            return 2 * (static_cast<float>(at) + bend) / static_cast<float>(n) - 1;
          };
          glm::vec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = along(x);
          p[(axis + 2) % 3] = along(y);
          mesh.positions.push_back(p);
        }
      }
      const auto row = static_cast<std::uint32_t>(n) + 1;
      for (std::uint32_t y = 0; y + 1 < row; ++y) {
        for (std::uint32_t x = 0; x + 1 < row; ++x) {
          const std::uint32_t at = first + y * row + x;
          scene::Face face;
          face.vertex = {at, at + 1, at + row + 1, at + row};
          face.uv = {glm::vec2(0, 0), {0, 1}, {1, 1}, {1, 0}};
          mesh.faces.push_back(face);
        }
      }
    }
  }
  scene.world.materials[0].double_sided = true;
  return scene;
}

/// Pixels of the picture that were not drawn exactly once.
int wrong_pixels(const scene::Scene& scene, const scene::Knobs& knobs) {
  scene::FrameBuilder builder(scene, knobs);
  static ot::MainRam ram(ot::RamSize::mib8);
  gpu::Gpu gpu;
  builder.upload(gpu);
  if (!scene::render_frame(builder, 0, knobs, ram, gpu)) return knobs.width * knobs.height;
  int wrong = 0;
  for (int y = 0; y < knobs.height; ++y) {
    for (int x = 0; x < knobs.width; ++x) wrong += (gpu.vram().at(x, y) & 31) != 1;
  }
  return wrong;
}

/// The same for every sample of the canvas, in 24 bits.
int wrong_samples(const scene::Scene& scene, const scene::Knobs& knobs) {
  scene::FrameBuilder builder(scene, knobs);
  static ot::MainRam ram(ot::RamSize::mib8);
  gpu::Gpu gpu;
  builder.upload(gpu);
  if (!scene::render_frame(builder, 0, knobs, ram, gpu) || gpu.canvas() == nullptr) return 1 << 30;
  const auto samples = gpu.canvas()->layer(0);
  return static_cast<int>(std::ranges::count_if(samples, [](auto colour) { return (colour & 255) != 8; }));
}

float largest_coordinate(const scene::Mesh& mesh) {
  float largest = 0;
  for (const auto& p : mesh.positions)
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

}  // namespace

TEST_SUITE("stability") {
  TEST_CASE("Neighbouring quads in n x n pieces cover every pixel once") {
    Measure wrong{"1. Watertight",
                  "crumpled walls of 49 quads that fill the picture, in 1 x 1 to 8 x 8 pieces each",
                  "a crack or a seam between pieces, or between pieces of neighbours",
                  "every pixel once",
                  "pixels",
                  0};
    Random random(120);
    for (int n = 1; n <= 8; ++n) {
      for (int i = 0; i < 3; ++i) {
        auto scene = crumpled_wall(random);
        scene.world.units_per_world = 3000;
        scene::Knobs knobs;
        knobs.subdivide.n = n;
        wrong.see(wrong_pixels(scene, knobs), static_cast<std::uint64_t>(cells * cells * n * n));
      }
    }
  }

  TEST_CASE("Rooms round the eye, cut by the near plane and into pieces, cover every pixel once") {
    Measure wrong{
        "1. Watertight",
        "rooms of 6 to 96 bent quads round the eye, in 1 x 1 to 4 x 4 pieces each, near plane at 1/20 "
        "to 1/3 of the wall's distance, random poses and some along the axes",
        "a crack or a seam where neighbours are clipped at the near plane or the guard band",
        "every pixel once",
        "pixels",
        0};
    Measure fine{
        "1. Watertight",
        "the same on a canvas: double transform, 1/256 pixel, perspective, 24 bits, msaa-4, x1 and x2",
        "a crack or a seam in the accurate settings",
        "every sample once",
        "samples",
        0};
    Random random(123);
    for (int i = 0; i < 48; ++i) {
      const int n = 1 << i % 3;
      auto scene = room(random, n);
      scene.world.units_per_world = 6000;
      auto& camera = scene.world.camera;
      camera.near_z = i % 4 == 0 ? 0.3F : 0.05F;
      const auto turns = [&] { return i < 8 ? 0.25 * random.between(0, 3) : random.between(0, 9999) / 1e4; };
      camera.orientation =
          scene::rotation_y(turns());  // one after the other: compilers order operands as they like
      camera.orientation *= scene::rotation_x(turns());
      camera.orientation *= scene::rotation_z(turns());
      const auto place = [&] { return static_cast<float>(random.between(-400, 400)) / 1000.0F; };
      camera.position = {place(), place(), place()};
      scene::Knobs knobs;
      knobs.subdivide.n = 1 + i % 4;
      CAPTURE(i);
      const auto pieces = static_cast<std::uint64_t>(6 * n * n * knobs.subdivide.n * knobs.subdivide.n);
      wrong.see(wrong_pixels(scene, knobs), pieces);
      if (i % 3 == 2) continue;
      knobs.transform = scene::Transform::float64;
      knobs.position = scene::Position::fine;
      knobs.texture = scene::TextureAddress::perspective;
      knobs.colour = scene::Colour::bits24;
      knobs.antialias = {scene::AntialiasKind::msaa, 4};
      knobs.resolution = 1 + i % 2;
      fine.see(wrong_samples(scene, knobs), pieces);
    }
  }

  TEST_CASE("Surfaces farther apart than a bucket is wide are drawn in the right order") {
    Measure confused{
        "6. Depth",
        "two walls d apart that face the eye, 64 to 65,536 buckets, z 300 to 32,000, in both orders: "
        "largest d that was drawn wrongly",
        "a table that wastes its buckets",
        "32,768 / buckets units, and 1 unit that rounding OTZ takes",
        "of the bound",
        1};
    const auto wall = [](int z, scene::Rgb8 colour) {
      scene::Mesh mesh;
      const auto size = static_cast<float>(z) / 8, at = static_cast<float>(-z);
      mesh.positions = {{-size, -size, at}, {size, -size, at}, {size, size, at}, {-size, size, at}};
      scene::Face face;
      face.vertex = {0, 1, 2, 3};
      face.colour.fill(colour);
      mesh.faces = {face};
      return mesh;
    };
    Random random(124);
    static ot::MainRam ram(ot::RamSize::mib8);
    for (const int buckets : {64, 256, 1024, 4096, 65'536}) {
      const double bound = 32'768.0 / buckets + 1;
      double worst = 0;
      for (int i = 0; i < 150; ++i) {
        const int z = random.between(300, 31'000), apart = random.between(0, static_cast<int>(1.5 * bound));
        scene::Scene scene;
        scene.world.units_per_world = 1;
        scene.world.materials.resize(1);
        const auto near = wall(z, {255, 0, 0}), far = wall(z + apart, {0, 0, 255});
        scene.world.meshes = i % 2 == 0 ? std::vector{near, far} : std::vector{far, near};
        scene.world.instances = {{.mesh = 0}, {.mesh = 1}};
        scene::Knobs knobs;
        knobs.buckets = buckets;
        knobs.colour = scene::Colour::bits15;
        scene::FrameBuilder builder(scene, knobs);
        gpu::Gpu gpu;
        builder.upload(gpu);
        REQUIRE(scene::render_frame(builder, 0, knobs, ram, gpu));
        if (gpu.vram().at(160, 120) != 0x1f) worst = std::max(worst, static_cast<double>(apart));
      }
      confused.see(worst / bound, 150);
    }
  }

  TEST_CASE("Meshes that reach the limit of 16-bit coordinates, and beyond it, cover every pixel once") {
    Measure wrong{
        "11. Cameras and scenes",
        "crumpled walls whose farthest vertex lies at 32,767 units, a half unit beyond, and at twice "
        "as many (none beyond 59,389 units: there the picture's edge lies 32,767 aside, which IR1 can hold)",
        "coordinates that wrap, vertices that saturate apart",
        "every pixel once",
        "pixels",
        0};
    Random random(121);
    for (const float reach : {32'766.0F, 32'767.0F, 32'767.5F, 32'768.0F, 40'000.0F, 59'000.0F}) {
      for (int i = 0; i < 4; ++i) {
        auto scene = crumpled_wall(random);
        scene.world.units_per_world = reach / largest_coordinate(scene.world.meshes[0]);
        CAPTURE(reach);
        wrong.see(wrong_pixels(scene, {}), cells * cells);
      }
    }
  }

  TEST_CASE("Vertices exactly on the near plane belong to what lies behind it") {
    Measure moved{"11. Cameras and scenes",
                  "triangles with one to three vertices exactly on the near plane, the others behind it",
                  "a vertex cut where nothing is to cut",
                  "the triangle as it was, to the last bit",
                  "triangles",
                  0};
    Measure left{"11. Cameras and scenes",
                 "triangles with one or two vertices exactly on the near plane, the others before it",
                 "a sliver that is drawn at the near plane",
                 "nothing with an area",
                 "square units",
                 0};
    const scene::Projection projection;
    Random random(122);
    for (const bool whole : {false, true}) {
      const scene::Clipper clipper(projection, whole);
      for (int i = 0; i < 20'000; ++i) {
        const int on_plane = random.between(1, 3);
        const bool behind = on_plane == 3 || i % 2 == 0;
        scene::ClipPolygon in, out;
        for (int v = 0; v < 3; ++v) {
          const double z = v < on_plane ? projection.near_z
                           : behind     ? std::ceil(projection.near_z) + random.between(0, 500)
                                        : std::floor(projection.near_z) - random.between(1, 100);
          in.add({.position = {static_cast<double>(random.between(-60, 60)),
                               static_cast<double>(random.between(-60, 60)), z}});
        }
        const auto before = in;
        clipper.clip(in, out);
        if (behind) {
          bool same = out.count == 3;
          for (std::size_t v = 0; same && v < 3; ++v)
            same = out.vertex[v].position == before.vertex[v].position;
          moved.see(same ? 0 : 1);
        } else {
          dvec3 sum{0.0};
          for (std::size_t v = 2; v < out.count; ++v) {
            sum += glm::cross(out.vertex[v - 1].position - out.vertex[0].position,
                              out.vertex[v].position - out.vertex[0].position);
          }
          left.see(glm::length(sum) / 2);
        }
      }
    }
  }
}
