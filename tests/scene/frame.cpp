#include "scene/frame.h"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "gpu/gpu.h"
#include "ot/gp0.h"
#include "ot/main_ram.h"
#include "ot/walker.h"
#include "scene/angle.h"
#include "scene/pipeline.h"

using scene::Drop;
using scene::FrameBuilder;
using scene::Knobs;

namespace {

void add_triangle(scene::Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c, scene::Rgb8 colour,
                  std::uint32_t material = 0) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c});
  scene::Face face;
  face.vertex = {first, first + 1, first + 2, scene::none};
  face.colour.fill(colour);
  face.material = material;
  mesh.faces.push_back(face);
}

// A triangle at z = -depth that covers the middle of the picture, facing the camera.
void add_middle(scene::Mesh& mesh, float depth, scene::Rgb8 colour, std::uint32_t material = 0) {
  add_triangle(mesh, {-depth, -depth, -depth}, {depth, -depth, -depth}, {0, depth, -depth}, colour, material);
}

scene::Scene scene_of(const scene::Mesh& mesh) {
  scene::Scene s;
  s.world.meshes = {mesh};
  s.world.instances.resize(1);
  s.world.units_per_world = 1000;
  return s;
}

struct Drawn {
  explicit Drawn(const scene::Scene& s, Knobs knobs = {}, double seconds = 0) : ram(ot::RamSize::mib8) {
    knobs.colour = scene::Colour::bits15;
    FrameBuilder builder(s, knobs);
    builder.upload(gpu);
    const auto result = scene::render_frame(builder, seconds, knobs, ram, gpu);
    REQUIRE(result);
    stats = *result;
  }
  [[nodiscard]] int middle() { return gpu.vram().at(160, 120); }
  gpu::Gpu gpu;
  ot::MainRam ram;
  scene::FrameStats stats;
};

std::vector<std::uint32_t> list_words(const ot::MainRam& ram, std::uint32_t head) {
  std::vector<std::uint32_t> words;
  const auto end = ot::walk(ram, head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    words.insert(words.end(), payload.begin(), payload.end());
  });
  REQUIRE(end);
  return words;
}

// Without E7h..EFh between commands; every command is stepped over whole.
std::vector<std::uint32_t> without_annotations(const std::vector<std::uint32_t>& words) {
  std::vector<std::uint32_t> out;
  for (std::size_t i = 0; i < words.size();) {
    const std::size_t n = ot::gp0::command_words(words[i]);
    if (ot::gp0::command_of(words[i]) != ot::gp0::Command::annotation)
      out.insert(out.end(), words.begin() + static_cast<std::ptrdiff_t>(i),
                 words.begin() + static_cast<std::ptrdiff_t>(i + n));
    i += n;
  }
  return out;
}

constexpr scene::Rgb8 red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255};

