// A picture on a wall that flickers: main RAM as an emulator would save it in two frames that follow each
// other, and the map file of the program, for docs/debugging.md.
//     two_polygons FOLDER     writes even.bin, odd.bin (2 MiB each) and game.map there
//
// The program divides its depths by 64 to find the bucket, so wall and picture share one, and it goes through
// its objects forwards in one frame and backwards in the next.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/write_file.h"
#include "ot/main_ram.h"
#include "ot/ordering_table.h"
#include "ot/packet.h"

namespace {

constexpr std::uint32_t table_at = 0x10000, buckets = 64, packets_at = 0x20000;
constexpr std::uint32_t depths_a_bucket = 64;

struct Object {
  std::int16_t x, y, width, height;
  std::uint32_t depth;
  ot::Rgb colour;
};
constexpr Object objects[] = {{0, 0, 320, 240, 3000, {40, 44, 60}},       // the sky
                              {40, 40, 240, 160, 1000, {150, 130, 110}},  // a wall,
                              {110, 80, 100, 80, 990, {220, 60, 40}}};    // and a picture before it

void send(const Object& object, ot::OrderingTable& table, ot::PacketArena& packets) {
  const auto right = static_cast<std::int16_t>(object.x + object.width);
  const auto bottom = static_cast<std::int16_t>(object.y + object.height);
  ot::Polygon quad{.quad = true};
  quad.xy = {{{object.x, object.y}, {right, object.y}, {object.x, bottom}, {right, bottom}}};
  quad.rgb[0] = object.colour;
  std::array<std::uint32_t, 12> words{};
  const auto node = packets.push(std::span(words).first(ot::encode(quad, words))).value();
  table.insert(object.depth / depths_a_bucket, node);
}

/// Main RAM with the list of one frame.
ot::MainRam frame(bool forwards) {
  ot::MainRam ram(ot::RamSize::mib2);
  ot::OrderingTable table(ram, table_at, buckets);
  ot::PacketArena packets(ram, packets_at, ram.size_bytes());
  table.clear();
  std::vector<Object> order(std::begin(objects), std::end(objects));
  if (!forwards) std::ranges::reverse(order);
  for (const Object& object : order) send(object, table, packets);
  return ram;
}

base::Result<void> write_ram(const std::filesystem::path& path, const ot::MainRam& ram) {
  std::vector<std::byte> bytes;
  for (const std::uint32_t word : ram.words())
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(word >> shift & 0xff));
  return base::write_file(path, bytes);
}

std::string map_file() {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(),
                " .bss           0x%08x      0x%03x game.o\n"
                "                0x%08x                ordering_table\n",
                0x80000000U | table_at, 4 * buckets, 0x80000000U | table_at);
  return text.data();
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
  std::error_code ignored;  // what it means shows when the first file is written
  std::filesystem::create_directories(folder, ignored);
  const auto written = write_ram(folder / "even.bin", frame(true))
                           .and_then([&] { return write_ram(folder / "odd.bin", frame(false)); })
                           .and_then([&] { return base::write_file(folder / "game.map", map_file()); });
  if (!written) return std::fprintf(stderr, "two_polygons: %s\n", written.error().text.c_str()), 1;
  return std::printf("%s: even.bin, odd.bin, game.map\n", folder.c_str()) < 0;
}
