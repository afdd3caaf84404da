#include "gpu/depth_queue.h"

#include <algorithm>

namespace gpu {

void DepthQueue::add(const Primitive& primitive, const ClutCache& clut, std::uint32_t draw) {
  if (palettes_.empty() || clut.loads() != last_load_) {
    std::copy_n(clut.entries(), ClutCache::size, palettes_.emplace_back().begin());
    last_load_ = clut.loads();
  }
  std::uint32_t farthest = 0;
  for (std::size_t v = 0; v < primitive.vertex_count; ++v)
    farthest = std::max(farthest, primitive.vertices[v].z);
  entries_.push_back({primitive, static_cast<std::uint32_t>(palettes_.size() - 1), farthest, draw});
}

void DepthQueue::sort() {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.farthest > b.farthest; });
}

void DepthQueue::clear() {
  entries_.clear();
  palettes_.clear();
}

std::uint64_t DepthQueue::bytes() const {
  return entries_.capacity() * sizeof(Entry) + palettes_.capacity() * sizeof(Palette);
}

}  // namespace gpu