scene::Scene random_scene(unsigned seed, int faces) {
  std::mt19937 random(seed);
  scene::Mesh mesh;
  const auto number = [&](float size) { return (static_cast<float>(random() % 2001) / 1000.0F - 1) * size; };
  for (int i = 0; i < faces; ++i) {
    const glm::vec3 at(number(4), number(3), -5 + number(4));
    const auto near = [&] { return at + glm::vec3(number(1), number(1), number(1)); };
    const auto a = near();
    const auto b = near();
    add_triangle(mesh, a, b, near(),
                 {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 9});
  }
  auto s = scene_of(mesh);
  s.world.materials[0].double_sided = true;
  return s;
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("a face is seen from the side from which it runs counter-clockwise") {
    scene::Mesh mesh;
    add_middle(mesh, 3, red);
    CHECK(Drawn(scene_of(mesh)).middle() == 31);
    std::swap(mesh.faces[0].vertex[0], mesh.faces[0].vertex[1]);
    Drawn back(scene_of(mesh));
    CHECK(back.middle() == 0);
    CHECK(back.stats.dropped_by(Drop::back_face) == 1);
    auto s = scene_of(mesh);
    s.world.materials[0].double_sided = true;
    CHECK(Drawn(s).middle() == 31);
  }

  TEST_CASE("a half of a bent quad that is seen from behind is culled alone") {
    scene::Mesh mesh;
    mesh.positions = {
        {-1, -1, -3}, {1, -1, -3}, {-0.9F, -0.9F, -3}, {-1, 1, -3}};  // folded over its diagonal
    scene::Face face;
    face.vertex = {0, 1, 2, 3};
    face.colour.fill(red);
    mesh.faces = {face};
    Drawn d(scene_of(mesh));
    CHECK(d.stats.primitives <= 1);
  }

  TEST_CASE("the nearer triangle is drawn later, whichever was submitted first") {
    for (const bool swapped : {false, true}) {
      scene::Mesh mesh;
      add_middle(mesh, swapped ? 3.0F : 5.0F, swapped ? red : green);
      add_middle(mesh, swapped ? 5.0F : 3.0F, swapped ? green : red);
      CHECK(Drawn(scene_of(mesh)).middle() == 31);
    }
  }

  TEST_CASE("in one bucket the last submitted is drawn first, or last on request") {
    scene::Mesh mesh;
    add_middle(mesh, 3, red);
    add_middle(mesh, 3, blue);
    Knobs knobs;
    CHECK(Drawn(scene_of(mesh), knobs).middle() == 31);
    knobs.bucket_order = scene::BucketOrder::fifo;
    CHECK(Drawn(scene_of(mesh), knobs).middle() == 31 << 10);
    knobs.visibility = scene::Visibility::sorted;
    CHECK(Drawn(scene_of(mesh), knobs).middle() == 31 << 10);
    knobs.bucket_order = scene::BucketOrder::lifo;
    CHECK(Drawn(scene_of(mesh), knobs).middle() == 31);
  }

  TEST_CASE("a bias pushes the faces of a material away") {
    scene::Mesh mesh;
    add_middle(mesh, 3, red, 1);
    add_middle(mesh, 3.5F, blue);
    auto s = scene_of(mesh);
    s.world.materials.resize(2);
    CHECK(Drawn(s).middle() == 31);
    s.world.materials[1].bias = 40;  // 0.5 units of depth are 500 / 32768 of the table: 16 buckets
    CHECK(Drawn(s).middle() == 31 << 10);
  }

  // z 3000: AVSZ3 gives 2731 * 9000 >> 12 = 6000, and 6000 * 64 >> 16 is bucket 5 of 64.
  TEST_CASE(
      "a bucket that the bias puts below, at or above the table's range is counted, and drawn all the same") {
    scene::Mesh mesh;
    add_triangle(mesh, {-1, -1, -3}, {1, -1, -3}, {0, 1, -3}, red);
    const auto s = scene_of(mesh);
    struct Row {
      int bias;
      std::uint32_t below, at, above;
    };
    for (const auto visibility : {scene::Visibility::ot, scene::Visibility::zbuffer}) {
      for (const Row& row :
           {Row{-6, 1, 0, 0}, Row{-5, 0, 0, 0}, Row{58, 0, 0, 0}, Row{59, 0, 1, 0}, Row{60, 0, 0, 1}}) {
        CAPTURE(row.bias);
        Drawn d(s, {.visibility = visibility, .buckets = 64, .bias = row.bias});
        CHECK(d.stats.out_of_range.below == row.below);
        CHECK(d.stats.out_of_range.at == row.at);
        CHECK(d.stats.out_of_range.above == row.above);
        CHECK(d.middle() == 31);
      }
    }
  }

  TEST_CASE("every face is drawn or counted under a reason") {
    for (unsigned seed = 0; seed < 20; ++seed) {
      auto s = random_scene(seed, 300);
      s.world.materials[0].double_sided = seed % 2 == 0;
      Drawn d(s);
      std::uint32_t dropped = 0;
      for (const auto n : d.stats.dropped) dropped += n;
      CHECK(d.stats.faces == 300);
      // Cut faces may become several primitives.
      CHECK(dropped + d.stats.primitives >= 300);
      CHECK(dropped + d.stats.primitives <= 300 + 10 * d.stats.clipped);
      CHECK(dropped < 300);
    }
  }

  TEST_CASE("triangles that cross the near plane at any angle neither vanish nor explode") {
    // A long needle of a floor that starts behind the camera, turned and tilted: from where it enters the
    // picture it is a wedge without gaps, and its colour is nowhere above the horizon.
    for (int turn = 0; turn < 64; ++turn) {
      for (int tilt = -8; tilt <= 8; ++tilt) {
        scene::Mesh mesh;
        add_triangle(mesh, {0, -0.4F, -20}, {-0.9F, -0.4F, 20}, {0.9F, -0.4F, 20}, red);
        auto s = scene_of(mesh);
        s.world.camera.orientation = scene::rotation_y((turn - 32) / 600.0) * scene::rotation_x(tilt / 200.0);
        Drawn d(s);
        CAPTURE(turn);
        CAPTURE(tilt);
        // Row by row one run of pixels; the horizon is where the view ray is level.
        const double horizon =
            120 + 290 * std::sqrt(1.0) * (scene::sin_turns(tilt / 200.0) / scene::cos_turns(tilt / 200.0));
        int runs = 0;
        int above = 0;
        for (int y = 0; y < 240; ++y) {
          int changes = 0;
          for (int x = 1; x < 320; ++x) changes += d.gpu.vram().at(x, y) != d.gpu.vram().at(x - 1, y) ? 1 : 0;
          runs = std::max(runs, changes);
          for (int x = 0; x < 320; ++x) above += y < horizon - 2 && d.gpu.vram().at(x, y) != 0 ? 1 : 0;
        }
        CHECK(runs <= 2);
        CHECK(above == 0);
        if (tilt <= 0) CHECK(d.stats.clipped == 1);
      }
    }
  }

  TEST_CASE("lists for the ordering table and for the z-buffer are equal apart from annotation words") {
    for (unsigned seed = 0; seed < 10; ++seed) {
      const auto s = random_scene(seed, 200);
      Knobs knobs;
      ot::MainRam ram(ot::RamSize::mib8);
      FrameBuilder builder(s, knobs);
      const auto plain = builder.build(0, knobs, ram);
      REQUIRE(plain);
      const auto words = list_words(ram, plain->head);
      CHECK(without_annotations(words) == words);  // no knob asks: no such word
      knobs.visibility = scene::Visibility::zbuffer;
      const auto annotated = builder.build(0, knobs, ram);
      REQUIRE(annotated);
      const auto more = list_words(ram, annotated->head);
      CHECK(more.size() > words.size());
      CHECK(without_annotations(more) == words);
    }
  }

  TEST_CASE(
      "annotations are in nodes of their own directly before the primitive, and say the depth of each "
      "vertex") {
    scene::Mesh mesh;
    add_triangle(mesh, {-1, -1, -2}, {1, -1, -3}, {0, 1, -4}, red);
    const auto s = scene_of(mesh);
    Knobs knobs;
    ot::MainRam ram(ot::RamSize::mib8);
    FrameBuilder builder(s, knobs);
    const auto frame = builder.build(0, knobs, ram, scene::Annotate::always);
    REQUIRE(frame);
    std::vector<std::vector<std::uint32_t>> nodes;
    ot::walk(ram, frame->head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
      if (!payload.empty()) nodes.emplace_back(payload.begin(), payload.end());
    });
    REQUIRE(nodes.size() == 3);  // environment, annotation, triangle
    // The console's order is clockwise: vertices 0, 2, 1 at 2000, 4000 and 3000 units, 20.12.
    CHECK((nodes[1][0] & 0xffffff) == 2000 << 12);
    CHECK((nodes[1][1] & 0xffffff) == 4000 << 12);
    CHECK((nodes[1][2] & 0xffffff) == 3000 << 12);
    CHECK(nodes[1].size() == 3);  // no fractions: corners are drawn at whole pixels
    CHECK(nodes[2].size() == 4);
  }

  TEST_CASE("frames can be asked for in any order") {
    scene::Mesh mesh;
    add_middle(mesh, 3, red);
    auto s = scene_of(mesh);
    s.animate = [](scene::World& w, double t) { w.instances[0].model = scene::rotation_z(t / 3); };
    Knobs knobs;
    ot::MainRam ram(ot::RamSize::mib8);
    FrameBuilder forwards(s, knobs);
    FrameBuilder backwards(s, knobs);
    std::map<int, std::vector<std::uint32_t>> lists;
    for (int n = 0; n < 10; ++n) {
      const auto frame = forwards.build(n / 60.0, knobs, ram);
      REQUIRE(frame);
      lists[n] = list_words(ram, frame->head);
    }
    for (int n = 9; n >= 0; --n) {
      const auto frame = backwards.build(n / 60.0, knobs, ram);
      REQUIRE(frame);
      CHECK(list_words(ram, frame->head) == lists[n]);
    }
  }

  TEST_CASE("odd frames of 240-line modes are drawn in the second buffer, and shown from there") {
    scene::Mesh mesh;
    add_middle(mesh, 3, red);
    Drawn d(scene_of(mesh), {}, 1 / 60.0);
    CHECK(d.gpu.display().start_y() == 240);
    CHECK(d.gpu.vram().at(160, 360) == 31);
    CHECK(d.gpu.vram().at(160, 120) == 0);
    Knobs tall;
    tall.height = 480;
    Drawn single(scene_of(mesh), tall, 1 / 60.0);
    CHECK(single.gpu.display().start_y() == 0);
    CHECK(single.gpu.vram().at(160, 240) == 31);
  }

  TEST_CASE(
      "a frame that does not fit into RAM is drawn in several lists, far to near, to the same picture") {
    auto s = random_scene(5, 60000);
    for (auto& p : s.world.meshes[0].positions) p.z -= 1;
    Knobs knobs;
    knobs.position = scene::Position::fine;
    knobs.visibility = scene::Visibility::zbuffer;  // 48 bytes a triangle with its annotation
    ot::MainRam small(ot::RamSize::mib2);
    ot::MainRam large(ot::RamSize::mib8);
    gpu::Gpu one;
    gpu::Gpu other;
    FrameBuilder builder(s, knobs);
    builder.upload(one);
    builder.upload(other);
    const auto split = scene::render_frame(builder, 0, knobs, small, one);
    const auto whole = scene::render_frame(builder, 0, knobs, large, other);
    REQUIRE(split);
    REQUIRE(whole);
    CHECK(whole->lists == 1);
    CHECK(split->lists >= 2);
    CHECK(split->primitives == whole->primitives);
    CHECK(split->ram_bytes <= 0x200000);
    CHECK(std::equal(one.vram().pixels().begin(), one.vram().pixels().end(), other.vram().pixels().begin()));
  }

  TEST_CASE("a frame whose one bucket does not fit is refused, with the bytes needed and available") {
    Knobs knobs;
    knobs.buckets = 1;
    knobs.position = scene::Position::fine;
    knobs.visibility = scene::Visibility::zbuffer;
    const auto s = random_scene(5, 60000);
    ot::MainRam ram(ot::RamSize::mib2);
    FrameBuilder builder(s, knobs);
    const auto frame = builder.build(0, knobs, ram);
    REQUIRE_FALSE(frame);
    CHECK(frame.error().exit == base::Exit::failed);
    CHECK(frame.error().text.find("bytes of main RAM") != std::string::npos);
  }

  TEST_CASE("an instance whose matrix does not fit is left out and counted, the others are drawn") {
    scene::Mesh mesh;
    add_middle(mesh, 3, red);
    auto s = scene_of(mesh);
    s.world.instances.push_back({0, scene::scaling({1e30F, 1, 1})});
    s.world.instances.push_back({0, glm::mat4(std::nanf(""))});
    s.world.instances.push_back({7, glm::mat4(1.0F)});  // no such mesh
    Drawn d(s);
    CHECK(d.stats.dropped_by(Drop::unrepresentable) == 2);
    CHECK(d.stats.faces == 3);
  }

  TEST_CASE("lines and dots are drawn, cut at the near plane, and have no depth") {
    scene::Mesh mesh;
    mesh.positions = {{-1, 0, -3}, {1, 0, -3}, {0, -0.1F, 5}, {0, -0.1F, -5}};
    mesh.lines = {{{0, 1}, {red, red}, 0}, {{2, 3}, {green, green}, 0}, {{0, 0}, {blue, blue}, 0}};
    Drawn d(scene_of(mesh));
    CHECK(d.stats.primitives == 3);
    CHECK(d.stats.clipped == 1);
    CHECK(d.gpu.vram().at(200, 120) == 31);
    CHECK(d.gpu.vram().at(160, 230) == 31 << 5);
  }

  TEST_CASE("polygons() lists what a frame draws, with depth") {
    const auto s = random_scene(3, 100);
    Knobs knobs;
    FrameBuilder builder(s, knobs);
    ot::MainRam ram(ot::RamSize::mib8);
    const auto frame = builder.build(0, knobs, ram);
    REQUIRE(frame);
    std::vector<scene::ScreenPolygon> polygons;
    builder.polygons(0, knobs, polygons);
    CHECK(polygons.size() == frame->stats.primitives);
    for (const auto& p : polygons) {
      CHECK(p.depth.count == 3);
      for (std::size_t k = 0; k < 3; ++k) CHECK((p.depth.z[k] >> 12) >= 146);
      CHECK(p.bucket < 1024);
    }
  }

  TEST_CASE(
      "the size rule never discards a triangle: none that is sent is wider than 1023 or higher than 511") {
    for (const auto& [w, h] : {std::pair{320, 240}, std::pair{640, 480}, std::pair{256, 480}}) {
      Knobs knobs;
      knobs.width = w;
      knobs.height = h;
      std::mt19937 random(9);
      scene::Mesh mesh;
      for (int i = 0; i < 2000; ++i) {
        const auto number = [&] { return static_cast<float>(random() % 2001) / 100.0F - 10; };
        const auto p = [&] { return glm::vec3(number(), number(), number() - 3); };
        const auto a = p();
        const auto b = p();
        add_triangle(mesh, a, b, p(), red);
      }
      const auto s = scene_of(mesh);
      FrameBuilder builder(s, knobs);
      std::vector<scene::ScreenPolygon> polygons;
      builder.polygons(0, knobs, polygons);
      CHECK(polygons.size() > 500);
      for (const auto& p : polygons) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto& a = p.packet.xy[k];
          const auto& b = p.packet.xy[(k + 1) % 3];
          REQUIRE(std::abs(a.x - b.x) <= 1023);
          REQUIRE(std::abs(a.y - b.y) <= 511);
        }
      }
    }
  }
}
