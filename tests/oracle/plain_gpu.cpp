#include "plain_gpu.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace oracle {

using std::uint16_t;
using std::uint32_t;

bool PlainGpu::is_textured() const {
  const bool can_be = command_ >> 29 == 1 || command_ >> 29 == 3;
  return can_be && (command_ >> 26 & 1) != 0;
}

bool PlainGpu::row_is_skipped(int y) const {
  return interlaced_480 && (reg_.mode >> 10 & 1) == 0 && ((y & 1) != 0) == odd_display_line;
}

bool PlainGpu::in_area(int x, int y) const {
  return x >= static_cast<int>(reg_.top_left & 1023) && x <= static_cast<int>(reg_.bottom_right & 1023) &&
         y >= static_cast<int>(reg_.top_left >> 10 & 1023) &&
         y <= static_cast<int>(reg_.bottom_right >> 10 & 1023);
}

std::size_t PlainGpu::length() const {
  const uint32_t op = words_[0] >> 24;
  const bool g = (op & 16) != 0, quad = (op & 8) != 0, t = (op & 4) != 0;
  switch (op >> 5) {
    case 0:
      return op == 2 ? 3 : 1;
    case 1: {
      const std::size_t n = quad ? 4 : 3;
      return n + (t ? n : 0) + (g ? n : 1);
    }
    case 2:
      return g ? 4 : 3;
    case 3:
      return 2 + (t ? 1U : 0U) + ((op & 0x18) == 0 ? 1U : 0U);
    case 4:
      return 4;
    case 5:
    case 6:
      return 3;
    default:
      return 1;
  }
}

void PlainGpu::gp0(uint32_t word) {
  if (up_at_ < up_w_ * up_h_) {
    for (int half = 0; half < 2 && up_at_ < up_w_ * up_h_; ++half, ++up_at_) {
      transfer_pixel(up_x_ + up_at_ % up_w_, up_y_ + up_at_ / up_w_,
                     static_cast<uint16_t>(word >> 16 * half));
    }
    return;
  }
  if (in_polyline_) {
    if (words_.empty() && (word & 0xf000f000) == 0x50005000) {
      in_polyline_ = false;
      return;
    }
    words_.push_back(word);
    if (words_.size() < (is_gouraud() ? 2U : 1U)) return;
    const uint32_t colour = is_gouraud() ? words_[0] : command_;
    v_[0] = v_[1];
    v_[1] = {.x = sx11(words_.back()) + sx11(reg_.offset),
             .y = sx11(words_.back() >> 16) + sx11(reg_.offset >> 11),
             .r = static_cast<int>(colour & 255),
             .g = static_cast<int>(colour >> 8 & 255),
             .b = static_cast<int>(colour >> 16 & 255)};
    words_.clear();
    segment();
    return;
  }
  words_.push_back(word);
  if (words_.size() < length()) return;
  command_ = words_[0];
  execute();
  words_.clear();
}

void PlainGpu::execute() {
  const uint32_t op = command_ >> 24;
  switch (op >> 5) {
    case 0:
      if (op == 1) clut_tag_ = 0xffffffff;
      if (op == 2) fill();
      break;
    case 1:
      polygon();
      break;
    case 2:
      line();
      break;
    case 3:
      rectangle();
      break;
    case 4:
      copy();
      break;
    case 5:
      flush();
      up_x_ = static_cast<int>(words_[1] & 1023);
      up_y_ = static_cast<int>(words_[1] >> 16 & 511);
      up_w_ = static_cast<int>(((words_[2] & 0xffff) - 1) & 1023) + 1;
      up_h_ = static_cast<int>(((words_[2] >> 16) - 1) & 511) + 1;
      up_at_ = 0;
      break;
    case 6:
      break;
    default:
      if (op == 0xe1) reg_.mode = command_ & 0x37ff;
      if (op == 0xe2) reg_.window = command_ & 0xfffff;
      if (op == 0xe3) reg_.top_left = command_ & 0xfffff;
      if (op == 0xe4) reg_.bottom_right = command_ & 0xfffff;
      if (op == 0xe5) reg_.offset = command_ & 0x3fffff;
      if (op == 0xe6) reg_.mask = command_ & 3;
      if (op == 0xe7) {
        for (uint32_t v = second_high_ ? 3 : 0; v < (second_high_ ? 4U : 3U); ++v) {
          note_[v].z = (note_[v].z & 0xffffff) | (command_ >> (second_high_ ? 0 : 8 * v) & 255) << 24;
        }
        second_high_ = true;
      } else if (op >= 0xe8 && op <= 0xeb) {
        note_[op - 0xe8].z = (note_[op - 0xe8].z & 0xff000000) | (command_ & 0xffffff);
        noted_depths_ |= 1U << (op - 0xe8);
      } else if (op >= 0xec && op <= 0xef) {
        note_[op - 0xec].fx = static_cast<int>(command_ & 255);
        note_[op - 0xec].fy = static_cast<int>(command_ >> 8 & 255);
        noted_fractions_ = true;
      }
      break;
  }
}

