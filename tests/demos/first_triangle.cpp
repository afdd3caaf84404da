// The first page in code: the program is run as a reader would run it, and its picture is looked at.

#include <doctest/doctest.h>
#include <png.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Rgb {
  png_byte r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

struct Picture {
  unsigned width = 0, height = 0;
  std::vector<Rgb> pixels;
  [[nodiscard]] Rgb at(unsigned x, unsigned y) const { return pixels.at(y * width + x); }
};

/// Nothing if it is no PNG.
Picture read_png(const fs::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return picture;
  image.format = PNG_FORMAT_RGB;
  picture.pixels.resize(std::size_t{image.width} * image.height);
  if (png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr) == 0) return {};
  picture.width = image.width;
  picture.height = image.height;
  return picture;
}

int run(const std::string& arguments) {
  const int status = std::system(("'" OTTER_FIRST_TRIANGLE "' " + arguments).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

Picture drawn() {
  const fs::path file =
      fs::temp_directory_path() / ("otter_first_triangle_" + std::to_string(getpid()) + ".png");
  REQUIRE(run("'" + file.string() + "' > /dev/null") == 0);
  Picture picture = read_png(file);
  fs::remove(file);
  REQUIRE(picture.width == 320);
  REQUIRE(picture.height == 240);
  return picture;
}

}  // namespace

TEST_SUITE("first_triangle") {
  TEST_CASE("first_triangle draws the picture that the README shows") {
    const Picture shown = read_png(OTTER_DOCS "/first_triangle.png");
    REQUIRE(shown.width == 320);
    CHECK(drawn().pixels == shown.pixels);
  }

  TEST_CASE("the corners of the picture are the colour of the fill, cut to five bits a channel") {
    const Picture picture = drawn();
    // 24, 28, 48 >> 3 are 3, 3, 6; v << 3 | v >> 2 of them 24, 24, 49.
    for (const unsigned x : {0U, 319U})
      for (const unsigned y : {0U, 239U}) CHECK(picture.at(x, y) == Rgb{24, 24, 49});
  }

  TEST_CASE("the red gem covers the blue one behind it, although it was sent first") {
    const Picture picture = drawn();
    // Their middles: 160 + 300 * -350 / 3600, 120 + 300 * 100 / 3600, and 160 + 300 * 650 / 5200, 120 - 300 *
    // 150 / 5200; whole pixels (130, 128) and (197, 111). (165, 118) lies between them, inside both.
    const auto is_red = [&](unsigned x, unsigned y) { return picture.at(x, y).r > picture.at(x, y).b; };
    CHECK(is_red(130, 128));
    CHECK(is_red(165, 118));
    CHECK_FALSE(is_red(220, 111));
  }

  TEST_CASE("a picture that cannot be written is exit 1") {
    CHECK(run("/nonexistent/folder/x.png 2> /dev/null") == 1);
  }
}
