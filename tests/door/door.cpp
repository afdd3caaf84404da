// The C library as a host uses it: nothing but src/door/include/otter/otter.h.

#include <doctest/doctest.h>
#include <otter/otter.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "dump/dump.h"
#include "gpu/gpu.h"
#include "tests/gpu/random_words.h"

namespace {

using Words = std::vector<std::uint32_t>;
using Handle = std::unique_ptr<otter, decltype(&otter_destroy)>;

constexpr std::size_t vram_pixels = 1024 * 512;
const Words whole_area{0xe3000000, 0xe407ffff};

Handle fresh() {
  Handle gpu(otter_create(), &otter_destroy);
  REQUIRE(gpu);
  return gpu;
}

void send(otter* gpu, const Words& words) { REQUIRE(otter_gp0(gpu, words.data(), words.size()) == OTTER_OK); }

std::uint16_t pixel(otter* gpu, int x, int y) { return otter_vram(gpu)[y * 1024 + x]; }

std::vector<std::uint16_t> vram(otter* gpu) { return {otter_vram(gpu), otter_vram(gpu) + vram_pixels}; }

Words random_words(std::uint32_t seed, int commands) {
  tests::RandomWords random(seed);
  Words words = random.noise();
  random.state(words);
  for (int i = 0; i < commands; ++i) random.command(words);
  return words;
}

std::string knob(otter* gpu, const char* name) {
  char value[64];
  REQUIRE(otter_get(gpu, name, value, sizeof value) == OTTER_OK);
  return value;
}

struct TemporaryFile {
  std::string path;
  explicit TemporaryFile(const char* name)
      : path((std::filesystem::temp_directory_path() / (std::string("otter-door-") + name)).string()) {
    std::filesystem::remove(path);
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
  [[nodiscard]] std::vector<char> bytes() const {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

/// A table of 4 entries at 1000h, cleared, and a flat triangle with corners 0, 8 and 8 below in entry 2.
Words ram_with_a_list() {
  Words ram(0x200000 / 4);
  ram[0x1000 / 4] = 0xffffff;
  for (std::uint32_t n = 1; n < 4; ++n) ram[0x1000 / 4 + n] = 0x1000 + 4 * (n - 1);
  ram[0x1008 / 4] = 0x2000;
  const Words packet{4U << 24 | 0x1004, 0x20ffffff, 0, 8, 8 << 16};
  std::copy(packet.begin(), packet.end(), ram.begin() + 0x2000 / 4);
  return ram;
}

}  // namespace

TEST_SUITE("door") {
  TEST_CASE("Structures lie in memory as they did when libotter.so.1 was named so") {
    CHECK(sizeof(otter_list) == 7 * 4);
    CHECK(offsetof(otter_list, nodes) == 12);
    CHECK(sizeof(otter_area) == 6 * 4);
    CHECK(sizeof(otter_depth) == 4 * 8);
    CHECK(sizeof(otter_draw) == (5 + 3 * 4 + 2) * 4);
    CHECK(offsetof(otter_draw, z) == (5 + 2 * 4) * 4);
    CHECK(sizeof(otter_write) == 12);
    CHECK(offsetof(otter_write, rejected) == 11);
    CHECK(sizeof(otter_pixel_counts) == (3 * 8 + 4) * 8);
    CHECK(offsetof(otter_pixel_counts, fills) == 3 * 8 * 8);
  }

  TEST_CASE("The library's version is the header's") {
    CHECK(otter_version() == std::to_string(OTTER_VERSION_MAJOR) + "." + std::to_string(OTTER_VERSION_MINOR) +
                                 "." + std::to_string(OTTER_VERSION_PATCH));
  }

  TEST_CASE("A command that comes word by word may be cut by any other call") {
    const Words triangle{0x200000ff, 0, 8, 8 << 16};
    const auto gpu = fresh(), other = fresh();
    gpu::Gpu plain;
    send(gpu.get(), whole_area);
    plain.gp0(whole_area);
    for (std::size_t n = 0; n < 2; ++n) {
      REQUIRE(otter_gp0_word(gpu.get(), triangle[n]) == OTTER_OK);
      plain.gp0(triangle[n]);
    }
    CHECK((otter_status(gpu.get()) & 0x7fffffff) == (plain.status() & 0x7fffffff));
    // Saved in the middle, it goes on elsewhere, in bulk; and here word by word.
    std::vector<std::uint8_t> state(otter_save(gpu.get(), nullptr, 0));
    REQUIRE(otter_save(gpu.get(), state.data(), state.size()) == state.size());
    REQUIRE(otter_load(other.get(), state.data(), state.size()) == OTTER_OK);
    send(other.get(), {triangle[2], triangle[3]});
    for (std::size_t n = 2; n < 4; ++n) REQUIRE(otter_gp0_word(gpu.get(), triangle[n]) == OTTER_OK);
    CHECK(pixel(gpu.get(), 1, 1) == 0x001f);
    CHECK(vram(gpu.get()) == vram(other.get()));
    // GP1(01h) drops what has begun.
    REQUIRE(otter_gp0_word(gpu.get(), 0x02ffffff) == OTTER_OK);
    REQUIRE(otter_gp1(gpu.get(), 0x01000000) == OTTER_OK);
    for (const std::uint32_t word : {0x6000ff00U, 16U, 1U << 16 | 1U})
      REQUIRE(otter_gp0_word(gpu.get(), word) == OTTER_OK);
    CHECK(pixel(gpu.get(), 16, 0) == 0x03e0);
  }

  TEST_CASE("Words through the library draw what the GPU draws, in bulk and one by one") {
    const Words words = random_words(1, 300);
    gpu::Gpu plain;
    plain.gp0(words);
    const auto bulk = fresh(), single = fresh();
    send(bulk.get(), words);
    for (const auto word : words) otter_gp0_word(single.get(), word);
    const std::vector<std::uint16_t> expected(plain.vram().pixels().begin(), plain.vram().pixels().end());
    CHECK(vram(bulk.get()) == expected);
    CHECK(vram(single.get()) == expected);
  }

  TEST_CASE("Pixels are read back one word at a time and many at once") {
    const auto gpu = fresh();
    send(gpu.get(), {0xa0000000, 0, 4 | 1 << 16, 0x22221111, 0x44443333, 0xc0000000, 0, 4 | 1 << 16});
    CHECK((otter_status(gpu.get()) >> 27 & 1) == 1);
    CHECK(otter_read(gpu.get()) == 0x22221111);
    std::uint32_t rest = 0;
    CHECK(otter_read_many(gpu.get(), &rest, 1) == OTTER_OK);
    CHECK(rest == 0x44443333);
    CHECK((otter_status(gpu.get()) >> 27 & 1) == 0);
  }

  TEST_CASE("GPUSTAT bit 31 changes with the vertical blank") {
    const auto gpu = fresh();
    const auto before = otter_status(gpu.get()) >> 31;
    CHECK(otter_vblank(gpu.get()) == OTTER_OK);
    CHECK((otter_status(gpu.get()) >> 31) != before);
  }

  TEST_CASE("Every call with a null handle says so and does nothing") {
    std::uint32_t word = 0;
    otter_list list;
    otter_area area;
    otter_draw draw;
    otter_depth depth;
    otter_pixel_counts counts;
    char text[8];
    CHECK(otter_gp0(nullptr, &word, 1) == OTTER_NO_HANDLE);
    CHECK(std::string(otter_last_error(nullptr)) == "otter_gp0: the handle is null");
    CHECK(otter_gp0_word(nullptr, 0) == OTTER_NO_HANDLE);
    CHECK(otter_gp1(nullptr, 0) == OTTER_NO_HANDLE);
    CHECK(otter_read(nullptr) == 0);
    CHECK(otter_read_many(nullptr, &word, 1) == OTTER_NO_HANDLE);
    CHECK(otter_status(nullptr) == 0);
    CHECK(otter_vblank(nullptr) == OTTER_NO_HANDLE);
    CHECK(otter_dma_chain(nullptr, &word, 4, 0, 1, &list) == OTTER_NO_HANDLE);
    CHECK(otter_lint(nullptr, &word, 4, 0) == OTTER_NO_HANDLE);
    CHECK(otter_lint_text(nullptr, 0) == nullptr);
    CHECK(otter_vram(nullptr) == nullptr);
    CHECK(otter_display(nullptr, &area) == OTTER_NO_HANDLE);
    CHECK(otter_picture(nullptr, nullptr, 0, nullptr, nullptr) == OTTER_NO_HANDLE);
    CHECK(otter_save(nullptr, nullptr, 0) == 0);
    CHECK(otter_load(nullptr, text, sizeof text) == OTTER_NO_HANDLE);
    CHECK(otter_set(nullptr, "depth", "16") == OTTER_NO_HANDLE);
    CHECK(otter_get(nullptr, "depth", text, sizeof text) == OTTER_NO_HANDLE);
    CHECK(otter_vertex(nullptr, 0, 0, 0) == OTTER_NO_HANDLE);
    CHECK(otter_depth_found(nullptr, &depth) == OTTER_NO_HANDLE);
    CHECK(otter_record(nullptr, nullptr) == OTTER_NO_HANDLE);
    CHECK(otter_trace(nullptr, 1) == OTTER_NO_HANDLE);
    CHECK(otter_last_writer(nullptr, 0, 0, &draw) == OTTER_NO_HANDLE);
    CHECK(otter_history(nullptr, 0, 0, nullptr, 0) == OTTER_NO_HANDLE);
    CHECK(otter_draw_at(nullptr, 0, &draw) == OTTER_NO_HANDLE);
    CHECK(otter_pixels(nullptr, &counts) == OTTER_NO_HANDLE);
    otter_destroy(nullptr);
  }

  TEST_CASE("Null pointers and absurd sizes are refused with one sentence") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    std::uint32_t word = 0;
    CHECK(std::string(otter_last_error(g)).empty());
    CHECK(otter_gp0(g, nullptr, 1) == OTTER_BAD_ARGUMENT);
    CHECK(std::string(otter_last_error(g)) == "otter_gp0: the words are null, or more than memory holds");
    CHECK(otter_gp0(g, &word, SIZE_MAX) == OTTER_BAD_ARGUMENT);
    CHECK(otter_gp0(g, nullptr, 0) == OTTER_OK);
    CHECK(otter_read_many(g, nullptr, 1) == OTTER_BAD_ARGUMENT);
    CHECK(otter_dma_chain(g, nullptr, 4, 0, 1, nullptr) == OTTER_BAD_ARGUMENT);
    for (const std::size_t bytes :
         {std::size_t{0}, std::size_t{3}, std::size_t{12}, std::size_t{16} << 20, SIZE_MAX})
      CHECK(otter_dma_chain(g, &word, bytes, 0, 1, nullptr) == OTTER_BAD_ARGUMENT);
    CHECK(otter_display(g, nullptr) == OTTER_BAD_ARGUMENT);
    CHECK(otter_load(g, nullptr, 8) == OTTER_BAD_ARGUMENT);
    CHECK(otter_set(g, nullptr, "16") == OTTER_BAD_ARGUMENT);
    CHECK(otter_get(g, "depth", nullptr, 0) == OTTER_BAD_ARGUMENT);
    CHECK(otter_record(g, "") == OTTER_BAD_ARGUMENT);
    CHECK(otter_trace(g, 3) == OTTER_BAD_ARGUMENT);
    CHECK(otter_history(g, 1024, 0, nullptr, 0) == OTTER_BAD_ARGUMENT);
    CHECK(otter_history(g, -1, 0, nullptr, 0) == OTTER_BAD_ARGUMENT);
    CHECK(otter_pixels(g, nullptr) == OTTER_BAD_ARGUMENT);
  }

  TEST_CASE("A list is drawn, and its table found") {
    const auto gpu = fresh();
    send(gpu.get(), whole_area);
    const Words ram = ram_with_a_list();
    otter_list list;
    REQUIRE(otter_dma_chain(gpu.get(), ram.data(), 4 * ram.size(), 0x100c, 100, &list) == OTTER_OK);
    CHECK(list.end == OTTER_LIST_DONE);
    CHECK(list.nodes == 5);
    CHECK(list.words == 4);
    CHECK(list.tables == 1);
    CHECK(list.buckets == 4);
    CHECK(pixel(gpu.get(), 1, 1) == 0x7fff);
  }

  TEST_CASE("A list that loops or leaves RAM is drawn up to its fault, which is told") {
    const auto gpu = fresh();
    send(gpu.get(), whole_area);
    Words ram = ram_with_a_list();
    ram[0x1000 / 4] = 0x100c;
    otter_list list;
    REQUIRE(otter_dma_chain(gpu.get(), ram.data(), 4 * ram.size(), 0x100c, 100, &list) == OTTER_OK);
    CHECK(list.end == OTTER_LIST_LOOP);
    CHECK(list.bad_tag == 0x100c);
    CHECK(list.linked_from == 0x1000);
    CHECK(pixel(gpu.get(), 1, 1) == 0x7fff);
    CHECK(std::string(otter_last_error(gpu.get())) ==
          "otter_dma_chain: tag 00100Ch is linked again from tag 001000h (a loop)");
    ram[0x1000 / 4] = 0x900000;
    REQUIRE(otter_dma_chain(gpu.get(), ram.data(), 4 * ram.size(), 0x100c, 100, &list) == OTTER_OK);
    CHECK(list.end == OTTER_LIST_OUTSIDE_RAM);
    REQUIRE(otter_dma_chain(gpu.get(), ram.data(), 4 * ram.size(), 0x100c, 2, &list) == OTTER_OK);
    CHECK(list.end == OTTER_LIST_TOO_LONG);
    CHECK(list.nodes == 2);
  }

  TEST_CASE("Lint tells a packet that is linked twice, and nothing of a good list") {
    const auto gpu = fresh();
    Words ram = ram_with_a_list();
    CHECK(otter_lint(gpu.get(), ram.data(), 4 * ram.size(), 0x100c) == 0);
    ram[0x1000 / 4] = 0x2000;
    const int findings = otter_lint(gpu.get(), ram.data(), 4 * ram.size(), 0x100c);
    REQUIRE(findings > 0);
    bool is_told = false;
    for (int n = 0; n < findings; ++n)
      is_told = is_told || std::string(otter_lint_text(gpu.get(), n)).find("linked-twice 002000h: ") == 0;
    CHECK(is_told);
    CHECK(otter_lint_text(gpu.get(), findings) == nullptr);
    CHECK(pixel(gpu.get(), 1, 1) == 0);
  }

  TEST_CASE("The picture is the display area in RGBA") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    for (const std::uint32_t word : {0x03000000U, 0x05000000U | 16, 0x08000001U}) otter_gp1(g, word);
    otter_vram(g)[16] = 31;
    int width = 0, height = 0;
    REQUIRE(otter_picture(g, nullptr, 0, &width, &height) == OTTER_OK);
    CHECK(width == 320);
    CHECK(height == 240);
    std::vector<std::uint8_t> rgba(320 * 240 * 4);
    CHECK(otter_picture(g, rgba.data(), rgba.size() - 1, nullptr, nullptr) == OTTER_BAD_ARGUMENT);
    CHECK(std::string(otter_last_error(g)) == "otter_picture: room for 307199 bytes, expected 307200");
    REQUIRE(otter_picture(g, rgba.data(), rgba.size(), nullptr, nullptr) == OTTER_OK);
    CHECK(std::vector<std::uint8_t>(rgba.begin(), rgba.begin() + 8) ==
          std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 0, 255});
    otter_area area;
    REQUIRE(otter_display(g, &area) == OTTER_OK);
    CHECK(area.x == 16);
    CHECK(area.is_off == 0);
  }

