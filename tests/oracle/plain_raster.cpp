// Pixels: sections 3 to 9 of the rules, one at a time.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "plain_gpu.h"

namespace oracle {

using std::int64_t;
using std::uint16_t;
using std::uint32_t;

namespace {

constexpr int dither_table[4][4] = {{-4, 0, -3, 1}, {2, -2, 3, -1}, {-3, 1, -4, 0}, {3, -1, 2, -2}};

int blend_channel(uint32_t mode, int b, int f) {
  switch (mode) {
    case 0:
      return (b + f) >> 1;
    case 1:
      return std::min(31, b + f);
    case 2:
      return std::max(0, b - f);
    default:
      return std::min(31, b + (f >> 2));
  }
}

/// True ceiling of a / b, b > 0.
int64_t ceil_div(int64_t a, int64_t b) { return a / b + (a % b != 0 && a > 0 ? 1 : 0); }

}  // namespace

struct PlainGpu::Plane {
  uint32_t start, dx, dy;
  [[nodiscard]] int at(int x, int y) const {
    return static_cast<int>((start + dx * static_cast<uint32_t>(x) + dy * static_cast<uint32_t>(y)) >> 24);
  }
};

/// The affine quantity of depth, as a sum of what each vertex contributes, so that nothing cancels.
struct PlainGpu::DepthPlane {
  const gpu::DepthOptions& o;
  double w[3], e[3], ex[3], ey[3], slope = 0;
  bool fixed = false;
  std::uint64_t fixed_start = 0;
  int64_t fixed_x = 0, fixed_y = 0;

  DepthPlane(const gpu::DepthOptions& options, std::array<const Vertex*, 3> t, const Vertex& core,
             bool fractions)
      : o(options) {
    double x[3], y[3];
    const auto place = [&](bool fine) {
      for (std::size_t i = 0; i < 3; ++i) {
        x[i] = (t[i]->x - core.x) * 256.0 + (fine ? t[i]->fx : 0);
        y[i] = (t[i]->y - core.y) * 256.0 + (fine ? t[i]->fy : 0);
      }
      return (x[1] - x[0]) * (y[2] - y[1]) - (x[2] - x[1]) * (y[1] - y[0]);
    };
    double area = place(fractions);
    if (area == 0) area = place(false);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const double z = std::max(t[i]->z, 1U) / 4096.0;
      double q = 1 / z;
      if (o.mapping == gpu::DepthMapping::hyperbolic) {
        const double range = o.far_z - o.near_z, scale = gpu::depth_scale(o.format);
        q = o.reversed ? o.near_z * (o.far_z - z) / (z * range) * scale
                       : o.far_z * (z - o.near_z) / (z * range) * scale;
      }
      w[i] = q / area;
      // doubled area of (point, vertex j, vertex k), point in pixels from the core
      e[i] = x[j] * y[k] - x[k] * y[j];
      ex[i] = (y[j] - y[k]) * 256.0;
      ey[i] = (x[k] - x[j]) * 256.0;
    }
    for (std::size_t i = 0; i < 3; ++i) slope += ex[i] * w[i];
    if (!fractions && o.mapping == gpu::DepthMapping::hyperbolic && o.format != gpu::DepthFormat::float32)
      put_fixed(t, core);
  }

  /// Where nothing can leave the range, 32.32 counts: depths of the vertices with 18 bits of fraction, exact
  /// numerators, a rounding half in the start.
  void put_fixed(std::array<const Vertex*, 3> t, const Vertex& core) {
    const double range = o.far_z - o.near_z, scale = gpu::depth_scale(o.format);
    const auto depth_of = [&](const Vertex& vertex) {
      const double z = vertex.z / 4096.0;
      const double unit =
          o.reversed ? o.near_z * (o.far_z - z) / (z * range) : o.far_z * (z - o.near_z) / (z * range);
      return static_cast<int64_t>(unit * scale * 262144);
    };
    for (const Vertex* vertex : t) {
      if (vertex->z / 4096.0 < o.near_z || vertex->z / 4096.0 > o.far_z) return;
    }
    const int64_t a = depth_of(*t[0]), b = depth_of(*t[1]), c = depth_of(*t[2]);
    const int64_t x = (b - a) * (t[2]->y - t[1]->y) - (c - b) * (t[1]->y - t[0]->y);
    const int64_t y = (t[1]->x - t[0]->x) * (c - b) - (t[2]->x - t[1]->x) * (b - a);
    const int area = (t[1]->x - t[0]->x) * (t[2]->y - t[1]->y) - (t[2]->x - t[1]->x) * (t[1]->y - t[0]->y);
    const double step = 16384.0 / area;
    const double dx = static_cast<double>(x) * step, dy = static_cast<double>(y) * step;
    fixed = std::abs(dx) <= std::ldexp(1.0, 62) && std::abs(dy) <= std::ldexp(1.0, 62);
    if (!fixed) return;
    fixed_start = (static_cast<std::uint64_t>(depth_of(core)) << 14) + 0x80000000;
    fixed_x = static_cast<int64_t>(dx);
    fixed_y = static_cast<int64_t>(dy);
  }

