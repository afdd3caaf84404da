#include "scene/texture.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>

#include "scene/quantise.h"

namespace scene {
namespace {

constexpr int cell_width = 16, cell_height = 8;  // halfwords, rows
constexpr int grid = 64;                         // 1024 / 16 and 512 / 8
constexpr int page_cells = 4;                    // 64 halfwords
constexpr int band_cells = 32;                   // 256 rows
constexpr std::size_t most_textures = 2048;      // more than there is room for, even as single texels

int cells(int size, int cell) { return (size + cell - 1) / cell; }
int texels_per_halfword(TexelFormat depth) {
  return depth == TexelFormat::clut4 ? 4 : depth == TexelFormat::clut8 ? 2 : 1;
}
bool power_of_two(int n) { return std::has_single_bit(static_cast<unsigned>(n)); }

struct Cell {
  int x, y;
};

// Which cells of VRAM are taken: one word a row of cells.
class Grid {
 public:
  explicit Grid(int frame_width) {
    rows_.fill((std::uint64_t{1} << cells(frame_width, 64) * page_cells) - 1);
  }

  // The first free place, column by column. `step`, `step_y`: where it may begin, in cells. `texels` must not
  // pass texel 255 of the page that the place begins in; `per` texels lie in a halfword.
  std::optional<Cell> place(int width, int height, int step = 1, int step_y = 1, int texels = 0,
                            int per = 1) {
    const std::uint64_t block = width == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << width) - 1;
    for (int x = 0; x + width <= grid; x += step) {
      if (x % page_cells * cell_width * per + texels > 256) continue;
      for (int y = 0; y + height <= grid; y += step_y) {
        if (y / band_cells != (y + height - 1) / band_cells || !free(block << x, y, height)) continue;
        for (int row = y; row < y + height; ++row) rows_[static_cast<std::size_t>(row)] |= block << x;
        return Cell{x, y};
      }
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] bool free(std::uint64_t block, int y, int height) const {
    for (int row = y; row < y + height; ++row)
      if ((rows_[static_cast<std::size_t>(row)] & block) != 0) return false;
    return true;
  }

  std::array<std::uint64_t, grid> rows_{};
};

// Colour tables: rows 480..511 below the frame buffers, then strips of 8 rows among the textures.
class Tables {
 public:
  Tables(Grid& space, int frame_width) : space_(&space), end_x_(frame_width / 16 * 16) {}

  std::optional<Cell> place(int entries) {
    const int width = entries > 16 ? 256 : 16;
    if (x_ + width > end_x_) {
      x_ = first_x_;
      ++y_;
    }
    if (y_ >= end_y_) {
      const auto strip = space_->place(256 / cell_width, 1);
      if (!strip) return std::nullopt;
      first_x_ = x_ = strip->x * cell_width;
      end_x_ = x_ + 256;
      y_ = strip->y * cell_height;
      end_y_ = y_ + cell_height;
    }
    const Cell at{x_, y_};
    x_ += width;
    return at;
  }

 private:
  Grid* space_;
  int first_x_ = 0, end_x_;
  int x_ = 0, y_ = 480, end_y_ = 512;
};

// A texture in the console's format, not yet in a place.
struct Prepared {
  int width = 1, height = 1;               // one period, texels
  TexelFormat depth = TexelFormat::clut8;  // a picture of 16 colours or fewer needs no table of 256
  bool repeats = false;
  int halvings = 0;
  std::vector<std::uint16_t> values;   // indices, or halfwords if direct15
  std::vector<std::uint16_t> palette;  // 16 or 256, or none

