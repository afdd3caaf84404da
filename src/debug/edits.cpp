#include "debug/edits.h"

#include <algorithm>
#include <numeric>

#include "ot/gp0.h"

namespace debug {
namespace {

ot::gp0::Command command_of(const Item& item) {
  const auto at = item.command_at();
  return item.is_control || item.is_rest || at >= item.words.size() ? ot::gp0::Command::nop
                                                                    : ot::gp0::command_of(item.words[at]);
}

void move(std::vector<std::size_t>& order, const Edits::Move& move) {
  if (move.item == move.target) return;
  const auto from = std::find(order.begin(), order.end(), move.item);
  if (from == order.end() || std::find(order.begin(), order.end(), move.target) == order.end()) return;
  order.erase(from);
  const auto to = std::find(order.begin(), order.end(), move.target);
  order.insert(to + (move.is_behind ? 1 : 0), move.item);
}

// In front of the first that is drawn in the bucket or in a nearer one.
void link_into(std::vector<std::size_t>& order, const Clip& clip, std::size_t item, std::uint32_t bucket) {
  std::erase(order, item);
  const auto to = std::find_if(order.begin(), order.end(), [&](std::size_t other) {
    return clip.items[other].bucket != gpu::no_bucket && clip.items[other].bucket <= bucket;
  });
  order.insert(to, item);
}

// What a command leaves behind for others, without its pixels: the texture page of a textured polygon.
std::vector<std::uint32_t> without_pixels(const Item& item, std::uint32_t draw_mode) {
  const auto at = item.command_at();
  if (command_of(item) != ot::gp0::Command::polygon) return {};
  const auto first = item.words[at];
  if (ot::gp0::polygon::IsTextured::get(first) == 0) return {};
  const std::size_t second = 2 + 1 + (ot::gp0::polygon::IsGouraud::get(first) != 0 ? 1 : 0) + 1;
  const auto page = ot::gp0::texcoord::Texpage::get(item.words[at + second]);
  const auto bits = ot::gp0::draw_mode::page_bits & ~ot::gp0::draw_mode::TextureDisable::mask;
  return {ot::gp0::Opcode::put(0xe1) | ((draw_mode & ~bits & 0xffffff) | (page & bits))};
}

std::uint32_t draw_mode_after(std::uint32_t before, const Item& item) {
  const auto at = item.command_at();
  if (command_of(item) == ot::gp0::Command::draw_mode) return item.words[at] & 0xffffff;
  const auto page = without_pixels(item, before);
  return page.empty() ? before : page[0] & 0xffffff;
}

}  // namespace

Edited apply(const Clip& clip, const Edits& edits) {
  std::vector<std::size_t> order(clip.items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const auto& [item, bucket] : edits.buckets) {
    if (item < order.size()) link_into(order, clip, item, bucket);
  }
  for (const auto& one : edits.moves) move(order, one);

  Edited edited;
  edited.clip = {clip.state, {}, clip.buckets, clip.is_list_in_ram, clip.lint, clip.notes};
  gpu::Gpu gpu;
  go_on_from(clip.state, gpu);
  std::uint32_t draw_mode = gpu.state().draw_mode;
  for (const auto index : order) {
    Item item = clip.items[index];
    if (const auto words = edits.words.find(index); words != edits.words.end()) item.words = words->second;
    if (const auto bucket = edits.buckets.find(index); bucket != edits.buckets.end())
      item.bucket = bucket->second;
    const bool is_out = edits.hidden.contains(index) || (!edits.solo.empty() && !edits.solo.contains(index));
    if (is_out && item.is_drawing()) {
      const auto left = without_pixels(item, draw_mode);
      draw_mode = draw_mode_after(draw_mode, item);
      if (left.empty()) continue;
      item.words = left;
    } else {
      draw_mode = draw_mode_after(draw_mode, item);
    }
    edited.clip.items.push_back(std::move(item));
    edited.origin.push_back(index);
  }
  return edited;
}

std::vector<std::size_t> vertex_words(const Item& item) {
  const auto at = item.command_at();
  const auto count = item.words.size();
  std::vector<std::size_t> found;
  const auto add = [&](std::size_t word) {
    if (word < count) found.push_back(word);
  };
  switch (command_of(item)) {
    case ot::gp0::Command::polygon: {
      const auto first = item.words[at];
      const std::size_t colour = ot::gp0::polygon::IsGouraud::get(first) != 0 ? 1 : 0;
      const std::size_t each = 1 + colour + ot::gp0::polygon::IsTextured::get(first);
      for (std::size_t v = 0; v < ot::gp0::polygon::vertices(first); ++v) add(at + 1 + v * each);
      break;
    }
    case ot::gp0::Command::line:
      add(at + 1);
      add(at + (ot::gp0::line::IsGouraud::get(item.words[at]) != 0 ? 3 : 2));
      break;
    case ot::gp0::Command::rectangle:
    case ot::gp0::Command::fill:
    case ot::gp0::Command::upload:
      add(at + 1);
      break;
    case ot::gp0::Command::copy:
      add(at + 1);
      add(at + 2);
      break;
    default:
      break;
  }
  return found;
}

std::vector<std::size_t> colour_words(const Item& item) {
  const auto at = item.command_at();
  std::vector<std::size_t> found;
  const auto command = command_of(item);
  const bool has_colour = command == ot::gp0::Command::polygon || command == ot::gp0::Command::line ||
                          command == ot::gp0::Command::polyline || command == ot::gp0::Command::rectangle ||
                          command == ot::gp0::Command::fill;
  if (!has_colour) return found;
  const auto first = item.words[at];
  found.push_back(at);
  const bool is_gouraud = ot::gp0::polygon::IsGouraud::get(first) != 0;
  if (command == ot::gp0::Command::polygon && is_gouraud) {
    const std::size_t each = 2 + ot::gp0::polygon::IsTextured::get(first);
    for (std::size_t v = 1; v < ot::gp0::polygon::vertices(first); ++v) found.push_back(at + v * each);
  }
  if (command == ot::gp0::Command::line && is_gouraud) found.push_back(at + 2);
  std::erase_if(found, [&](std::size_t word) { return word >= item.words.size(); });
  return found;
}

Corner corner_of(std::uint32_t word) {
  return {ot::gp0::vertex::X::get_signed(word), ot::gp0::vertex::Y::get_signed(word)};
}

std::uint32_t with_corner(std::uint32_t word, Corner corner) {
  const auto x = static_cast<std::uint32_t>(std::clamp(corner.x, -1024, 1023)) & ot::gp0::vertex::X::max;
  const auto y = static_cast<std::uint32_t>(std::clamp(corner.y, -1024, 1023)) & ot::gp0::vertex::Y::max;
  return ot::gp0::vertex::Y::set(ot::gp0::vertex::X::set(word, x), y);
}

}  // namespace debug