  TEST_CASE("A state saved in the middle of a command goes on in another handle") {
    const Words words = random_words(2, 60);
    const auto a = fresh(), b = fresh();
    const auto half = static_cast<std::ptrdiff_t>(words.size() - 150);
    send(a.get(), {words.begin(), words.begin() + half});
    const std::size_t size = otter_save(a.get(), nullptr, 0);
    std::vector<char> state(size);
    REQUIRE(otter_save(a.get(), state.data(), size) == size);
    REQUIRE(otter_load(b.get(), state.data(), size) == OTTER_OK);
    for (otter* gpu : {a.get(), b.get()}) send(gpu, {words.begin() + half, words.end()});
    CHECK(vram(a.get()) == vram(b.get()));
    CHECK(otter_status(a.get()) == otter_status(b.get()));
    CHECK(otter_load(b.get(), state.data(), size - 1) == OTTER_BAD_DATA);
    CHECK(std::string(otter_last_error(b.get())).find("otter_load: byte ") == 0);
    CHECK(vram(a.get()) == vram(b.get()));
  }

  TEST_CASE("Knobs are named and listed; what a stream cannot honour is refused") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    CHECK(knob(g, "visibility") == "ot");
    CHECK(otter_set(g, "visibility", "zbuffer") == OTTER_OK);
    CHECK(knob(g, "visibility") == "zbuffer");
    CHECK(otter_set(g, "visibility", "bsp") == OTTER_BAD_VALUE);
    CHECK(std::string(otter_last_error(g)) == "otter_set: visibility bsp: expected ot|zbuffer");
    CHECK(otter_set(g, "buckets", "16") == OTTER_UNKNOWN_KNOB);
    CHECK(otter_set(g, "near", "1e9") == OTTER_BAD_VALUE);
    CHECK(knob(g, "near") == "16");
    char small[3];
    REQUIRE(otter_get(g, "visibility", small, sizeof small) == OTTER_OK);
    CHECK(std::string(small) == "zb");
    int count = 0;
    for (; otter_knob_name(count) != nullptr; ++count) {
      CHECK(otter_knob_values(count) != nullptr);
      CHECK(std::string(otter_knob_help(count)).size() > 5);
      CHECK_FALSE(knob(g, otter_knob_name(count)).empty());
    }
    CHECK(count == 15);
    CHECK(otter_knob_name(-1) == nullptr);
  }

  TEST_CASE("With vertices told, a z-buffer hides what is behind, whichever is drawn last") {
    const Words near{0x200000ff, 0, 40, 40 << 16}, far{0x2000ff00, 1 | 1 << 16, 41 | 1 << 16, 1 | 41 << 16};
    const auto gpu = fresh();
    otter* g = gpu.get();
    REQUIRE(otter_set(g, "visibility", "zbuffer") == OTTER_OK);
    send(g, whole_area);
    for (const std::size_t v : {1U, 2U, 3U}) {
      otter_vertex(g, near[v], 100 << 12, 0);
      otter_vertex(g, far[v], 200 << 12, 0);
    }
    send(g, near);
    send(g, far);
    CHECK(pixel(g, 5, 5) == 31);
    otter_depth found;
    REQUIRE(otter_depth_found(g, &found) == OTTER_OK);
    CHECK(found.polygons == 2);
    CHECK(found.with_depth == 2);
    CHECK(found.partly == 0);
    CHECK(found.doubtful == 0);
  }

  TEST_CASE("A polygon with a vertex that nobody told has no depth; two on one pixel are doubtful") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    send(g, whole_area);
    for (const std::uint32_t xy : {0U, 8U, 8U << 16}) otter_vertex(g, xy, 100 << 12, 0);
    send(g, {0x20ffffff, 0, 8, 9 << 16});
    otter_vertex(g, 8, 300 << 12, 0);
    send(g, {0x20ffffff, 0, 8, 8 << 16});
    otter_depth found;
    REQUIRE(otter_depth_found(g, &found) == OTTER_OK);
    CHECK(found.polygons == 2);
    CHECK(found.with_depth == 1);
    CHECK(found.partly == 1);
    CHECK(found.doubtful == 1);
  }

  TEST_CASE("Depth changes nothing in the console's own picture, however the words are cut") {
    const Words words = random_words(3, 200);
    const auto plain = fresh(), told = fresh();
    send(plain.get(), words);
    tests::RandomWords random(4);
    for (std::uint32_t xy = 0; xy < 600; ++xy) otter_vertex(told.get(), random.vertex(400), 1 << 20, 0);
    for (std::size_t at = 0; at < words.size();) {
      const auto count = std::min<std::size_t>(1 + random.below(7), words.size() - at);
      REQUIRE(otter_gp0(told.get(), words.data() + at, count) == OTTER_OK);
      if (random.below(5) == 0) (void)otter_status(told.get());
      at += count;
    }
    (void)otter_status(told.get());
    CHECK(vram(plain.get()) == vram(told.get()));
  }

  TEST_CASE("A recording replays to the same VRAM, from the state in which it began") {
    const Words words = random_words(5, 80);
    const TemporaryFile file("live.psxgpu");
    const auto gpu = fresh();
    otter* g = gpu.get();
    const auto cut = static_cast<std::ptrdiff_t>(words.size() - 300);
    send(g, {words.begin(), words.begin() + cut});
    otter_gp1(g, 0x08000001);
    REQUIRE(otter_record(g, file.path.c_str()) == OTTER_OK);
    send(g, {words.begin() + cut, words.end()});
    otter_vblank(g);
    send(g, {0x01000000, 0xc0000000, 0, 2 | 1 << 16});
    (void)otter_read(g);
    REQUIRE(otter_record(g, nullptr) == OTTER_OK);
    const auto bytes = file.bytes();
    const auto recorded = dump::parse_dump(std::as_bytes(std::span(bytes)));
    REQUIRE_MESSAGE(recorded, recorded.message);
    CHECK(recorded.value->vsyncs == 1);
    gpu::Gpu replayed;
    dump::replay(*recorded.value, replayed);
    const auto pixels = replayed.vram().pixels();
    CHECK(vram(g) == std::vector<std::uint16_t>(pixels.begin(), pixels.end()));
    CHECK(replayed.status() == otter_status(g));
    CHECK(otter_record(g, nullptr) == OTTER_NOT_AVAILABLE);
  }

  TEST_CASE("A recording into a folder that is not there says so, and leaves nothing") {
    const auto gpu = fresh();
    REQUIRE(otter_record(gpu.get(), "/nowhere/at/all.psxgpu") == OTTER_OK);
    CHECK(otter_record(gpu.get(), nullptr) == OTTER_NOT_WRITTEN);
    CHECK(std::string(otter_last_error(gpu.get())).find("/nowhere/at/all.psxgpu") != std::string::npos);
  }

  TEST_CASE("The trace names the last writer of a pixel, its bucket, and the writes before") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    send(g, whole_area);
    otter_draw draw;
    CHECK(otter_last_writer(g, 1, 1, &draw) == OTTER_NOT_AVAILABLE);
    REQUIRE(otter_trace(g, OTTER_TRACE_HISTORY) == OTTER_OK);
    send(g, {0x600000ff, 0, 16 | 16 << 16});
    const Words ram = ram_with_a_list();
    otter_dma_chain(g, ram.data(), 4 * ram.size(), 0x100c, 100, nullptr);
    REQUIRE(otter_last_writer(g, 1, 1, &draw) == OTTER_OK);
    CHECK(draw.kind == OTTER_POLYGON);
    CHECK(draw.command == 0x20ffffff);
    CHECK(draw.bucket == 2);
    CHECK(draw.vertices == 3);
    CHECK(draw.x[1] == 8);
    REQUIRE(otter_last_writer(g, 12, 12, &draw) == OTTER_OK);
    CHECK(draw.kind == OTTER_RECTANGLE);
    CHECK(draw.bucket == 0xffffffff);
    std::array<otter_write, 4> writes{};
    REQUIRE(otter_history(g, 1, 1, writes.data(), writes.size()) == 2);
    CHECK(writes[0].after == 31);
    CHECK(writes[1].before == 31);
    CHECK(writes[1].after == 0x7fff);
    CHECK(writes[1].draw == 1);
    REQUIRE(otter_draw_at(g, 1, &draw) == OTTER_OK);
    CHECK(draw.kind == OTTER_POLYGON);
    CHECK(otter_draw_at(g, 2, &draw) == OTTER_NOT_AVAILABLE);
    CHECK(otter_last_writer(g, 100, 100, &draw) == OTTER_NOT_AVAILABLE);
  }

  TEST_CASE("Pixels are counted from the first question on") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    send(g, whole_area);
    otter_pixel_counts counts;
    send(g, {0x600000ff, 0, 16 | 16 << 16});
    REQUIRE(otter_pixels(g, &counts) == OTTER_OK);
    CHECK(counts.rectangles[0] == 0);
    send(g, {0x620000ff, 0, 16 | 16 << 16});
    REQUIRE(otter_pixels(g, &counts) == OTTER_OK);
    CHECK(counts.rectangles[4] == 256);
    REQUIRE(otter_pixels(g, &counts) == OTTER_OK);
    CHECK(counts.rectangles[4] == 0);
  }

  TEST_CASE("At twice the resolution the picture is twice as large and follows the buffers of the program") {
    const auto gpu = fresh();
    otter* g = gpu.get();
    REQUIRE(otter_set(g, "resolution", "2") == OTTER_OK);
    for (const std::uint32_t word : {0x03000000U, 0x08000001U, 0x05000000U | 240 << 10}) otter_gp1(g, word);
    // Drawn into the upper buffer while the lower one is shown.
    send(g, {0xe3000000, 0xe4000000 | 319 | 239 << 10, 0x600000ff, 10 | 10 << 16, 16 | 16 << 16});
    otter_vblank(g);
    otter_gp1(g, 0x05000000);
    send(g, {0xe3000000 | 240 << 10, 0xe4000000 | 319 | 479 << 10, 0xe5000000 | 240 << 11});
    int width = 0, height = 0;
    REQUIRE(otter_picture(g, nullptr, 0, &width, &height) == OTTER_OK);
    CHECK(width == 640);
    CHECK(height == 480);
    std::vector<std::uint8_t> rgba(640 * 480 * 4);
    REQUIRE(otter_picture(g, rgba.data(), rgba.size(), nullptr, nullptr) == OTTER_OK);
    CHECK(rgba[(20 * 640 + 20) * 4] == 255);
    CHECK(rgba[(19 * 640 + 20) * 4] == 0);
    CHECK(rgba[(51 * 640 + 51) * 4] == 255);
    CHECK(rgba[(52 * 640 + 52) * 4] == 0);
  }

  TEST_CASE("Handles in different threads do not disturb each other") {
    const Words words = random_words(6, 100);
    const auto a = fresh(), b = fresh();
    std::thread other([&] { otter_gp0(b.get(), words.data(), words.size()); });
    send(a.get(), words);
    other.join();
    CHECK(vram(a.get()) == vram(b.get()));
  }
}
