#include "debug/compare.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

namespace debug {
namespace {

std::string words_of_side(Timeline& timeline, const Number& number) {
  if (number.frame > timeline.frames()) return "no such frame";
  if (number.command == 0) return "the frame has no more commands";
  return describe(timeline.dump(), timeline.commands(number.frame)[number.command - 1]);
}

/// The first command of a frame that differs, from 1; 0: none.
std::uint64_t first_difference(Timeline& a, Timeline& b, std::uint64_t frame) {
  const auto& left = a.commands(frame);
  const auto& right = b.commands(frame);
  const std::size_t both = std::min(left.size(), right.size());
  for (std::size_t n = 0; n < both; ++n) {
    if (left[n].is_control != right[n].is_control ||
        all_words_of(a.dump(), left[n]) != all_words_of(b.dump(), right[n]))
      return n + 1;
  }
  return left.size() == right.size() ? 0 : both + 1;
}

Side side(Timeline& timeline, std::uint64_t frame, std::uint64_t command) {
  Number number{.frame = frame, .command = command};
  if (frame > timeline.frames() || command > timeline.commands_in(frame)) number.command = 0;
  return {number, words_of_side(timeline, number)};
}

std::vector<std::string> different_registers(const gpu::Gpu& a, const gpu::Gpu& b) {
  std::vector<std::string> different;
  const auto compare = [&](const char* name, std::uint32_t left, std::uint32_t right) {
    if (left == right) return;
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%s: %08Xh, %08Xh", name, static_cast<unsigned>(left),
                  static_cast<unsigned>(right));
    different.emplace_back(text.data());
  };
  compare("draw mode", a.state().draw_mode, b.state().draw_mode);
  compare("texture window", a.state().texture_window, b.state().texture_window);
  compare("drawing area from", a.state().area_top_left, b.state().area_top_left);
  compare("drawing area to", a.state().area_bottom_right, b.state().area_bottom_right);
  compare("drawing offset", a.state().offset, b.state().offset);
  compare("mask bits", a.state().mask, b.state().mask);
  compare("display mode", a.display().mode, b.display().mode);
  compare("display start", a.display().start, b.display().start);
  compare("horizontal range", a.display().horizontal_range, b.display().horizontal_range);
  compare("vertical range", a.display().vertical_range, b.display().vertical_range);
  compare("display off", a.display().is_off ? 1 : 0, b.display().is_off ? 1 : 0);
  return different;
}

std::optional<Parting::OfPixels> different_pixels(const gpu::Gpu& a, const gpu::Gpu& b) {
  const auto left = a.vram().pixels(), right = b.vram().pixels();
  const auto [first, other] = std::ranges::mismatch(left, right);
  if (first == left.end()) return std::nullopt;
  Parting::OfPixels pixels;
  pixels.first = static_cast<std::uint32_t>(first - left.begin());
  pixels.a = *first;
  pixels.b = *other;
  for (std::size_t n = pixels.first; n < left.size(); ++n) pixels.count += left[n] != right[n] ? 1 : 0;
  return pixels;
}

}  // namespace

Parting compare(Timeline& a, Timeline& b, const std::function<bool(std::uint64_t)>& keep_going) {
  Parting parting;
  const std::uint64_t both = std::min(a.frames(), b.frames());
  for (std::uint64_t frame = 1; frame <= both; ++frame) {
    if (keep_going && !keep_going(frame)) {
      parting.is_complete = false;
      return parting;
    }
    ++parting.frames;
    parting.commands_compared += std::min(a.commands_in(frame), b.commands_in(frame));
    if (const auto command = parting.commands ? 0 : first_difference(a, b, frame); command != 0)
      parting.commands = Parting::OfCommands{side(a, frame, command), side(b, frame, command)};
    const Number end{.frame = frame, .command = whole_frame};
    const gpu::Gpu &left = a.seek(end), &right = b.seek(end);
    if (!parting.state) {
      if (auto registers = different_registers(left, right); !registers.empty())
        parting.state = Parting::OfState{frame, std::move(registers)};
    }
    if (!parting.pixels) {
      parting.pixels = different_pixels(left, right);
      if (parting.pixels) {
        parting.pixels->frame = frame;
        const std::array pixel{parting.pixels->first};
        parting.pixels->writer_a = last_writers(a, end, pixel)[0];
        parting.pixels->writer_b = last_writers(b, end, pixel)[0];
      }
    }
    if (parting.commands && parting.state && parting.pixels) return parting;
  }
  if (a.frames() != b.frames() && !parting.commands)
    parting.commands = Parting::OfCommands{side(a, both + 1, 1), side(b, both + 1, 1)};
  return parting;
}

}  // namespace debug