  [[nodiscard]] bool is_texel() const { return width == 1 && height == 1; }
};

Prepared prepare(const Texture& texture, int halvings) {
  const Texture small = scaled(texture, halvings);
  Prepared p{small.width, small.height, texture.depth, texture.repeats, halvings, {}, {}};
  p.values.reserve(small.pixels.size());
  for (const auto& pixel : small.pixels) p.values.push_back(texel_of(pixel));
  if (p.depth == TexelFormat::direct15) return p;
  Indexed indexed = quantise(p.values, p.depth == TexelFormat::clut4 ? 16 : 256);
  if (indexed.palette.size() <= 16) p.depth = TexelFormat::clut4;
  p.values.assign(indexed.index.begin(), indexed.index.end());
  p.palette = std::move(indexed.palette);
  p.palette.resize(p.depth == TexelFormat::clut4 ? 16 : 256);
  return p;
}

// A window's smallest period is 8 texels: shorter powers of two are stored several times over.
int stored_period(const Prepared& p, int texels) {
  return p.repeats && power_of_two(texels) ? std::max(texels, 8) : texels;
}
int halfwords_wide(const Prepared& p) {
  const int per = texels_per_halfword(p.depth);
  return (stored_period(p, p.width) + per - 1) / per;
}
// Halfwords it takes in the grid, whole cells.
int area(const Prepared& p) {
  return cells(halfwords_wide(p), cell_width) * cell_width * cells(stored_period(p, p.height), cell_height) *
         cell_height;
}

std::vector<std::uint16_t> packed_rows(const Prepared& p) {
  const int per = texels_per_halfword(p.depth);
  const int bits = 16 / per;
  const int width = stored_period(p, p.width);
  const int height = stored_period(p, p.height);
  std::vector<std::uint16_t> rows(static_cast<std::size_t>(halfwords_wide(p) * height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto value = p.values[static_cast<std::size_t>(y % p.height * p.width + x % p.width)];
      auto& halfword = rows[static_cast<std::size_t>(y * halfwords_wide(p) + x / per)];
      halfword = static_cast<std::uint16_t>(halfword | value << (x % per * bits));
    }
  }
  return rows;
}

TexelAxis axis(const Prepared& p, int texels, int origin) {
  return {texels, origin, p.repeats && power_of_two(texels), p.repeats};
}

std::uint32_t window_word(const TexelAxis& u, const TexelAxis& v) {
  ot::TextureWindow window;
  const auto mask = [](int period) {
    return static_cast<std::uint8_t>(~(period / 8 - 1) &
                                     static_cast<int>(ot::gp0::texture_window::MaskX::max));
  };
  if (u.windowed && u.texels < 256) {
    window.mask_x = mask(std::max(u.texels, 8));
    window.offset_x = static_cast<std::uint8_t>(u.origin / 8);
  }
  if (v.windowed && v.texels < 256) {
    window.mask_y = mask(std::max(v.texels, 8));
    window.offset_y = static_cast<std::uint8_t>(v.origin / 8);
  }
  std::array<std::uint32_t, 1> word{};
  ot::encode(window, word);
  return word[0];
}

// Finds room for one texture and its table. False: VRAM is full.
bool store(const Prepared& p, Grid& space, Tables& tables, TexturePack& pack, StoredTexture& stored) {
  const int per = texels_per_halfword(p.depth);
  const int width = stored_period(p, p.width);
  const int height = stored_period(p, p.height);
  // A windowed texture begins at a multiple of its period.
  const int step = p.repeats && power_of_two(p.width) ? std::max(1, width / per / cell_width) : 1;
  const int step_y = p.repeats && power_of_two(p.height) ? std::max(1, height / cell_height) : 1;

  Cell table{0, 0};
  if (!p.palette.empty()) {
    const auto entries = static_cast<std::uint16_t>(p.palette.size());
    const auto place = tables.place(entries);
    if (!place) return false;
    table = *place;
    pack.blocks.push_back(
        {{static_cast<std::uint16_t>(table.x), static_cast<std::uint16_t>(table.y), entries, 1}, p.palette});
  }
  const auto place =
      space.place(cells(halfwords_wide(p), cell_width), cells(height, cell_height), step, step_y, width, per);
  if (!place) return false;
  const int x = place->x * cell_width;
  const int y = place->y * cell_height;
  pack.blocks.push_back({{static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y),
                          static_cast<std::uint16_t>(halfwords_wide(p)), static_cast<std::uint16_t>(height)},
                         packed_rows(p)});
  stored.u = axis(p, p.width, x % 64 * per);
  stored.v = axis(p, p.height, y % 256);
  stored.window = window_word(stored.u, stored.v);
  stored.clut = ot::clut_of(static_cast<unsigned>(table.x), static_cast<unsigned>(table.y));
  stored.texpage = ot::texpage_of(static_cast<unsigned>(x / 64 * 64), static_cast<unsigned>(y / 256 * 256),
                                  Blend::opaque, p.depth);
  return true;
}

// Nothing if they do not all fit.
std::optional<TexturePack> try_pack(std::span<const Prepared> prepared, int width) {
  std::vector<std::size_t> order(prepared.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const auto& p = prepared[a];
    const auto& q = prepared[b];
    return std::pair(stored_period(p, p.height), area(p)) > std::pair(stored_period(q, q.height), area(q));
  });
  TexturePack pack;
  pack.textures.resize(prepared.size());
  Grid space(width);
  Tables tables(space, width);
  for (const auto i : order)
    if (!store(prepared[i], space, tables, pack, pack.textures[i])) return std::nullopt;
  for (const auto& t : pack.textures)
    pack.uses_windows = pack.uses_windows || (t.window & ot::gp0::texture_window::masks) != 0;
  return pack;
}

struct Sample {
  std::uint64_t r = 0, g = 0, b = 0, a = 0;  // colours are weighted with alpha
  void add(const Sample& s, std::uint64_t weight) {
    r += weight * s.r;
    g += weight * s.g;
    b += weight * s.b;
    a += weight * s.a;
  }
};

// Calls add(source, target, weight) for every overlap of `from` source samples with `to` target
// samples, on a scale where a source sample is `to` wide and a target sample `from`: the
// weights of a target add up to `from`.
template <class Add>
void for_each_overlap(int from, int to, Add&& add) {
  for (int i = 0; i < to; ++i) {
    const std::int64_t begin = std::int64_t{i} * from;
    const std::int64_t end = begin + from;
    for (std::int64_t s = begin / to; s * to < end; ++s) {
      add(static_cast<std::size_t>(s), static_cast<std::size_t>(i),
          static_cast<std::uint64_t>(std::min(end, (s + 1) * to) - std::max(begin, s * to)));
    }
  }
}

