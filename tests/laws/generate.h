#pragma once
// Random drawing commands for the laws: whole ones, cut ones and plain words.

#include <rapidcheck.h>

#include <cstdint>
#include <vector>

#include "ot/gp0.h"

namespace laws {

using Words = std::vector<std::uint32_t>;

/// A command with all its words: coordinates near each other, so that things overlap; uploads are small.
inline rc::Gen<Words> command() {
  return rc::gen::exec([] {
    const auto below = [](std::uint32_t n) { return *rc::gen::inRange<std::uint32_t>(0, n); };
    const auto place = [&] { return below(96) | below(96) << 16; };
    const std::uint32_t opcode = below(256);
    Words words{opcode << 24 | below(1U << 24)};
    switch (ot::gp0::command_of(words[0])) {
      case ot::gp0::Command::polygon:
      case ot::gp0::Command::line:
      case ot::gp0::Command::rectangle:
        while (words.size() < ot::gp0::command_words(words[0])) words.push_back(place());
        break;
      case ot::gp0::Command::polyline:
        for (std::uint32_t n = 3 + 2 * below(4); n > 0; --n) words.push_back(place());
        words.push_back(0x55555555);
        break;
      case ot::gp0::Command::fill:
      case ot::gp0::Command::copy:
        while (words.size() < ot::gp0::command_words(words[0])) words.push_back(place());
        break;
      case ot::gp0::Command::upload: {
        const std::uint32_t width = 1 + below(6), height = 1 + below(6);
        words.push_back(place());
        words.push_back(width | height << 16);
        for (std::uint32_t n = (width * height + 1) / 2; n > 0; --n)
          words.push_back(*rc::gen::arbitrary<std::uint32_t>());
        break;
      }
      case ot::gp0::Command::download:
        words.push_back(place());
        words.push_back(0x00010001);
        break;
      default:
        break;
    }
    return words;
  });
}

/// Many of them; the drawing area comes first, since without one nothing is drawn.
inline rc::Gen<Words> stream() {
  return rc::gen::map(rc::gen::container<std::vector<Words>>(command()),
                      [](const std::vector<Words>& commands) {
                        Words words{0xe3000000, 0xe407ffff, 0xe5000000};
                        for (const Words& one : commands) words.insert(words.end(), one.begin(), one.end());
                        return words;
                      });
}

}  // namespace laws
