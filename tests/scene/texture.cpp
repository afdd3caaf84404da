#include "scene/texture.h"

#include <doctest/doctest.h>

#include <string>

using scene::Rgba8;
using scene::TexelAxis, scene::TexelCoordinate;
using scene::TexelFormat;
using scene::Texture;

namespace {

Texture picture(int width, int height, TexelFormat depth = TexelFormat::clut8, bool repeats = false) {
  Texture t;
  t.name = "picture";
  t.width = width;
  t.height = height;
  t.depth = depth;
  t.repeats = repeats;
  for (int i = 0; i < width * height; ++i)
    t.pixels.push_back({static_cast<std::uint8_t>(i * 7), static_cast<std::uint8_t>(i * 13 / 5),
                        static_cast<std::uint8_t>(i / 3), 255});
  return t;
}

// Every block lies in VRAM, outside of the frame buffers, and on no other block.
void check_layout(const scene::TexturePack& pack, int frame_width) {
  std::vector<int> owner(1024 * 512, 0);
  int number = 0;
  for (const auto& block : pack.blocks) {
    ++number;
    REQUIRE(block.area.x + block.area.width <= 1024);
    REQUIRE(block.area.y + block.area.height <= 512);
    REQUIRE(block.halfwords.size() == static_cast<std::size_t>(block.area.width * block.area.height));
    bool free = true;
    bool outside = true;
    for (int y = block.area.y; y < block.area.y + block.area.height; ++y) {
      for (int x = block.area.x; x < block.area.x + block.area.width; ++x) {
        auto& at = owner[static_cast<std::size_t>(y * 1024 + x)];
        free = free && at == 0;
        outside = outside && (x >= frame_width || y >= 480);
        at = number;
      }
    }
    CHECK(free);
    CHECK(outside);
  }
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("a picture of at most 256 x 256 keeps its size and pixels") {
    const auto t = picture(200, 3);
    const auto s = scene::scaled(t, 0);
    CHECK(s.width == 200);
    CHECK(s.height == 3);
    CHECK(s.pixels == t.pixels);
  }

  TEST_CASE("a larger picture is scaled side by side to 256, and keeps its mean colour") {
    Texture t = picture(1000, 10);
    for (auto& p : t.pixels) p = {100, 150, 200, 255};
    const auto s = scene::scaled(t, 0);
    CHECK(s.width == 256);
    CHECK(s.height == 10);
    for (const auto& p : s.pixels) CHECK(p == Rgba8{100, 150, 200, 255});
  }

  TEST_CASE("scaling averages areas exactly: 512 columns of black and white become 256 of grey") {
    Texture t = picture(512, 1);
    for (std::size_t i = 0; i < t.pixels.size(); ++i)
      t.pixels[i] = i % 2 == 0 ? Rgba8{0, 0, 0, 255} : Rgba8{255, 255, 255, 255};
    for (const auto& p : scene::scaled(t, 0).pixels) CHECK(p == Rgba8{128, 128, 128, 255});
  }

  TEST_CASE("transparent pixels lend no colour to their neighbours when scaled") {
    Texture t = picture(512, 1);
    for (std::size_t i = 0; i < t.pixels.size(); ++i)
      t.pixels[i] = i % 2 == 0 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 255, 0, 0};
    for (const auto& p : scene::scaled(t, 0).pixels) CHECK(p == Rgba8{255, 0, 0, 128});
  }

  TEST_CASE("a picture whose pixels do not match its size becomes one white texel") {
    Texture t = picture(4, 4);
    t.pixels.pop_back();
    const auto s = scene::scaled(t, 0);
    CHECK(s.width == 1);
    CHECK(s.pixels == std::vector{Rgba8{255, 255, 255, 255}});
  }

  TEST_CASE("textures of all kinds lie beside the frame buffers of every display mode, none on another") {
    std::vector<Texture> all;
    for (const auto depth : {TexelFormat::clut4, TexelFormat::clut8, TexelFormat::direct15})
      for (const int size : {1, 5, 16, 40, 64, 100, 128})
        all.push_back(picture(size, size / 2 + 1, depth, size % 2 == 0));
    for (const int width : {256, 320, 368, 512, 640}) {
      CAPTURE(width);
      check_layout(scene::pack_textures(all, width), width);
    }
  }

  TEST_CASE(
      "no texture passes texel 255 of its page, and windowed ones begin at a multiple of their period") {
    std::vector<Texture> all;
    for (int i = 0; i < 30; ++i)
      all.push_back(picture(8 << i % 5, 8 << i % 4, static_cast<TexelFormat>(1 + i % 3), true));
    const auto pack = scene::pack_textures(all, 320);
    for (const auto& t : pack.textures) {
      CHECK(t.u.origin + t.u.texels <= 256);
      CHECK(t.v.origin + t.v.texels <= 256);
      CHECK(t.u.windowed);
      CHECK(t.u.origin % t.u.texels == 0);
      CHECK(t.v.origin % t.v.texels == 0);
    }
  }

