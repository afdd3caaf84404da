// Pixels per second of every kind of primitive: random places in 320 x 240, the whole GP0
// stream replayed, one thread. Absolute figures wander with the machine; the fraction of the
// fill rate of the same run does not.
//
//     bench_gpu [--target AVX2] [--rounds N]

#include "gpu/gpu.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "gpu/kernels.h"

namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::array edges{8, 32, 128};
constexpr int primitives = 2000;

struct Shape {
  Words words;
  int pixels = 0;
};

struct Row {
  const char* name;
  std::array<int, 3> target;  ///< Mpixel/s at 8, 32, 128; 0: none
  std::uint32_t mode;         ///< E1h before the first
  Shape (*make)(std::mt19937&, int edge);
};

std::uint32_t at(std::uint32_t x, std::uint32_t y) { return x | y << 16; }
std::uint32_t below(std::mt19937& random, std::uint32_t n) {
  return static_cast<std::uint32_t>(random() % n);
}
std::uint32_t colour(std::mt19937& random) { return static_cast<std::uint32_t>(random()) & 0xffffff; }

constexpr std::uint32_t clut = 0x7d00;  // at (0, 500)

/// A right triangle with equal legs, textures mapped 1:1 from a page at (640, 0).
Shape triangle(std::mt19937& random, int edge, std::uint32_t opcode, std::uint32_t page) {
  const auto n = static_cast<std::uint32_t>(edge);
  const std::uint32_t x = below(random, 320 - n), y = below(random, 240 - n);
  const std::uint32_t u = below(random, 256 - n), v = below(random, 256 - n);
  const bool gouraud = (opcode & 16) != 0, textured = (opcode & 4) != 0;
  const std::array places{at(x, y), at(x + n, y), at(x, y + n)};
  const std::array texels{u | v << 8 | clut << 16, (u + n) | v << 8 | (10 | page) << 16, u | (v + n) << 8};
  Shape shape;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 0) {
      shape.words.push_back(opcode << 24 | colour(random));
    } else if (gouraud) {
      shape.words.push_back(colour(random));
    }
    shape.words.push_back(places[i]);
    if (textured) shape.words.push_back(texels[i]);
  }
  shape.pixels = edge * (edge + 1) / 2;
  return shape;
}

/// The same with the texture turned by an angle, so that no two texels of a row lie side by side.
Shape turned(std::mt19937& random, int edge, std::uint32_t opcode, std::uint32_t page) {
  Shape shape = triangle(random, edge, opcode, page);
  const auto n = static_cast<std::uint32_t>(edge);
  const std::size_t step = (opcode & 16) != 0 ? 3 : 2;
  const std::uint32_t u = below(random, 120), v = 128;
  const std::array texels{u | v << 8, (u + n * 4 / 5) | (v - n * 3 / 5) << 8,
                          (u + n * 3 / 5) | (v + n * 4 / 5) << 8};
  for (std::size_t i = 0; i < 3; ++i) {
    std::uint32_t& word = shape.words[2 + i * step];
    word = (word & 0xffff0000) | (texels[i] & 0xffff);
  }
  return shape;
}

Shape rectangle(std::mt19937& random, int edge, std::uint32_t opcode) {
  const auto n = static_cast<std::uint32_t>(edge);
  Shape shape{{opcode << 24 | colour(random), at(below(random, 320 - n), below(random, 240 - n))},
              edge * edge};
  if ((opcode & 4) != 0) {
    shape.words.push_back(below(random, 256 - n) | below(random, 256 - n) << 8 | clut << 16);
  }
  shape.words.push_back(at(n, n));
  return shape;
}

Shape line(std::mt19937& random, int edge) {
  const auto n = static_cast<std::uint32_t>(edge - 1);
  const std::uint32_t x = below(random, 320 - n), y = below(random, 240 - n), other = below(random, n + 1);
  const bool steep = below(random, 2) != 0;
  return {{0x50000000 | colour(random), at(x, y), colour(random),
           steep ? at(x + other, y + n) : at(x + n, y + other)},
          edge};
}

constexpr std::uint32_t four_bit = 0 << 7, fifteen_bit = 2 << 7;

