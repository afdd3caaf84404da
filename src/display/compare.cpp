#include "display/compare.h"

#include <algorithm>
#include <cassert>

namespace display {
namespace {

bool same_colour(const base::Rgba& a, const base::Rgba& b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

// A third of the luma (BT.601 weights in 256ths): dark enough that any mark stands out.
base::Rgba dimmed(const base::Rgba& c) {
  const auto grey = static_cast<std::uint8_t>((c.r * 77 + c.g * 150 + c.b * 29) / (256 * 3));
  return {grey, grey, grey, 255};
}

}  // namespace

std::size_t count_different(const base::Picture& a, const base::Picture& b) {
  if (a.width != b.width || a.height != b.height) return std::max(a.pixels.size(), b.pixels.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += same_colour(a.pixels[i], b.pixels[i]) ? 0 : 1;
  return count;
}

base::Picture mark_different(const base::Picture& shown, const base::Picture& other, base::Rgba mark) {
  assert(shown.width == other.width && shown.height == other.height);
  base::Picture marked(shown.width, shown.height);
  for (std::size_t i = 0; i < shown.pixels.size(); ++i) {
    const bool same = same_colour(shown.pixels[i], other.pixels[i]);
    marked.pixels[i] = same ? dimmed(shown.pixels[i]) : mark;
  }
  return marked;
}

}  // namespace display