void PlainGpu::load_clut(uint32_t halfword) {
  const uint32_t format = reg_.mode >> 7 & 3;
  if (format > 1) return;
  halfword &= 0x7fff;
  if (clut_tag_ == halfword && clut_depth_ >= format) return;
  clut_tag_ = halfword;
  clut_depth_ = format;
  for (int i = 0; i < (format == 0 ? 16 : 256); ++i) {
    clut_[static_cast<std::size_t>(i)] =
        at(static_cast<int>(halfword & 63) * 16 + i, static_cast<int>(halfword >> 6));
  }
}

void PlainGpu::polygon() {
  std::size_t n = 1;
  const std::size_t count = (command_ >> 27 & 1) != 0 ? 4 : 3;
  uint32_t clut = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const uint32_t colour = i == 0 || !is_gouraud() ? command_ : words_[n++];
    const uint32_t xy = words_[n++];
    Vertex& v = v_[i];
    v = note_[i];
    v.x = sx11(xy) + sx11(reg_.offset);
    v.y = sx11(xy >> 16) + sx11(reg_.offset >> 11);
    v.r = static_cast<int>(colour & 255);
    v.g = static_cast<int>(colour >> 8 & 255);
    v.b = static_cast<int>(colour >> 16 & 255);
    if (!is_textured()) continue;
    const uint32_t uv = words_[n++];
    v.u = static_cast<int>(uv & 255);
    v.v = static_cast<int>(uv >> 8 & 255);
    if (i == 0) clut = uv >> 16;
    if (i == 1) reg_.mode = (reg_.mode & ~0x9ffU) | (uv >> 16 & 0x1ff);
  }
  if (is_textured()) load_clut(clut);
  const unsigned all = (1U << count) - 1;
  const bool has_depth = options_ && (noted_depths_ & all) == all;
  fractions_ = noted_fractions_;
  note_ = {};
  noted_depths_ = 0;
  noted_fractions_ = second_high_ = false;
  if (!has_depth) return draw_polygon(Pass::console);
  if (!is_semi() || is_textured()) draw_polygon(Pass::opaque);
  if (!is_semi()) return;
  uint32_t farthest = 0;
  for (std::size_t i = 0; i < count; ++i) farthest = std::max(farthest, v_[i].z);
  queue_.push_back({words_, v_, reg_, clut_, farthest});
  if (fractions_) queue_.back().words.push_back(1);  // remembered behind the command
}

/// Semi-transparent polygons far to near; equal ones in list order.
void PlainGpu::flush() {
  if (queue_.empty()) return;
  std::stable_sort(queue_.begin(), queue_.end(),
                   [](const Queued& a, const Queued& b) { return a.farthest > b.farthest; });
  const auto words = words_;
  const auto registers = reg_;
  const auto clut = clut_;
  const uint32_t command = command_;
  for (const Queued& q : queue_) {
    words_ = q.words;
    command_ = words_[0];
    fractions_ = words_.size() > length();
    v_ = q.vertices;
    reg_ = q.registers;
    clut_ = q.clut;
    draw_polygon(Pass::semi_transparent);
  }
  queue_.clear();
  words_ = words;
  reg_ = registers;
  clut_ = clut;
  command_ = command;
}

void PlainGpu::set_depth(const gpu::DepthOptions& options) {
  options_ = options;
  depth.assign(1024 * 512, gpu::DepthPlane::empty);
}

void PlainGpu::end_frame() { flush(); }

void PlainGpu::draw_polygon(Pass pass) {
  triangle({&v_[0], &v_[1], &v_[2]}, pass);
  if ((command_ >> 27 & 1) != 0) triangle({&v_[1], &v_[2], &v_[3]}, pass);
}

}  // namespace oracle