const std::array<Row, 13> rows{{
    {"triangle flat", {600, 3000, 8000}, 0, [](auto& r, int n) { return triangle(r, n, 0x20, 0); }},
    {"triangle Gouraud, dithered",
     {400, 1500, 2500},
     0x200,
     [](auto& r, int n) { return triangle(r, n, 0x30, 0); }},
    {"triangle 4-bit CLUT, modulated",
     {300, 900, 1300},
     0,
     [](auto& r, int n) { return triangle(r, n, 0x24, four_bit); }},
    {"triangle 15-bit raw",
     {350, 1200, 1800},
     0,
     [](auto& r, int n) { return triangle(r, n, 0x25, fifteen_bit); }},
    {"triangle 4-bit, Gouraud, semi-transparent",
     {250, 600, 900},
     0,
     [](auto& r, int n) { return triangle(r, n, 0x36, four_bit); }},
    {"rectangle flat", {2800, 6000, 13000}, 0, [](auto& r, int n) { return rectangle(r, n, 0x60); }},
    {"sprite 4-bit raw", {1000, 2400, 3000}, 10, [](auto& r, int n) { return rectangle(r, n, 0x65); }},
    {"fill",
     {7837, 8649, 14692},
     0,
     [](auto& r, int edge) {
       const auto n = static_cast<std::uint32_t>(edge);
       // Cut to blocks of 16 columns: what is counted is what is written.
       return Shape{{0x02000000 | colour(r), at(below(r, 320 - n), below(r, 240 - n)), at(n, n)},
                    (edge + 15) / 16 * 16 * edge};
     }},
    {"VRAM copy",
     {2034, 5559, 13129},
     0,
     [](auto& r, int edge) {
       const auto n = static_cast<std::uint32_t>(edge);
       return Shape{{0x80000000, at(below(r, 320 - n), below(r, 240 - n)),
                     at(below(r, 320 - n), below(r, 240 - n)), at(n, n)},
                    edge * edge};
     }},
    {"line Gouraud, dithered", {200, 350, 400}, 0x200, [](auto& r, int n) { return line(r, n); }},
    {"triangle 4-bit modulated, turned",
     {0, 0, 0},
     0,
     [](auto& r, int n) { return turned(r, n, 0x24, four_bit); }},
    {"triangle 15-bit raw, turned",
     {0, 0, 0},
     0,
     [](auto& r, int n) { return turned(r, n, 0x25, fifteen_bit); }},
    {"triangle 4-bit, Gouraud, semi-tr., turned",
     {0, 0, 0},
     0,
     [](auto& r, int n) { return turned(r, n, 0x36, four_bit); }},
}};
constexpr std::size_t fill_row = 7;

/// Noise in the textures, a palette without transparent entries.
void prepare(gpu::Gpu& gpu) {
  std::mt19937 random(1);
  for (std::uint16_t& pixel : gpu.vram().pixels()) pixel = static_cast<std::uint16_t>(random() | 1);
  gpu.gp0(Words{0xe3000000, 0xe4000000 | 319 | 239 << 10, 0xe5000000});
}

struct Case {
  Words words;
  double pixels = 0, best = 1e30;  ///< best: seconds of one replay

  void run(gpu::Gpu& gpu) {
    const auto before = std::chrono::steady_clock::now();
    gpu.gp0(words);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  [[nodiscard]] double rate() const { return pixels / best * 1e-6; }
};

Case make(const Row& row, int edge) {
  std::mt19937 random(static_cast<std::uint32_t>(edge));
  Case result;
  result.words.push_back(0xe1000000 | row.mode);
  for (int i = 0; i < primitives; ++i) {
    const Shape shape = row.make(random, edge);
    result.words.insert(result.words.end(), shape.words.begin(), shape.words.end());
    result.pixels += shape.pixels;
  }
  return result;
}

using Table = std::array<std::array<Case, edges.size()>, rows.size()>;

/// All cases in turn, again and again: what disturbs the machine for a while disturbs all alike.
Table measure(gpu::Gpu& gpu, int rounds) {
  Table table;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    for (std::size_t e = 0; e < edges.size(); ++e) table[r][e] = make(rows[r], edges[e]);
  }
  for (int round = 0; round < rounds; ++round) {
    for (auto& row : table) {
      for (Case& one : row) one.run(gpu);
    }
  }
  return table;
}

