#include "scene/quantise.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace scene {
namespace {

constexpr std::uint16_t semi = 0x8000;
constexpr std::uint16_t darkest = 0x0400;

// A halfword that occurs, and how often.
struct Entry {
  std::uint16_t texel;
  std::uint32_t count;
  [[nodiscard]] int channel(int c) const { return texel >> (5 * c) & 31; }
};

// A run of entries that will share one colour.
struct Box {
  std::size_t begin, end;
  std::uint64_t spread = 0;  // squared deviations along the widest channel, times the count of texels
  int widest = 0;
};

struct Sums {
  std::uint64_t count = 0;
  std::array<std::uint64_t, 3> sum{}, square{};
  void add(const Entry& e) {
    count += e.count;
    for (int c = 0; c < 3; ++c) {
      const auto v = static_cast<std::uint64_t>(e.channel(c));
      sum[static_cast<std::size_t>(c)] += v * e.count;
      square[static_cast<std::size_t>(c)] += v * v * e.count;
    }
  }
  [[nodiscard]] std::uint16_t mean(std::uint16_t bit15) const {
    std::uint32_t texel = bit15;
    for (std::size_t c = 0; c < 3; ++c)
      texel |= static_cast<std::uint32_t>((sum[c] + count / 2) / count) << (5 * c);
    return texel == 0 ? darkest : static_cast<std::uint16_t>(texel);
  }
};

Box measured(std::span<const Entry> entries, std::size_t begin, std::size_t end) {
  Box box{begin, end};
  Sums sums;
  for (const auto& e : entries.subspan(begin, end - begin)) sums.add(e);
  for (std::size_t c = 0; c < 3; ++c) {
    // count * sum(v^2) - sum(v)^2, at most 65536^2 * 31^2: the variance times count squared.
    const std::uint64_t spread = (sums.count * sums.square[c] - sums.sum[c] * sums.sum[c]) / sums.count;
    if (spread > box.spread) {
      box.spread = spread;
      box.widest = static_cast<int>(c);
    }
  }
  return box;
}

// Cuts a box at the mean of its widest channel; both halves have an entry, for the spread is not 0.
std::pair<Box, Box> cut(std::span<Entry> entries, const Box& box) {
  const auto run = entries.subspan(box.begin, box.end - box.begin);
  std::uint64_t count = 0;
  std::uint64_t sum = 0;
  for (const auto& e : run) {
    count += e.count;
    sum += static_cast<std::uint64_t>(e.channel(box.widest)) * e.count;
  }
  const auto half = std::stable_partition(run.begin(), run.end(), [&](const Entry& e) {
    return static_cast<std::uint64_t>(e.channel(box.widest)) * count <= sum;
  });
  const auto middle = box.begin + static_cast<std::size_t>(half - run.begin());
  return {measured(entries, box.begin, middle), measured(entries, middle, box.end)};
}

int distance(std::uint16_t a, std::uint16_t b) {
  int sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int d = (a >> (5 * c) & 31) - (b >> (5 * c) & 31);
    sum += d * d;
  }
  return sum;
}

std::size_t nearest(std::uint16_t texel, std::span<const std::uint16_t> palette) {
  std::size_t best = 0;
  int least = 1 << 20;
  for (std::size_t i = 0; i < palette.size(); ++i) {
    if (((palette[i] ^ texel) & semi) != 0 || palette[i] == 0) continue;
    const int d = distance(texel, palette[i]);
    if (d < least) {
      least = d;
      best = i;
    }
  }
  return best;
}

// Moves every colour to the mean of the texels that chose it.
void refine(std::span<const Entry> entries, std::vector<std::uint16_t>& palette) {
  std::vector<Sums> sums(palette.size());
  for (const auto& e : entries) sums[nearest(e.texel, palette)].add(e);
  for (std::size_t i = 0; i < palette.size(); ++i)
    if (sums[i].count != 0) palette[i] = sums[i].mean(palette[i] & semi);
}

// `colours` at most, for entries without 0000h.
std::vector<std::uint16_t> choose(std::vector<Entry>& entries, std::size_t colours) {
  const auto opaque_end = std::stable_partition(entries.begin(), entries.end(),
                                                [](const Entry& e) { return (e.texel & semi) == 0; });
  const auto opaque = static_cast<std::size_t>(opaque_end - entries.begin());
  std::vector<Box> boxes;
  if (opaque > 0) boxes.push_back(measured(entries, 0, opaque));
  if (opaque < entries.size()) boxes.push_back(measured(entries, opaque, entries.size()));
  while (boxes.size() < colours) {
    const auto widest = std::max_element(boxes.begin(), boxes.end(),
                                         [](const Box& a, const Box& b) { return a.spread < b.spread; });
    if (widest->spread == 0) break;
    const auto [low, high] = cut(entries, *widest);
    *widest = low;
    boxes.push_back(high);
  }
  std::vector<std::uint16_t> palette;
  for (const auto& box : boxes) {
    Sums sums;
    for (std::size_t i = box.begin; i < box.end; ++i) sums.add(entries[i]);
    palette.push_back(sums.mean(entries[box.begin].texel & semi));
  }
  for (int round = 0; round < 3; ++round) refine(entries, palette);
  return palette;
}

}  // namespace

std::uint16_t texel_of(Rgba8 colour) {
  if (colour.a == 0) return 0;
  const auto five = [](std::uint32_t v) { return (v * 31 + 127) / 255; };
  const std::uint32_t texel = five(colour.r) | five(colour.g) << 5 | five(colour.b) << 10;
  if (colour.a < 255) return static_cast<std::uint16_t>(texel | semi);
  return texel == 0 ? darkest : static_cast<std::uint16_t>(texel);
}

Indexed quantise(std::span<const std::uint16_t> texels, int colours) {
  assert(colours >= 2 && colours <= 256);
  std::vector<std::uint32_t> counts(0x10000);
  for (const auto texel : texels) ++counts[texel];
  std::vector<Entry> entries;
  for (std::uint32_t t = 0; t < 0x10000; ++t)
    if (counts[t] != 0) entries.push_back({static_cast<std::uint16_t>(t), counts[t]});

  Indexed result;
  if (entries.size() <= static_cast<std::size_t>(colours)) {
    for (const auto& e : entries) result.palette.push_back(e.texel);
  } else {
    const bool holes = counts[0] != 0;
    std::vector<Entry> drawn(entries.begin() + (holes ? 1 : 0), entries.end());
    result.palette = choose(drawn, static_cast<std::size_t>(colours) - (holes ? 1 : 0));
    if (holes) result.palette.push_back(0);
    std::sort(result.palette.begin(), result.palette.end());
    result.palette.erase(std::unique(result.palette.begin(), result.palette.end()), result.palette.end());
  }
  std::vector<std::uint8_t> index_of(0x10000);
  for (const auto& e : entries) {
    const auto exact = std::lower_bound(result.palette.begin(), result.palette.end(), e.texel);
    index_of[e.texel] =
        static_cast<std::uint8_t>(exact != result.palette.end() && *exact == e.texel
                                      ? static_cast<std::size_t>(exact - result.palette.begin())
                                      : nearest(e.texel, result.palette));
  }
  result.index.reserve(texels.size());
  for (const auto texel : texels) result.index.push_back(index_of[texel]);
  return result;
}

}  // namespace scene
