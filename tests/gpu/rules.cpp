// The rules that all rasterizers share, and every rasterizer that has its own form of one held against it.

#include "gpu/rules.h"

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "gpu/kernels.h"
#include "ot/packet.h"

namespace {

using gpu::Blend;

constexpr std::array blends{Blend::average, Blend::add, Blend::subtract, Blend::add_quarter};

/// 32 x 32 pixels whose three channels meet in all 32 x 32 pairs, each in another order: what is there ...
constexpr std::uint16_t back_at(unsigned, unsigned y) {
  return static_cast<std::uint16_t>(y | ((y + 7) & 31) << 5 | (31 - y) << 10);
}
/// ... and what comes.
constexpr std::uint16_t front_at(unsigned x, unsigned) {
  return static_cast<std::uint16_t>(x | ((x * 5 + 13) & 31) << 5 | (31 - x) << 10);
}

using Words = std::vector<std::uint32_t>;

template <class Packet>
void add(Words& words, const Packet& packet) {
  std::array<std::uint32_t, 12> out{};
  const auto count = ot::encode(packet, out);
  words.insert(words.end(), out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count));
}

template <class PixelAt>
void upload(Words& words, std::uint16_t x, std::uint16_t y, PixelAt&& pixel_at) {
  add(words, ot::Upload{x, y, 32, 32});
  for (unsigned row = 0; row < 32; ++row) {
    for (unsigned column = 0; column < 32; column += 2) {
      words.push_back(pixel_at(column, row) | std::uint32_t{pixel_at(column + 1, row)} << 16);
    }
  }
}

ot::Rgb colour_of(std::uint16_t pixel) {
  const auto channel = [pixel](int shift) { return static_cast<std::uint8_t>((pixel >> shift & 31) << 3); };
  return {channel(0), channel(5), channel(10)};
}

/// The back at (0, 0) and, with bit 15, the front at (512, 0).
Words pictures(Blend blend) {
  Words words;
  add(words, ot::DrawArea{.right = 63, .bottom = 63});
  upload(words, 0, 0, back_at);
  upload(words, 512, 0, [](unsigned x, unsigned y) { return front_at(x, y) | 0x8000U; });
  add(words, ot::DrawMode{.texpage = ot::texpage_of(512, 0, blend, ot::TexelFormat::direct15)});
  return words;
}

/// The front drawn over the back as a sprite, as dots of one row each, and as lines.
Words sprite(Blend blend) {
  Words words = pictures(blend);
  add(words,
      ot::Rectangle{.textured = true, .semi_transparent = true, .raw = true, .width = 32, .height = 32});
  return words;
}
Words columns(Blend blend) {
  Words words = pictures(blend);
  for (std::uint16_t x = 0; x < 32; ++x) {
    add(words, ot::Rectangle{.semi_transparent = true,
                             .xy = {static_cast<std::int16_t>(x), 0},
                             .rgb = colour_of(front_at(x, 0)),
                             .width = 1,
                             .height = 32});
  }
  return words;
}
Words lines(Blend blend) {
  Words words = pictures(blend);
  for (std::int16_t x = 0; x < 32; ++x) {
    const ot::Rgb colour = colour_of(front_at(static_cast<unsigned>(x), 0));
    add(words,
        ot::Line{.semi_transparent = true, .xy = {ot::Xy{x, 0}, ot::Xy{x, 31}}, .rgb = {colour, colour}});
  }
  return words;
}