  [[nodiscard]] uint32_t fixed_key(int dx, int dy) const {
    const std::uint64_t value = fixed_start +
                                static_cast<std::uint64_t>(fixed_x) * static_cast<std::uint64_t>(dx) +
                                static_cast<std::uint64_t>(fixed_y) * static_cast<std::uint64_t>(dy);
    return gpu::depth_key(o, static_cast<uint32_t>(value >> 32));
  }

  [[nodiscard]] double row_start(int dx, int dy) const {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += (e[i] + ex[i] * dx + ey[i] * dy) * w[i];
    return sum;
  }

  [[nodiscard]] uint32_t key(double start, int column) const {
    const double scale = gpu::depth_scale(o.format), range = o.far_z - o.near_z;
    double value = start + slope * column;
    if (o.mapping == gpu::DepthMapping::linear) {
      value = std::max(value, 1e-300);  // behind the eye is as far as can be
      value = o.reversed ? 1.0 / value * (-scale / range) + o.far_z / range * scale
                         : 1.0 / value * (scale / range) + -o.near_z / range * scale;
    }
    value = std::clamp(value, 0.0, scale);
    const uint32_t stored = o.format == gpu::DepthFormat::float32
                                ? std::bit_cast<uint32_t>(static_cast<float>(value))
                                : static_cast<uint32_t>(std::floor(value + 0.5));
    return gpu::depth_key(o, stored);
  }
};

void PlainGpu::triangle(std::array<const Vertex*, 3> t, Pass pass) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex &a = *t[i], &b = *t[(i + 1) % 3];
    if (std::abs(a.x - b.x) > 1023 || std::abs(a.y - b.y) > 511) return;
  }
  const Vertex &v0 = *t[0], &v1 = *t[1], &v2 = *t[2];
  const int area = (v1.x - v0.x) * (v2.y - v1.y) - (v2.x - v1.x) * (v1.y - v0.y);
  if (area == 0) return;
  const Vertex& core = v1.x <= v0.x ? (v2.x <= v1.x ? v2 : v1) : (v2.x < v0.x ? v2 : v0);
  const auto plane = [&](int Vertex::*f) {
    const int f0 = v0.*f, f1 = v1.*f, f2 = v2.*f;
    const int nx = (f1 - f0) * (v2.y - v1.y) - (f2 - f1) * (v1.y - v0.y);
    const int ny = (v1.x - v0.x) * (f2 - f1) - (v2.x - v1.x) * (f1 - f0);
    return Plane{static_cast<uint32_t>(core.*f * 4096 + 2048) << 12,
                 static_cast<uint32_t>(nx * 4096 / area) << 12,
                 static_cast<uint32_t>(ny * 4096 / area) << 12};
  };
  const Plane u = plane(&Vertex::u), v = plane(&Vertex::v);
  const Plane r = plane(&Vertex::r), g = plane(&Vertex::g), b = plane(&Vertex::b);
  const bool dither = (reg_.mode >> 9 & 1) != 0 && (is_gouraud() || (is_textured() && !is_raw()));
  std::optional<DepthPlane> deep;
  if (pass != Pass::console) deep.emplace(*options_, t, core, fractions_);

  auto s = t;
  std::stable_sort(s.begin(), s.end(), [](const Vertex* p, const Vertex* q) { return p->y < q->y; });
  const auto edge = [](const Vertex& p, const Vertex& q, int y) {
    return p.x + static_cast<int>(ceil_div(int64_t{q.x - p.x} * (y - p.y), q.y - p.y));
  };
  const auto row = [&](int y) {
    const int along = edge(*s[0], *s[2], y);
    const int across = y < s[1]->y ? edge(*s[0], *s[1], y) : edge(*s[1], *s[2], y);
    const int left = std::min(along, across), right = std::max(along, across);
    const int sy = sx11(static_cast<uint32_t>(y)), sx = sx11(static_cast<uint32_t>(left));
    if (row_is_skipped(sy)) return;
    int first = -1;
    double start = 0;
    for (int x = left; x < right; ++x) {
      const int px = sx + x - left, dx = x - core.x, dy = y - core.y;
      if (!in_area(px, sy)) continue;
      uint32_t key = 0;
      if (deep) {
        if (first < 0) {
          first = px;
          start = deep->row_start(dx, dy);
        }
        key = deep->fixed ? deep->fixed_key(dx, dy) : deep->key(start, px - first);
      }
      const std::array<int, 3> colour = is_gouraud() ? std::array{r.at(dx, dy), g.at(dx, dy), b.at(dx, dy)}
                                                     : std::array{v_[0].r, v_[0].g, v_[0].b};
      pixel(px, sy, colour, u.at(dx, dy), v.at(dx, dy), dither, pass, key);
    }
  };
  if (&core == s[0]) {
    for (int y = s[0]->y; y < s[2]->y; ++y) row(y);
  } else if (&core == s[1]) {
    for (int y = s[1]->y; y < s[2]->y; ++y) row(y);
    for (int y = s[1]->y - 1; y >= s[0]->y; --y) row(y);
  } else {
    for (int y = s[2]->y - 1; y >= s[0]->y; --y) row(y);
  }
}

