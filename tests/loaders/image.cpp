#include <doctest/doctest.h>

#include <array>
#include <cstdlib>

#include "files.h"
#include "load/pictures.h"

namespace {

using scene::Rgba8;

bool is_near(const Rgba8& a, const Rgba8& b, int most) {
  return std::abs(a.r - b.r) <= most && std::abs(a.g - b.g) <= most && std::abs(a.b - b.b) <= most &&
         a.a == b.a;
}

// A PNG's signature and header chunk for a size, and nothing behind it.
std::string png_header(std::uint32_t width, std::uint32_t height) {
  std::string head = tests::png(1, 1, 0, 0, 0).substr(0, 33);
  for (int i = 0; i < 4; ++i) {
    head[static_cast<std::size_t>(16 + i)] = static_cast<char>(width >> (24 - 8 * i));
    head[static_cast<std::size_t>(20 + i)] = static_cast<char>(height >> (24 - 8 * i));
  }
  return head;
}

TEST_SUITE("loaders") {
  TEST_CASE("PNG, JPEG, TGA and BMP pictures of odd sizes decode to the colours they were made of") {
    const Rgba8 colour{200, 100, 50, 255};
    for (const auto& [bytes, error] :
         {std::pair{tests::png(13, 7, 200, 100, 50), 0}, std::pair{tests::jpeg(13, 7, 200, 100, 50), 3},
          std::pair{tests::tga(13, 7, 200, 100, 50), 0}, std::pair{tests::bmp(13, 7, 200, 100, 50), 0}}) {
      const auto texture = load::decode_picture(bytes);
      REQUIRE(texture);
      CHECK(texture->width == 13);
      CHECK(texture->height == 7);
      REQUIRE(texture->pixels.size() == 13 * 7);
      for (const Rgba8& pixel : texture->pixels) CHECK(is_near(pixel, colour, error));
    }
  }

  TEST_CASE("a picture's alpha is kept") {
    const auto texture = load::decode_picture(tests::png(2, 2, 1, 2, 3, 77));
    REQUIRE(texture);
    CHECK(texture->pixels[3] == Rgba8{1, 2, 3, 77});
  }

  TEST_CASE("a header that announces 16384 x 16384 is refused before anything is decoded") {
    const auto texture = load::decode_picture(png_header(16384, 16384));
    REQUIRE(!texture);
    CHECK(texture.error().text.find("8192 x 8192") != std::string::npos);
  }

  TEST_CASE("a picture for which few texels are left is kept as means, down to a single one") {
    const auto whole = load::decode_picture(tests::png(40, 30, 10, 20, 30), 1200);
    REQUIRE(whole);
    CHECK(whole->width == 40);
    const auto half = load::decode_picture(tests::png(40, 30, 10, 20, 30), 1199);
    REQUIRE(half);
    CHECK(half->width == 20);
    CHECK(half->height == 15);
    CHECK(half->pixels[7] == scene::Rgba8{10, 20, 30, 255});
    const auto one = load::decode_picture(tests::png(40, 30, 10, 20, 30), 0);
    REQUIRE(one);
    CHECK(one->pixels.size() == 1);
  }

  TEST_CASE("bytes that are no picture, and every truncation of one, give an error and nothing else") {
    CHECK(!load::decode_picture(""));
    CHECK(!load::decode_picture("not a picture at all, but long enough to be one"));
    for (const std::string& whole : {tests::png(9, 9, 9, 9, 9), tests::jpeg(9, 9, 9, 9, 9)}) {
      for (std::size_t size = 0; size < 40; ++size) CHECK(!load::decode_picture(whole.substr(0, size)));
      for (std::size_t size = 40; size < whole.size(); ++size) load::decode_picture(whole.substr(0, size));
    }
  }

  TEST_CASE("a PNG whose stored block copies nothing is an error and nothing else (found by fuzzing)") {
    constexpr std::array<unsigned char, 75> bytes{
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
        0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06, 0x00, 0x00, 0x00, 0x6c,
        0xb6, 0x0d, 0x24, 0x00, 0x00, 0x00, 0x00, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x32, 0x60,
        0x80, 0x03, 0x66, 0x46, 0x76, 0x56, 0x26, 0x32, 0x0a, 0x16, 0x00, 0x66, 0x00, 0x1d, 0x5f,
        0xd2, 0x60, 0xf1, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0x9c, 0x63, 0x60, 0x80};
    CHECK(!load::decode_picture({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
  }

  TEST_CASE("a small PNG whose data inflate far beyond its size is refused") {
    // The data of a 2000 x 2000 picture (16 MB of zeros, a few KB packed) under a header that says 1 x 1.
    std::string bomb = tests::png(2000, 2000, 0, 0, 0, 0);
    const std::string small = png_header(1, 1);
    bomb.replace(0, small.size(), small);
    CHECK(!load::decode_picture(bomb));
  }

  TEST_CASE(
      "a texture is found beside the scene, by back slashes too, and by its last part if its folder is not "
      "there") {
    const tests::Folder folder;
    folder.write("a.png", "x");
    folder.write("sub/b.png", "x");
    for (const char* name : {"a.png", "./a.png", ".\\a.png", "sub/../a.png", "C:\\art\\a.png",
                             "/home/me/a.png", "sub\\b.png", "../elsewhere/a.png"}) {
      CAPTURE(name);
      CHECK(load::resolve(folder.path(), name));
    }
  }

  TEST_CASE("nothing outside the folder of the scene is read, not through a symbolic link either") {
    const tests::Folder outer;
    outer.write("secret.png", "x");
    outer.write("scene/a.obj", "x");
    std::filesystem::create_symlink(outer.path() / "secret.png", outer.path() / "scene/link.png");
    const auto scene_folder = outer.path() / "scene";
    for (const std::string& name :
         {std::string("../secret.png"), (outer.path() / "secret.png").string(), std::string("link.png"),
          std::string("/dev/zero"), std::string("."), std::string(""), std::string("a\0.png", 6)}) {
      CAPTURE(name);
      CHECK(!load::resolve(scene_folder, name));
    }
  }
}

}  // namespace
