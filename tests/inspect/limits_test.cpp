#include <doctest/doctest.h>

#include "exact/split.h"
#include "gpu/gpu.h"
#include "ot/packet.h"
#include "random_triangles.h"

namespace {

// A gouraud textured dithered triangle, additive: drawing a pixel twice shows.
std::vector<std::uint32_t> packet(const exact::Triangle& t) {
  ot::Polygon p{.gouraud = true, .textured = true, .semi_transparent = true};
  for (std::size_t i = 0; i < 3; ++i) {
    p.xy[i] = {static_cast<std::int16_t>(t[i].x >> 8), static_cast<std::int16_t>(t[i].y >> 8)};
    p.rgb[i] = {static_cast<std::uint8_t>(t[i].z), static_cast<std::uint8_t>(40 * i),
                static_cast<std::uint8_t>(t[i].x)};
    p.uv[i] = {static_cast<std::uint8_t>(t[i].y >> 7), static_cast<std::uint8_t>(t[i].z >> 5)};
  }
  p.texpage = ot::texpage_of(640, 0, ot::Blend::add, ot::TexelFormat::direct15);
  std::vector<std::uint32_t> words(ot::word_count(p));
  ot::encode(p, words);
  return words;
}

gpu::Gpu prepared() {
  gpu::Gpu gpu;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x)
      gpu.vram().at(640 + x, y) = static_cast<std::uint16_t>(0x8000 | (x * 131 + y * 71));
  }
  for (const std::uint32_t word : {0xe1000200U, 0xe3000000U, 0xe403fc3fU, 0xe5010008U})
    gpu.gp0(word);  // offset 8,32
  return gpu;
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("the pieces of a triangle draw what the triangle draws, attributes included") {
    tests::RandomTriangles random(21);
    const exact::Area area{-8, -32, 55, 223};  // the drawing area, less the offset
    std::uint32_t splits = 0;
    for (int scene = 0; scene < 20; ++scene) {
      const auto triangles = random.scene(tests::Kind::whole_pixels, 12, 40);
      const auto order = split_into_order(triangles, area);
      splits += order.splits;
      for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        gpu::Gpu whole = prepared(), pieces = prepared();
        whole.gp0(packet(triangles[t]));
        for (const auto& piece : order.pieces) {
          if (piece.triangle != t) continue;
          pieces.set_limits(gpu::Limits{piece.rows.top, piece.rows.spans});
          pieces.gp0(packet(triangles[t]));
        }
        const auto a = whole.vram().pixels(), b = pieces.vram().pixels();
        REQUIRE(std::equal(a.begin(), a.end(), b.begin()));
      }
    }
    CHECK(splits > 20);
  }

  TEST_CASE("limits are taken off again") {
    const auto words = packet({{{0, 0, 1}, {2560, 0, 1}, {0, 2560, 1}}});
    gpu::Gpu limited = prepared(), plain = prepared();
    limited.set_limits(gpu::Limits{});
    limited.gp0(words);
    CHECK(limited.vram().at(9, 33) == 0);
    limited.set_limits(std::nullopt);
    limited.gp0(words);
    plain.gp0(words);
    CHECK(plain.vram().at(9, 33) != 0);
    CHECK(limited.vram().at(9, 33) == plain.vram().at(9, 33));
  }
}
