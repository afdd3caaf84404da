// Captures of the console, and random commands on which independent exact renderers agree.

#include <png.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dump/dump.h"
#include "gpu/gpu.h"
#include "tests/vectors.h"

namespace {

/// 1024 x 512 RGB, or nothing if the picture has another size.
std::vector<png_byte> read_rgb(const std::filesystem::path& path) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  if (image.width != 1024 || image.height != 512) pixels.clear();
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return {};
  return pixels;
}

std::vector<char> read_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void replay(const std::filesystem::path& path, gpu::Gpu& gpu) {
  const std::vector<char> bytes = read_bytes(path);
  const auto dump = dump::parse_dump(std::as_bytes(std::span(bytes)));
  REQUIRE_MESSAGE(dump.value.has_value(), dump.message);
  dump::replay(*dump.value, gpu);
}

struct Difference {
  std::size_t compared = 0, differing = 0, first = 0;
};

Difference compare(const gpu::Vram& vram, const std::vector<png_byte>& expected,
                   const std::vector<png_byte>& mask) {
  Difference result;
  for (std::size_t i = 0; i < gpu::Vram::size; ++i) {
    if (mask[3 * i] == 0) continue;
    ++result.compared;
    const unsigned pixel = vram.pixels()[i];
    bool same = true;
    for (std::size_t c = 0; c < 3; ++c) same &= (pixel >> 5 * c & 31) == expected[3 * i + c] >> 3;
    if (!same && result.differing++ == 0) result.first = i;
  }
  return result;
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("Every hardware test replays to the console's VRAM inside its mask") {
    const auto folder = tests::vector_path("gpu");
    if (!folder) return;
    int dumps = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
      const std::string name = entry.path().stem().string();
      if (entry.path().extension() != ".psxgpu" || !name.starts_with("hw-")) continue;
      CAPTURE(name);
      const auto expected = read_rgb(*folder / (name + ".png"));
      const auto mask = read_rgb(*folder / (name + ".mask.png"));
      REQUIRE_FALSE(expected.empty());
      REQUIRE_FALSE(mask.empty());
      gpu::Gpu gpu;
      replay(entry.path(), gpu);
      const Difference difference = compare(gpu.vram(), expected, mask);
      CAPTURE(difference.first % 1024);
      CAPTURE(difference.first / 1024);
      CHECK(difference.compared > 0);
      CHECK(difference.differing == 0);
      ++dumps;
    }
    CHECK(dumps > 0);
  }

  TEST_CASE("Random commands over noise replay to the exact VRAM in all 16 bits") {
    const auto folder = tests::vector_path("gpu");
    if (!folder) return;
    int dumps = 0;
    for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
      const std::string name = entry.path().stem().string();
      if (entry.path().extension() != ".psxgpu" || !name.starts_with("random-")) continue;
      CAPTURE(name);
      const auto expected = read_bytes(*folder / (name + ".vram"));
      REQUIRE(expected.size() == gpu::Vram::size * 2);
      const auto gpu = std::make_unique<gpu::Gpu>();
      replay(entry.path(), *gpu);
      std::size_t differing = 0, first = 0;
      for (std::size_t i = 0; i < gpu::Vram::size; ++i) {
        std::uint16_t pixel = 0;
        std::memcpy(&pixel, &expected[2 * i], 2);
        if (pixel != gpu->vram().pixels()[i] && differing++ == 0) first = i;
      }
      CAPTURE(first % 1024);
      CAPTURE(first / 1024);
      CHECK(differing == 0);
      ++dumps;
    }
    CHECK(dumps > 0);
  }
}
