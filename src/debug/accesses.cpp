#include "debug/accesses.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "gpu/texel_reads.h"
#include "ot/gp0.h"

namespace debug {
namespace {

class Box {
 public:
  void add(std::uint32_t pixel) {
    const int x = static_cast<int>(pixel % gpu::Vram::width), y = static_cast<int>(pixel / gpu::Vram::width);
    left_ = std::min(left_, x);
    top_ = std::min(top_, y);
    right_ = std::max(right_, x);
    bottom_ = std::max(bottom_, y);
  }
  [[nodiscard]] bool is_empty() const { return right_ < left_; }
  [[nodiscard]] inspect::Rectangle rectangle() const {
    return {left_, top_, right_ - left_ + 1, bottom_ - top_ + 1};
  }

 private:
  int left_ = gpu::Vram::width, top_ = gpu::Vram::height, right_ = -1, bottom_ = -1;
};

class Collector {
 public:
  void add(AccessKind kind, std::size_t row, const inspect::Rectangle& place) {
    const auto [known, is_new] =
        known_.try_emplace({kind, place.x, place.y, place.width, place.height}, accesses_.size());
    if (is_new) {
      accesses_.push_back({kind, row, 1, place});
    } else {
      ++accesses_[known->second].commands;
    }
  }
  std::vector<Access> take() { return std::move(accesses_); }

 private:
  std::map<std::tuple<AccessKind, int, int, int, int>, std::size_t> known_;
  std::vector<Access> accesses_;
};

inspect::Rectangle palette_of(const gpu::Primitive& p) {
  const int entries = p.state.texel_format() == gpu::TexelFormat::clut4 ? 16 : 256;
  return {static_cast<int>(ot::gp0::clut::X16::get(p.clut)) * 16,
          static_cast<int>(ot::gp0::clut::Y::get(p.clut)), entries, 1};
}

}  // namespace

std::vector<Access> accesses_of(const FrameView& view) {
  const auto& trace = view.trace();
  std::vector<Box> written(view.rows().size());
  for (const auto& event : trace.history) {
    const auto row = event.rejected ? std::nullopt : view.row_of_draw(event.draw);
    if (row) written[*row].add(event.pixel);
  }
  Collector collector;
  for (std::size_t i = 0; i < view.rows().size(); ++i) {
    const auto& row = view.rows()[i];
    Box texels;
    for (auto draw = row.first_draw; draw < row.first_draw + row.draws; ++draw) {
      const auto& p = trace.draws[draw];
      if (p.is_textured()) {
        gpu::for_each_texel(p, [&texels](const gpu::TexelRead& read) { texels.add(read.place); });
        if (p.state.texel_format() != gpu::TexelFormat::direct15)
          collector.add(AccessKind::palette, i, palette_of(p));
      }
      if (p.kind == gpu::Kind::copy) {
        collector.add(AccessKind::source, i, {p.vertices[1].x, p.vertices[1].y, p.width, p.height});
      }
    }
    if (!texels.is_empty()) collector.add(AccessKind::texels, i, texels.rectangle());
    if (!written[i].is_empty()) collector.add(AccessKind::write, i, written[i].rectangle());
  }
  return collector.take();
}

}  // namespace debug