uint16_t PlainGpu::texel(int u, int v) const {
  const int mask_x = static_cast<int>(reg_.window & 31) * 8,
            mask_y = static_cast<int>(reg_.window >> 5 & 31) * 8;
  const int off_x = static_cast<int>(reg_.window >> 10 & 31) * 8,
            off_y = static_cast<int>(reg_.window >> 15 & 31) * 8;
  u = (u & ~mask_x) | (off_x & mask_x);
  v = (v & ~mask_y) | (off_y & mask_y);
  const int px = static_cast<int>(reg_.mode & 15) * 64, py = static_cast<int>(reg_.mode >> 4 & 1) * 256;
  switch (reg_.mode >> 7 & 3) {
    case 0:
      return clut_[static_cast<std::size_t>(at(px + u / 4, py + v) >> 4 * (u % 4) & 15)];
    case 1:
      return clut_[static_cast<std::size_t>(at(px + u / 2, py + v) >> 8 * (u % 2) & 255)];
    default:
      return at(px + u, py + v);
  }
}

/// Sections 6.1 to 6.6 for a pixel inside the drawing area.
void PlainGpu::pixel(int x, int y, std::array<int, 3> colour, int u, int v, bool dither, Pass pass,
                     uint32_t key) {
  uint16_t& target = at(x, y);
  const std::size_t place = static_cast<std::size_t>((y & 511) * 1024 + (x & 1023));
  if ((reg_.mask & 2) != 0 && (target & 0x8000) != 0) return;
  const uint16_t t = is_textured() ? texel(u, v) : 0;
  if (is_textured() && t == 0) return;
  const bool lets_light_through = is_semi() && (!is_textured() || (t & 0x8000) != 0);
  if (pass != Pass::console) {
    if (lets_light_through != (pass == Pass::semi_transparent)) return;
    const uint32_t old = depth[place];
    const bool wins = key < old || (options_->test == gpu::DepthTest::lequal && key == old);
    if (!wins) return;
    if (pass == Pass::opaque) depth[place] = key;
  }
  const int d = dither ? dither_table[y & 3][x & 3] : 0;
  int result = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int shift = 5 * static_cast<int>(i);
    const int texel5 = t >> shift & 31;
    int channel = texel5;
    if (!is_raw()) {
      const int m = is_textured() ? (texel5 * colour[i]) >> 4 : colour[i];
      channel = std::clamp((m + d) >> 3, 0, 31);
    }
    if (lets_light_through) channel = blend_channel(reg_.mode >> 5 & 3, target >> shift & 31, channel);
    result |= channel << shift;
  }
  target = static_cast<uint16_t>(result | (t & 0x8000) | ((reg_.mask & 1) != 0 ? 0x8000 : 0));
}

void PlainGpu::rectangle() {
  const int x0 = sx11(static_cast<uint32_t>(sx11(words_[1]) + sx11(reg_.offset)));
  const int y0 = sx11(static_cast<uint32_t>(sx11(words_[1] >> 16) + sx11(reg_.offset >> 11)));
  const uint32_t uv = is_textured() ? words_[2] : 0;
  if (is_textured()) load_clut(uv >> 16);
  constexpr int sizes[] = {0, 1, 8, 16};
  const uint32_t size = command_ >> 27 & 3;
  const int w = size != 0 ? sizes[size] : static_cast<int>(words_.back() & 1023);
  const int h = size != 0 ? sizes[size] : static_cast<int>(words_.back() >> 16 & 511);
  const bool flip_x = (reg_.mode >> 12 & 1) != 0, flip_y = (reg_.mode >> 13 & 1) != 0;
  const int u0 = static_cast<int>(uv & 255) | (flip_x ? 1 : 0), v0 = static_cast<int>(uv >> 8 & 255);
  const std::array<int, 3> colour{static_cast<int>(command_ & 255), static_cast<int>(command_ >> 8 & 255),
                                  static_cast<int>(command_ >> 16 & 255)};
  for (int j = 0; j < h; ++j) {
    for (int i = 0; i < w; ++i) {
      if (!in_area(x0 + i, y0 + j) || row_is_skipped(y0 + j)) continue;
      pixel(x0 + i, y0 + j, colour, (flip_x ? u0 - i : u0 + i) & 255, (flip_y ? v0 - j : v0 + j) & 255, false,
            Pass::console, 0);
    }
  }
}

