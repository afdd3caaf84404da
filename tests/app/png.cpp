#include "display/png.h"

#include <doctest/doctest.h>
#include <png.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/write_file.h"

namespace {

namespace fs = std::filesystem;

// A fresh folder that goes away with its contents.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("otter_tests_png_" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
};

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_SUITE("display") {
  TEST_CASE("a picture comes back from its PNG as 8-bit RGB, pixel for pixel") {
    const Folder folder;
    base::Picture picture(5, 3);
    std::uint8_t value = 7;
    for (auto& pixel : picture.pixels) {
      pixel = {value, static_cast<std::uint8_t>(value * 3), static_cast<std::uint8_t>(value * 5), 255};
      value = static_cast<std::uint8_t>(value + 31);
    }
    const auto path = folder.path / "picture.png";
    REQUIRE(display::write_png(path, picture));

    const auto header = contents(path);
    REQUIRE(header.size() > 33);
    CHECK(header[24] == 8);  // IHDR: bits of a sample
    CHECK(header[25] == 2);  // IHDR: colour type 2 is RGB

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, path.c_str()) != 0);
    CHECK(image.width == 5);
    CHECK(image.height == 3);
    image.format = PNG_FORMAT_RGBA;
    std::vector<base::Rgba> read(15);
    REQUIRE(png_image_finish_read(&image, nullptr, read.data(), 0, nullptr) != 0);
    CHECK(read == picture.pixels);
  }

  TEST_CASE("a file is written whole and leaves no temporary file") {
    const Folder folder;
    REQUIRE(base::write_file(folder.path / "a", "first"));
    REQUIRE(base::write_file(folder.path / "a", "second"));
    CHECK(contents(folder.path / "a") == "second");
    CHECK(entries(folder.path) == 1);
  }

  TEST_CASE("writing through a link replaces the file it names") {
    const Folder folder;
    REQUIRE(base::write_file(folder.path / "target", "old"));
    fs::create_symlink("target", folder.path / "link");
    REQUIRE(base::write_file(folder.path / "link", "new"));
    CHECK(contents(folder.path / "target") == "new");
    CHECK(fs::is_symlink(folder.path / "link"));
  }

  TEST_CASE("a file that cannot be written is an error with exit 1 that names the path") {
    const auto written = base::write_file("/nonexistent/folder/x.png", "x");
    REQUIRE_FALSE(written);
    CHECK(written.error().exit == base::Exit::failed);
    CHECK(written.error().text == "/nonexistent/folder/x.png: cannot be written: No such file or directory");
  }

  TEST_CASE("a folder is not overwritten") {
    const Folder folder;
    const auto written = base::write_file(folder.path, "x");
    REQUIRE_FALSE(written);
    CHECK(written.error().text == folder.path.string() + ": cannot be written: Is a directory");
  }
}
