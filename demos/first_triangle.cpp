// The whole line that a triangle takes, on one screen and without a Scene: registers, RTPT, NCLIP, AVSZ3,
// packet, ordering table, walk, GPU, PNG.
//     cmake --build --preset release --target first_triangle && build/release/bin/first_triangle [FILE.png]

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <span>
#include <utility>

#include "display/png.h"
#include "display/scanout.h"
#include "gpu/gpu.h"
#include "gte/commands.h"
#include "ot/main_ram.h"
#include "ot/ordering_table.h"
#include "ot/packet.h"
#include "ot/walker.h"

namespace {

// An octahedron: a corner and a colour at either end of each axis.
constexpr std::int16_t radius = 1000;
constexpr gte::Vertex corners[] = {{radius},  {0, radius},  {0, 0, radius},
                                   {-radius}, {0, -radius}, {0, 0, -radius}};
constexpr ot::Rgb red_gem[] = {{230, 60, 40}, {120, 20, 50},   {250, 150, 60},
                               {90, 20, 40},  {255, 220, 150}, {210, 40, 60}};
constexpr ot::Rgb blue_gem[] = {{50, 160, 220}, {30, 40, 120},   {60, 220, 200},
                                {20, 40, 90},   {190, 240, 255}, {40, 90, 210}};

struct Gem {
  std::array<std::int32_t, 3> place;  // of its middle, before the eye: x right, y down, z ahead
  std::span<const ot::Rgb> colours;
};
constexpr Gem gems[] = {{{-350, 100, 3600}, red_gem},
                        {{650, -150, 5200}, blue_gem}};  // the near one is sent first

constexpr std::uint32_t table_at = 0x1000, buckets = 256, packets_at = 0x2000;  // byte addresses in main RAM

template <class Packet>
std::span<const std::uint32_t> words_of(const Packet& packet, std::array<std::uint32_t, 12>& room) {
  return std::span(room).first(ot::encode(packet, room));
}

}  // namespace

int main(int argc, char** argv) {
  const char* const path = argc > 1 ? argv[1] : "first_triangle.png";
  std::array<std::uint32_t, 12> room;
  ot::MainRam ram(ot::RamSize::mib2);
  ot::OrderingTable table(ram, table_at, buckets);
  ot::PacketArena packets(ram, packets_at, ram.size_bytes());
  table.clear();

  // The coprocessor's registers: a turned and tilted model, a wide lens, the middle of the screen, and a
  // scale that maps depths 0..8191 to the buckets.
  gte::Registers r;
  using gte::S3_12;
  r.rt = {{{S3_12::of(0.819), S3_12::of(0), S3_12::of(0.574)},
           {S3_12::of(0.196), S3_12::of(0.940), S3_12::of(-0.280)},
           {S3_12::of(-0.539), S3_12::of(0.342), S3_12::of(0.770)}}};
  r.h = 300;
  r.ofx = gte::S15_16::of(160);
  r.ofy = gte::S15_16::of(120);
  r.zsf3 = S3_12::of(buckets / (3 * 8192.0));

  for (const Gem& gem : gems) {
    r.tr = gem.place;
    for (std::size_t face = 0; face < 8; ++face) {
      // One corner of each axis; where an odd number of them is a negative one, two change places.
      std::size_t c[] = {(face & 1) * 3, 1 + (face >> 1 & 1) * 3, 2 + (face >> 2) * 3};
      if (std::popcount(face) % 2 != 0) std::swap(c[1], c[2]);
      r.v = {corners[c[0]], corners[c[1]], corners[c[2]]};
      gte::rtpt(r);                                    // three screen positions, three depths
      if ((r.flag & gte::flag::error) != 0) continue;  // something did not fit: behind the eye, or huge
      gte::nclip(r);                                   // twice the area; negative seen from behind
      if (r.mac[0] <= 0) continue;
      gte::avsz3(r);  // the average depth is the bucket
      ot::Polygon triangle{.gouraud = true};
      for (std::size_t i = 0; i < 3; ++i) {
        triangle.xy[i] = {r.sxy[i].x, r.sxy[i].y};
        triangle.rgb[i] = gem.colours[c[i]];
      }
      const auto node = packets.push(words_of(triangle, room)).value();  // a tag and six GP0 words in RAM
      table.insert(std::min<std::uint32_t>(r.otz, buckets - 1), node);
    }
  }

  gpu::Gpu gpu;
  gpu.gp0(words_of(ot::DrawArea{.right = 319, .bottom = 239}, room));
  gpu.gp0(words_of(ot::DrawMode{.dither = true}, room));
  gpu.gp0(words_of(ot::Fill{.rgb = {24, 28, 48}, .width = 320, .height = 240}, room));
  // Far to near, whatever the order in which they were sent.
  const auto walked = ot::walk(
      ram, table.head(), [&](std::uint32_t, std::span<const std::uint32_t> payload) { gpu.gp0(payload); });
  if (!walked) return std::fprintf(stderr, "first_triangle: %s\n", walked.message().c_str()), 1;
  const auto written =
      display::write_png(path, display::scan_out(gpu.vram().pixels(), {.width = 320, .height = 240}));
  if (!written) return std::fprintf(stderr, "first_triangle: %s\n", written.error().text.c_str()), 1;
  return std::printf("%s: %u GP0 words from %u tags\n", path, walked.words, walked.nodes) < 0;
}
