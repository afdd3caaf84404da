#pragma once
// Random GP0 words: every kind of primitive under every state, near each other so that they overlap.

#include <cstdint>
#include <random>
#include <vector>

namespace tests {

class RandomWords {
 public:
  explicit RandomWords(std::uint32_t seed) : engine_(seed) {}

  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  bool coin() { return below(2) != 0; }
  std::uint32_t word() { return static_cast<std::uint32_t>(engine_()); }

  /// Noise everywhere, as one upload.
  std::vector<std::uint32_t> noise() {
    std::vector<std::uint32_t> words{0xa0000000, 0, 0x02000400};
    for (int i = 0; i < 1024 * 512 / 2; ++i) words.push_back(coin() ? word() : word() & word() & 0x7fff7fff);
    return words;
  }

  void state(std::vector<std::uint32_t>& out) {
    out.push_back(0xe1000000 | (word() & 0x3fff));
    out.push_back(0xe2000000 | (coin() ? 0 : word() & 0xfffff));
    const std::uint32_t x = below(700), y = below(400);
    out.push_back(0xe3000000 | x | y << 10);
    out.push_back(0xe4000000 | (x + below(400)) | (y + below(150)) << 10);
    out.push_back(0xe5000000 | (below(512)) | below(256) << 11);
    out.push_back(0xe6000000 | (coin() ? 0 : below(4)));
  }

  std::uint32_t vertex(std::uint32_t extent) {
    if (below(50) == 0) return word();
    return (below(extent) + origin_x_) | (below(extent) + origin_y_) << 16;
  }

  void place(std::uint32_t extent) {
    origin_x_ = below(600);
    origin_y_ = below(400);
    extent_ = extent;
  }

  /// 20h-3Fh with all its words; `depth` puts annotation words before it.
  void polygon(std::vector<std::uint32_t>& out, std::uint32_t opcode, bool depth = false) {
    const bool gouraud = (opcode & 16) != 0, textured = (opcode & 4) != 0;
    const std::uint32_t vertices = (opcode & 8) != 0 ? 4 : 3;
    if (depth) annotate(out, vertices);
    const std::uint32_t page = word();
    for (std::uint32_t v = 0; v < vertices; ++v) {
      if (v == 0) out.push_back(opcode << 24 | (word() & 0xffffff));
      if (v != 0 && gouraud) out.push_back(word());
      out.push_back(vertex(extent_));
      if (textured) out.push_back((word() & 0xffff) | (v == 1 ? page : word()) << 16);
    }
  }

  void annotate(std::vector<std::uint32_t>& out, std::uint32_t vertices) {
    if (coin()) out.push_back(0xe7000000 | (coin() ? below(4) | below(4) << 8 | below(4) << 16 : 0));
    const bool fractions = coin();
    for (std::uint32_t v = 0; v < vertices; ++v) {
      out.push_back(0xe8000000 | v << 24 | (below(1 + below(0x1000000))));
      if (fractions) out.push_back(0xec000000 | v << 24 | (word() & 0xffff));
    }
  }

  void rectangle(std::vector<std::uint32_t>& out, std::uint32_t opcode) {
    out.push_back(opcode << 24 | (word() & 0xffffff));
    out.push_back(vertex(extent_));
    if ((opcode & 4) != 0) out.push_back(word());
    if ((opcode & 0x18) == 0) out.push_back(below(extent_) | below(extent_) << 16);
  }

  void line(std::vector<std::uint32_t>& out, std::uint32_t opcode) {
    const bool gouraud = (opcode & 16) != 0, poly = (opcode & 8) != 0;
    out.push_back(opcode << 24 | (word() & 0xffffff));
    out.push_back(vertex(extent_));
    for (std::uint32_t n = poly ? 1 + below(4) : 1; n > 0; --n) {
      if (gouraud) out.push_back(word() & 0xffffff);
      out.push_back(vertex(extent_) & 0x0fff0fff);
    }
    if (poly) out.push_back(0x55555555);
  }

  void transfer(std::vector<std::uint32_t>& out) {
    const std::uint32_t size = below(70) | below(40) << 16;
    switch (below(3)) {
      case 0:
        out.insert(out.end(), {0x02000000 | (word() & 0xffffff), word(), size});
        break;
      case 1:
        out.insert(out.end(), {0x80000000, word(), word(), size == 0 ? 1 : (size | 0x10001)});
        break;
      default: {
        const std::uint32_t w = 1 + below(30), h = 1 + below(9);
        out.insert(out.end(), {0xa0000000, word(), w | h << 16});
        for (std::uint32_t i = 0; i < (w * h + 1) / 2; ++i) out.push_back(word());
      }
    }
  }

  /// Any drawing command.
  void command(std::vector<std::uint32_t>& out, bool depth = false) {
    const std::uint32_t kind = below(20);
    if (kind == 0) return state(out);
    if (kind == 1) return transfer(out);
    constexpr std::uint32_t extents[] = {4, 12, 40, 150, 400};
    place(extents[below(5)]);
    if (kind < 12) return polygon(out, 0x20 + below(32), depth && below(8) != 0);
    if (kind < 16) return rectangle(out, 0x60 + below(32));
    line(out, 0x40 + below(32));
  }

 private:
  std::mt19937 engine_;
  std::uint32_t origin_x_ = 0, origin_y_ = 0, extent_ = 100;
};

}  // namespace tests