// One source row becomes `to` samples: exact sums, at most 255 * 255 * 16384 each.
void average_row(std::span<const Rgba8> row, std::span<Sample> out) {
  std::fill(out.begin(), out.end(), Sample{});
  for_each_overlap(static_cast<int>(row.size()), static_cast<int>(out.size()),
                   [&](std::size_t from, std::size_t to, std::uint64_t weight) {
                     const Rgba8 p = row[from];
                     const std::uint64_t a = p.a;
                     out[to].add({p.r * a, p.g * a, p.b * a, a}, weight);
                   });
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

std::int8_t texel_rest(double exact, int whole) {
  return static_cast<std::int8_t>(std::clamp(std::floor((exact - whole) * 8 + 0.5), -8.0, 7.0));
}

TexelCoordinate TexelAxis::coordinate(double t, double base, bool is_one) const {
  const bool is_clamped = is_one || !windowed;
  const double given = repeats ? t - base : t;
  const double within = given > 0 ? (is_clamped ? std::min(given, 1.0) : given) : 0;
  const double exact = std::min(within * texels - 0.5, 255.5);
  const int most = std::min(is_clamped ? texels - 1 : 255, 255 - origin);
  const int whole = std::clamp(static_cast<int>(std::floor(exact + 0.5)), 0, most);
  return {static_cast<std::uint8_t>(origin + whole), texel_rest(exact, whole)};
}

Texture scaled(const Texture& texture, int halvings) {
  const auto size = [halvings](int n) { return std::max(1, std::min(n, 256) >> halvings); };
  Texture out{texture.name, 1, 1, {}, texture.depth, texture.repeats};
  if (texture.width < 1 || texture.height < 1 ||
      texture.pixels.size() !=
          static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height)) {
    out.pixels = {Rgba8{255, 255, 255, 255}};
    return out;
  }
  const int width = size(texture.width);
  const int height = size(texture.height);
  if (width == texture.width && height == texture.height) return texture;
  const auto columns = static_cast<std::size_t>(width);
  std::vector<Sample> row(columns);
  std::vector<Sample> sums(columns * static_cast<std::size_t>(height));
  auto held = static_cast<std::size_t>(texture.height);  // the source row that `row` holds
  for_each_overlap(texture.height, height, [&](std::size_t from, std::size_t to, std::uint64_t weight) {
    if (from != held)
      average_row(std::span(texture.pixels)
                      .subspan(from * static_cast<std::size_t>(texture.width),
                               static_cast<std::size_t>(texture.width)),
                  row);
    held = from;
    for (std::size_t x = 0; x < columns; ++x) sums[to * columns + x].add(row[x], weight);
  });
  const auto total = static_cast<std::uint64_t>(texture.width) * static_cast<std::uint64_t>(texture.height);
  out.width = width;
  out.height = height;
  out.pixels.clear();
  for (const auto& s : sums) {
    const auto rounded = [](std::uint64_t sum, std::uint64_t by) {
      return static_cast<std::uint8_t>(by == 0 ? 0 : (sum + by / 2) / by);
    };
    out.pixels.push_back({rounded(s.r, s.a), rounded(s.g, s.a), rounded(s.b, s.a), rounded(s.a, total)});
  }
  return out;
}

TexturePack pack_textures(std::span<const Texture> textures, int width) {
  std::vector<Prepared> prepared;
  prepared.reserve(textures.size());
  for (const auto& texture : textures) prepared.push_back(prepare(texture, 0));
  const auto halve_largest = [&] {
    const auto largest =
        std::max_element(prepared.begin(), prepared.end(),
                         [](const Prepared& a, const Prepared& b) { return area(a) < area(b); });
    if (largest == prepared.end() || largest->is_texel()) return false;
    *largest = prepare(textures[static_cast<std::size_t>(largest - prepared.begin())], largest->halvings + 1);
    return true;
  };
  std::optional<TexturePack> pack;
  if (textures.size() <= most_textures) {
    const int space = (1024 - width) * 512;
    const auto total = [&] {
      return std::accumulate(prepared.begin(), prepared.end(), 0,
                             [](int sum, const Prepared& p) { return sum + area(p); });
    };
    while (total() > space && halve_largest()) {
    }
    pack = try_pack(prepared, width);
    while (!pack && halve_largest()) pack = try_pack(prepared, width);
  }
  if (!pack) {
    pack.emplace();
    pack->textures.resize(textures.size());
    pack->report.push_back(std::to_string(textures.size()) +
                           " textures: they do not fit into VRAM, and none is drawn");
    return std::move(*pack);
  }
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const auto& t = textures[i];
    const int width_given = t.file_width > 0 ? t.file_width : t.width,
              height_given = t.file_height > 0 ? t.file_height : t.height;
    if (prepared[i].width == width_given && prepared[i].height == height_given) continue;
    pack->report.push_back("texture " + (t.name.empty() ? std::to_string(i) : t.name) + ": " +
                           size_text(width_given, height_given) + " stored as " +
                           size_text(prepared[i].width, prepared[i].height));
  }
  return std::move(*pack);
}

}  // namespace scene