void PlainGpu::line() {
  const auto vertex = [&](uint32_t colour, uint32_t xy) {
    return Vertex{.x = sx11(xy) + sx11(reg_.offset),
                  .y = sx11(xy >> 16) + sx11(reg_.offset >> 11),
                  .r = static_cast<int>(colour & 255),
                  .g = static_cast<int>(colour >> 8 & 255),
                  .b = static_cast<int>(colour >> 16 & 255)};
  };
  v_[0] = vertex(command_, words_[1]);
  v_[1] = is_gouraud() ? vertex(words_[2], words_[3]) : vertex(command_, words_[2]);
  in_polyline_ = (command_ >> 27 & 1) != 0;
  segment();
}

void PlainGpu::segment() {
  Vertex a = v_[0], b = v_[1];
  const int k = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  if (std::abs(b.x - a.x) > 1023 || std::abs(b.y - a.y) > 511) return;
  if (k > 0 && a.x >= b.x) std::swap(a, b);
  constexpr int64_t one = int64_t{1} << 32;
  const auto step = [&](int d) -> int64_t {
    if (k == 0) return 0;
    return (d * one + (d < 0 ? -(k - 1) : d > 0 ? k - 1 : 0)) / k;
  };
  const int64_t sx = step(b.x - a.x), sy = step(b.y - a.y);
  int64_t x = a.x * one + one / 2 - 1024, y = a.y * one + one / 2 - (sy < 0 ? 1024 : 0);
  for (int i = 0; i <= k; ++i, x += sx, y += sy) {
    const auto channel = [&](int c0, int c1) {
      return !is_gouraud() || k == 0 ? c0 : (c0 * 4096 + 2048 + i * ((c1 - c0) * 4096 / k)) >> 12;
    };
    const int px = static_cast<int>(x >> 32) & 2047, py = static_cast<int>(y >> 32) & 2047;
    if (!in_area(px, py) || row_is_skipped(py)) continue;
    pixel(px, py, {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b)}, 0, 0, (reg_.mode >> 9 & 1) != 0,
          Pass::console, 0);
  }
}

void PlainGpu::fill() {
  flush();
  const int x = static_cast<int>(words_[1] & 0x3f0), y = static_cast<int>(words_[1] >> 16 & 511);
  const int w = static_cast<int>((words_[2] & 1023) + 15) & ~15, h = static_cast<int>(words_[2] >> 16 & 511);
  const auto value =
      static_cast<uint16_t>((command_ >> 3 & 31) | (command_ >> 11 & 31) << 5 | (command_ >> 19 & 31) << 10);
  for (int j = 0; j < h; ++j) {
    if (row_is_skipped((y + j) & 511)) continue;
    for (int i = 0; i < w; ++i) {
      at(x + i, y + j) = value;
      empty_depth(x + i, y + j);
    }
  }
}

void PlainGpu::copy() {
  flush();
  const int w = static_cast<int>(((words_[3] & 0xffff) - 1) & 1023) + 1;
  const int h = static_cast<int>(((words_[3] >> 16) - 1) & 511) + 1;
  const int from_x = static_cast<int>(words_[1] & 1023), from_y = static_cast<int>(words_[1] >> 16 & 511);
  const int to_x = static_cast<int>(words_[2] & 1023), to_y = static_cast<int>(words_[2] >> 16 & 511);
  std::vector<uint16_t> chunk;
  for (int j = 0; j < h; ++j) {
    for (int first = 0; first < w; first += 128) {
      chunk.clear();
      for (int i = first; i < std::min(first + 128, w); ++i) chunk.push_back(at(from_x + i, from_y + j));
      for (int i = first; const uint16_t value : chunk) transfer_pixel(to_x + i++, to_y + j, value);
    }
  }
}

void PlainGpu::transfer_pixel(int x, int y, uint16_t value) {
  if ((reg_.mask & 2) != 0 && (at(x, y) & 0x8000) != 0) return;
  at(x, y) = static_cast<uint16_t>(value | (reg_.mask & 1) << 15);
  empty_depth(x, y);
}

/// Depth begins anew where a transfer wrote.
void PlainGpu::empty_depth(int x, int y) {
  if (!depth.empty()) depth[static_cast<std::size_t>((y & 511) * 1024 + (x & 1023))] = gpu::DepthPlane::empty;
}

}  // namespace oracle
