#include "door/annotator.h"

#include <array>
#include <utility>

#include "ot/gp0.h"

namespace door {

namespace {

/// The bits of a vertex word that count.
constexpr std::uint32_t key_of(std::uint32_t xy) { return xy & 0x07ff07ff; }

}  // namespace

void VertexDepths::tell(std::uint32_t xy, std::uint32_t z, std::uint8_t fx, std::uint8_t fy) {
  constexpr std::size_t most = std::size_t{1} << 18;  // more than any list has: nothing is drawn of these
  if (now_.size() == most) end_list();
  const auto [at, is_new] = now_.try_emplace(key_of(xy), Value{z, fx, fy, false});
  if (is_new) return;
  const bool is_doubtful = at->second.is_doubtful || at->second.z != z;
  at->second = {z, fx, fy, is_doubtful};
}

const VertexDepths::Value* VertexDepths::find(std::uint32_t xy) const {
  for (const auto* values : {&now_, &before_}) {
    if (const auto at = values->find(key_of(xy)); at != values->end()) return &at->second;
  }
  return nullptr;
}

void VertexDepths::end_list() { before_ = std::exchange(now_, {}); }

/// Lists without polygons do not count: programs send drawing environments in lists of their own.
void Annotator::end_list() {
  if (shares_.polygons == polygons_before_list_) return;
  polygons_before_list_ = shares_.polygons;
  depths_.end_list();
}

void Annotator::abort() {
  held_.clear();
  stream_.abort();
}

void Annotator::forget() {
  held_.clear();
  is_following_ = false;
  brings_depth_ = false;
}

std::size_t Annotator::annotation_of(std::span<const std::uint32_t> polygon, std::span<std::uint32_t> out) {
  namespace gp0 = ot::gp0;
  ++shares_.polygons;
  if (std::exchange(brings_depth_, false)) {
    ++shares_.with_depth;
    return 0;
  }
  const std::uint32_t word = polygon[0];
  const std::size_t vertices = gp0::polygon::vertices(word);
  const std::size_t stride = 1 + gp0::polygon::IsTextured::get(word) + gp0::polygon::IsGouraud::get(word);
  ot::DepthAnnotation annotation;
  annotation.count = static_cast<int>(vertices);
  annotation.has_fractions = true;
  std::size_t found = 0;
  bool is_doubtful = false;
  for (std::size_t v = 0; v < vertices; ++v) {
    const VertexDepths::Value* value = depths_.find(polygon[1 + v * stride]);
    if (value == nullptr) continue;
    ++found;
    annotation.z[v] = value->z;
    annotation.fx[v] = value->fx;
    annotation.fy[v] = value->fy;
    is_doubtful = is_doubtful || value->is_doubtful;
  }
  if (found == 0) return 0;
  if (found < vertices) {
    ++shares_.partly;
    return 0;
  }
  ++shares_.with_depth;
  if (is_doubtful) ++shares_.doubtful;
  return ot::encode(annotation, out);
}

}  // namespace door
