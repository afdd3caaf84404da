// Scenes of a university course beside the pictures they should give. The pictures were drawn at other sizes,
// some with very large pixels, and by a browser whose primaries are not ours: shapes and places are compared,
// colours roughly.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../vectors.h"
#include "base/read_file.h"
#include "display/scanout.h"
#include "gpu/gpu.h"
#include "load/load.h"
#include "load/pictures.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"

namespace {

struct Colour {
  double r = 0, g = 0, b = 0;
  [[nodiscard]] bool is_drawn() const { return std::max({r, g, b}) > 24; }
};

// Colours of a picture of any size, asked for where 0,0 is its middle and +-1 its upper and lower edge.
struct View {
  int width = 0, height = 0;
  std::vector<scene::Rgba8> pixels;
  [[nodiscard]] Colour at(double x, double y) const {
    const double column = width / 2.0 + x * height / 2, row = height / 2.0 + y * height / 2;
    const auto clamped = [](double v, int size) {
      return std::clamp(static_cast<int>(std::floor(v)), 0, size - 1);
    };
    const auto& p = pixels[static_cast<std::size_t>(clamped(row, height) * width + clamped(column, width))];
    return {double(p.r), double(p.g), double(p.b)};
  }
  [[nodiscard]] double half_width() const { return static_cast<double>(width) / height; }
};

View reference(const std::filesystem::path& file) {
  const auto bytes = base::read_regular_file(file, load::limits::picture_bytes);
  REQUIRE(bytes);
  auto picture = load::decode_picture(*bytes);
  REQUIRE(picture);
  return {picture->width, picture->height, std::move(picture->pixels)};
}

View drawn(const base::Result<load::LoadedScene>& loaded) {
  REQUIRE(loaded);
  CHECK(loaded->warnings.empty());
  scene::Knobs knobs;
  knobs.visibility = scene::Visibility::zbuffer;
  scene::FrameBuilder builder(loaded->scene, knobs);
  gpu::Gpu gpu;
  ot::MainRam ram(ot::RamSize::mib8);
  builder.upload(gpu);
  REQUIRE(scene::render_frame(builder, 0, knobs, ram, gpu));
  const auto picture = display::scan_out(gpu.vram().pixels(), display::area_of(gpu.display()));
  View view{picture.width, picture.height, {}};
  for (const auto& p : picture.pixels) view.pixels.push_back({p.r, p.g, p.b, 255});
  return view;
}

struct Difference {
  double shape = 0;   // share of the points drawn in either that are not drawn in both
  double colour = 0;  // mean difference of a channel where both are drawn
};

Difference compare(const View& a, const View& b) {
  const double side = std::min(a.half_width(), b.half_width()) * 0.98;
  int both = 0, either = 0;
  double colour = 0;
  for (double y = -0.98; y < 0.98; y += 0.01) {
    for (double x = -side; x < side; x += 0.01) {
      const Colour p = a.at(x, y), q = b.at(x, y);
      either += p.is_drawn() || q.is_drawn() ? 1 : 0;
      if (!p.is_drawn() || !q.is_drawn()) continue;
      ++both;
      colour += (std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b)) / 3;
    }
  }
  REQUIRE(both > 0);
  return {1 - static_cast<double>(both) / either, colour / both};
}

TEST_SUITE("loaders") {
  TEST_CASE("a surface that no light reaches shows what it emits, one that is lit shows both") {
    const auto colour = [](const char* direction) {
      const std::string text =
          std::string("<X3D><Scene><NavigationInfo headlight='false'/><DirectionalLight direction='")
              .append(direction)
              .append(
                  "'/><Shape><Box size='99 99 1'/><Appearance><Material diffuseColor='0.5 0.5 0' "
                  "emissiveColor='0.25 0 0.75'/></Appearance></Shape></Scene></X3D>");
      return drawn(load::parse_x3d(text, {"s.x3d", "."})).at(0, 0);
    };
    const auto is_near = [](const Colour& c, double r, double g, double b) {
      return std::abs(c.r - r) <= 8 && std::abs(c.g - g) <= 8 && std::abs(c.b - b) <= 8;
    };
    CHECK(is_near(colour("1 0 0"), 64, 0, 191));
    CHECK(
        is_near(colour("0 0 -1"), 191, 128, 191 + 27));  // blue needs some diffuse to emit through: 0.75 / 7
  }

  TEST_CASE("course scenes look like the course's pictures") {
    struct Course {
      const char* name;
      double shape, colour;  // the most by which they may differ; large pixels differ more at their edges
    };
    for (const Course& course : {Course{"caixas", 0.05, 12},
                                 {"dois_tri", 0.25, 12},
                                 {"flechas", 0.05, 50},
                                 {"leques", 0.05, 50},
                                 {"quadrado", 0.05, 50},
                                 {"retangulos", 0.05, 50},
                                 {"textura", 0.05, 50},
                                 {"texturas", 0.05, 50},
                                 {"transparente", 0.05, 50},
                                 {"tri_color", 0.3, 50},
                                 {"triangulos", 0.3, 50},
                                 {"varios_triangs", 0.1, 50}}) {
      const std::string name = course.name;
      CAPTURE(name);
      const auto folder = tests::vector_path(("x3d/" + name).c_str());
      if (!folder) continue;
      const Difference d =
          compare(drawn(load::load(*folder / (name + ".x3d"))), reference(*folder / (name + ".png")));
      MESSAGE(name, ": shape ", d.shape, ", colour ", d.colour);
      CHECK(d.shape < course.shape);
      CHECK(d.colour < course.colour);
    }
  }
}

}  // namespace