/// How many of the 1024 pixels are not what the rule says.
template <class PixelAt>
int differing(Blend blend, PixelAt&& pixel_at) {
  int count = 0;
  for (unsigned y = 0; y < 32; ++y) {
    for (unsigned x = 0; x < 32; ++x) {
      const auto expected = gpu::blend_pixel(blend, back_at(x, y), front_at(x, y));
      count += (pixel_at(x, y) & 0x7fff) != expected ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("Semi-transparency mixes a channel in four ways") {
    struct Row {
      int back, front;
      std::array<int, 4> mixed;
    };
    for (const Row& row :
         {Row{31, 30, {30, 31, 1, 31}}, Row{10, 25, {17, 31, 0, 16}}, Row{20, 20, {20, 31, 0, 25}},
          Row{5, 31, {18, 31, 0, 12}}, Row{31, 3, {17, 31, 28, 31}}, Row{0, 1, {0, 1, 0, 0}}}) {
      for (std::size_t i = 0; i < 4; ++i)
        CHECK(gpu::blend_channel(blends[i], row.back, row.front) == row.mixed[i]);
      CHECK(gpu::blend_channel(Blend::opaque, row.back, row.front) == row.front);
    }
    CHECK(gpu::blend_pixel(Blend::average, 0x7fff, 0xa108) == 0xce73);  // bit 15 is the front's
  }

  TEST_CASE("Attributes are counted from the leftmost corner; of equal ones the rule names one") {
    CHECK(gpu::core_vertex(0, 1, 2) == 0);
    CHECK(gpu::core_vertex(1, 0, 2) == 1);
    CHECK(gpu::core_vertex(2, 1, 0) == 2);
    CHECK(gpu::core_vertex(0, 0, 1) == 1);
    CHECK(gpu::core_vertex(0, 1, 0) == 0);
    CHECK(gpu::core_vertex(1, 0, 0) == 2);
    CHECK(gpu::core_vertex(0, 0, 0) == 2);
  }

  TEST_CASE("Distances of 1023 columns and 511 rows are drawn, larger ones are not") {
    CHECK_FALSE(gpu::is_too_large(1023, 511));
    CHECK(gpu::is_too_large(1024, 0));
    CHECK(gpu::is_too_large(0, 512));
  }

  TEST_CASE("On every dispatch target sprites, flat rectangles and lines mix as the rule says") {
    const std::string before(gpu::target_name());
    for (const std::string_view target : gpu::target_names()) {
      CAPTURE(target);
      REQUIRE(gpu::use_target(target));
      for (const Blend blend : blends) {
        for (const Words& words : {sprite(blend), columns(blend), lines(blend)}) {
          const auto console = std::make_unique<gpu::Gpu>();
          console->gp0(words);
          CHECK(differing(blend, [&](unsigned x, unsigned y) {
                  return console->vram().at(static_cast<int>(x), static_cast<int>(y));
                }) == 0);
        }
      }
    }
    gpu::use_target(before);
  }

  TEST_CASE("A canvas of 15 bits mixes as the rule says, one of 24 bits with 255 for 31") {
    for (const Blend blend : blends) {
      for (const bool deep : {false, true}) {
        gpu::Gpu studio;
        studio.set_canvas(
            gpu::canvas::Options{.width = 64,
                                 .height = 64,
                                 .colour = deep ? gpu::canvas::Colour::bits24 : gpu::canvas::Colour::bits15});
        studio.begin_frame();
        studio.gp0(columns(blend));
        const auto picture = studio.canvas()->layer(0);
        const auto at = [&](unsigned x, unsigned y) { return picture[std::size_t{y} * 64 + x]; };
        if (!deep) {
          CHECK(differing(blend, [&](unsigned x, unsigned y) { return gpu::canvas::to_16_bits(at(x, y)); }) ==
                0);
          continue;
        }
        // The back came from VRAM, 5 bits widened to 8 as v << 3 | v >> 2; the front was sent as v << 3.
        int wrong = 0;
        for (unsigned y = 0; y < 32; ++y) {
          for (unsigned x = 0; x < 32; ++x) {
            for (unsigned c = 0; c < 3; ++c) {
              const int back = back_at(x, y) >> 5 * c & 31, front = front_at(x, y) >> 5 * c & 31;
              const int expected = gpu::blend_channel(blend, back << 3 | back >> 2, front << 3, 255);
              wrong += (at(x, y) >> 8 * c & 255) != static_cast<unsigned>(expected) ? 1 : 0;
            }
          }
        }
        CHECK(wrong == 0);
      }
    }
  }
}