  TEST_CASE("while textures do not fit the largest is halved, and both sizes are reported once") {
    const std::vector<Texture> all(6, picture(256, 256, TexelFormat::direct15));
    const auto pack =
        scene::pack_textures(all, 640);  // 384 x 512 halfwords are free: room for two and a half
    check_layout(pack, 640);
    CHECK(pack.report.size() >= 4);
    CHECK(pack.report.size() <= 6);
    CHECK(pack.report[0] == "texture picture: 256x256 stored as 128x128");
    CHECK(pack.textures.size() == 6);
  }

  TEST_CASE("more textures than VRAM can hold at all are refused in one line, not crowded in") {
    const std::vector<Texture> all(5000, picture(1, 1));
    const auto pack = scene::pack_textures(all, 640);
    CHECK(pack.blocks.empty());
    CHECK(pack.textures.size() == 5000);
    CHECK(pack.report.size() == 1);
  }

  TEST_CASE("a window repeats a power of two: 32 texels at origin 96 give mask 28 and offset 12") {
    // u' = (u & ~(28 * 8)) | (12 & 28) * 8 = (u & 31) | 96
    std::vector<Texture> all{picture(96, 8, TexelFormat::clut8), picture(32, 32, TexelFormat::clut8, true)};
    const auto pack = scene::pack_textures(all, 320);
    const auto& t = pack.textures[1];
    const auto mask = t.window & 31;
    const auto offset = t.window >> 10 & 31;
    CHECK(mask == 28);
    CHECK(static_cast<int>(offset) * 8 == t.u.origin);
  }

  TEST_CASE("texture coordinates 0..1 cover all texels and never the neighbour's") {
    const TexelAxis axis{.texels = 40, .origin = 60};
    const TexelCoordinate first{60, -4}, last{99, 4};  // half a texel before the first, and behind the last
    CHECK(axis.coordinate(0, 0, true) == first);
    CHECK(axis.coordinate(0.5, 0, true) == TexelCoordinate{80, -4});  // 19.5
    CHECK(axis.coordinate(1, 0, true) == last);
    CHECK(axis.coordinate(7, 0, false) == last);  // clamped
    CHECK(axis.coordinate(-3, 0, false) == first);
  }

  TEST_CASE("u is t N - 1/2: as near to it as a whole number can be, and the rest in eighths") {
    for (const int texels : {8, 32, 100, 255, 256}) {
      for (const bool windowed : {false, true}) {
        if (windowed && texels != 8 && texels != 32 && texels != 256) continue;  // powers of two alone
        const TexelAxis axis{.texels = texels, .origin = 0, .windowed = windowed, .repeats = windowed};
        for (int n = 0; n <= 64; ++n) {
          CAPTURE(texels);
          CAPTURE(n);
          const auto c = axis.coordinate(n / 64.0, 0, true);
          const double exact = n / 64.0 * texels - 0.5;
          CHECK(c.whole < texels);
          CHECK(std::abs(c.whole - exact) <= 0.5);
          CHECK(std::abs(c.whole + c.rest / 8.0 - exact) <= 1.0 / 16);
        }
      }
    }
  }

  TEST_CASE("a repeated axis counts from the whole part of the polygon's smallest coordinate") {
    const TexelAxis axis{.texels = 64, .origin = 0, .windowed = true, .repeats = true};
    CHECK(axis.periods() == 3);
    CHECK(axis.coordinate(-2.5, -3, false) == TexelCoordinate{32, -4});
    CHECK(axis.coordinate(0, -3, false) == TexelCoordinate{192, -4});
    // Four periods do not fit: tessellate() cuts such faces.
    CHECK(axis.coordinate(1, -3, false).whole == 255);
  }

  TEST_CASE("packing is the same every time") {
    const std::vector<Texture> all{picture(50, 60), picture(120, 7, TexelFormat::direct15), picture(64, 64)};
    const auto a = scene::pack_textures(all, 320);
    const auto b = scene::pack_textures(all, 320);
    REQUIRE(a.blocks.size() == b.blocks.size());
    for (std::size_t i = 0; i < a.blocks.size(); ++i) {
      CHECK(a.blocks[i].area == b.blocks[i].area);
      CHECK(a.blocks[i].halfwords == b.blocks[i].halfwords);
    }
  }
}