void print(const Table& table) {
  const double fill = table[fill_row][2].rate();
  std::printf("%-42s %26s %26s %20s\n", "kind", "Mpixel/s at 8 / 32 / 128", "of own 128x128 fill", "target");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto& c = table[r];
    std::printf("%-42s %8.0f %8.0f %8.0f %8.3f %8.3f %8.3f  ", rows[r].name, c[0].rate(), c[1].rate(),
                c[2].rate(), c[0].rate() / fill, c[1].rate() / fill, c[2].rate() / fill);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const int target = rows[r].target[e];
      if (target != 0) std::printf(" %5d%c", target, c[e].rate() >= target ? '+' : '-');
    }
    std::printf("\n");
  }
}

/// Gouraud triangles through the z-buffer, against the same without one.
double depth_ratio(gpu::Gpu& gpu, const gpu::DepthOptions& options, int edge, int rounds) {
  std::mt19937 random(5);
  Case plain, deep;
  for (int i = 0; i < primitives; ++i) {
    const Shape shape = triangle(random, edge, 0x30, 0);
    plain.words.insert(plain.words.end(), shape.words.begin(), shape.words.end());
    for (std::uint32_t v = 0; v < 3; ++v) {
      const std::uint32_t z = (100 + below(random, 4000)) << 12;
      if (v == 0) deep.words.push_back(0xe7000000);
      deep.words.push_back((0xe8 + v) << 24 | (z & 0xffffff));
    }
    deep.words.insert(deep.words.end(), shape.words.begin(), shape.words.end());
  }
  plain.words.insert(plain.words.begin(), 0xe1000200);
  deep.words.insert(deep.words.begin(), 0xe1000200);
  for (int round = 0; round < rounds; ++round) {
    plain.run(gpu);
    gpu.set_depth(options);
    gpu.begin_frame();
    deep.run(gpu);
    gpu.set_depth(std::nullopt);
  }
  return deep.best / plain.best;
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 15;
  for (int i = 1; i < argc; ++i) {
    const char* value = i + 1 < argc ? argv[i + 1] : "";
    if (std::strcmp(argv[i], "--rounds") == 0)
      rounds = std::max(1, std::atoi(value)), ++i;
    else if (std::strcmp(argv[i], "--target") == 0 && gpu::use_target(value))
      ++i;
    else
      return std::fprintf(stderr, "bench_gpu: unknown option or target: %s %s\n", argv[i], value), 2;
  }
  gpu::Gpu gpu;
  prepare(gpu);
  const std::string best(gpu::target_name());
  std::printf("dispatch target %s\n", best.c_str());
  const Table vectors = measure(gpu, rounds);
  print(vectors);

  std::printf("\nz-buffer over OT, Gouraud triangles of 8 / 32 / 128 px (target at 32 px: 1.30):\n");
  using gpu::DepthFormat, gpu::DepthMapping;
  constexpr std::array formats{"16", "24", "32", "float"};
  for (const auto mapping : {DepthMapping::hyperbolic, DepthMapping::linear}) {
    for (std::size_t f = 0; f < formats.size(); ++f) {
      const gpu::DepthOptions options{.format = static_cast<DepthFormat>(f), .mapping = mapping};
      std::printf("  %-10s %-6s", mapping == DepthMapping::linear ? "linear" : "hyperbolic", formats[f]);
      for (const int edge : edges) std::printf(" %.2f", depth_ratio(gpu, options, edge, rounds));
      std::printf("\n");
    }
  }

  gpu::use_target(gpu::target_names().back());
  const Table scalar = measure(gpu, std::max(1, rounds / 5));
  std::printf("\n%s over %s at 8 / 32 / 128:\n", best.c_str(), std::string(gpu::target_name()).c_str());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::printf("  %-42s", rows[r].name);
    for (std::size_t e = 0; e < edges.size(); ++e)
      std::printf(" %6.1f", scalar[r][e].best / vectors[r][e].best);
    std::printf("\n");
  }
  return 0;
}
