#include "sdk/pads.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "sdk/include/psxpad.h"

namespace sdk {
namespace {

struct Button {
  std::string_view name;
  unsigned bit;
};
constexpr std::array buttons{
    Button{"SELECT", PAD_SELECT},
    Button{"L3", PAD_L3},
    Button{"R3", PAD_R3},
    Button{"START", PAD_START},
    Button{"UP", PAD_UP},
    Button{"RIGHT", PAD_RIGHT},
    Button{"DOWN", PAD_DOWN},
    Button{"LEFT", PAD_LEFT},
    Button{"L2", PAD_L2},
    Button{"R2", PAD_R2},
    Button{"L1", PAD_L1},
    Button{"R1", PAD_R1},
    Button{"TRIANGLE", PAD_TRIANGLE},
    Button{"CIRCLE", PAD_CIRCLE},
    Button{"CROSS", PAD_CROSS},
    Button{"SQUARE", PAD_SQUARE},
};
constexpr std::array<std::string_view, 4> sticks{"RX", "RY", "LX", "LY"};
constexpr std::uint8_t middle = 128;

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<std::uint32_t> number(std::string_view text, std::uint32_t largest) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > largest) return std::nullopt;
  return value;
}

/// False: the word is neither a button nor a stick.
bool hold(PadState& pad, std::string_view word) {
  if (word == "X") word = "CROSS";
  const auto button = std::ranges::find(buttons, word, &Button::name);
  if (button != buttons.end()) {
    pad.buttons = static_cast<std::uint16_t>(pad.buttons | button->bit);
    return true;
  }
  const auto equals = word.find('=');
  if (equals == std::string_view::npos) return false;
  const auto stick = std::ranges::find(sticks, word.substr(0, equals));
  const auto value = number(word.substr(equals + 1), 255);
  if (stick == sticks.end() || !value) return false;
  pad.sticks[static_cast<std::size_t>(stick - sticks.begin())] = static_cast<std::uint8_t>(*value);
  pad.is_analog = true;
  return true;
}

}  // namespace

base::Result<PadScript> parse_pad_script(std::string_view text) {
  PadScript script;
  bool is_analog = false;
  for (const auto part : split(text, ',')) {
    const auto colon = part.find(':');
    const auto frame =
        colon == std::string_view::npos ? std::nullopt : number(part.substr(0, colon), 1'000'000'000);
    if (!frame) {
      return base::fail("--pad: \"" + std::string(part) + "\": expected FRAME:BUTTON+BUTTON, as 30:UP+X");
    }
    PadState pad;
    for (const auto word : split(part.substr(colon + 1), '+')) {
      if (!word.empty() && !hold(pad, word)) {
        return base::fail(
            "--pad: \"" + std::string(word) +
            "\": expected UP, DOWN, LEFT, RIGHT, TRIANGLE, CIRCLE, CROSS, SQUARE, L1, L2, L3, R1, R2, "
            "R3, START, SELECT, or a stick LX, LY, RX, RY = 0..255");
      }
    }
    is_analog = is_analog || pad.is_analog;
    script[*frame] = pad;
  }
  for (auto& [frame, pad] : script) pad.is_analog = is_analog;
  return script;
}

std::string to_text(const PadScript& script) {
  std::string text;
  for (const auto& [frame, pad] : script) {
    if (!text.empty()) text.push_back(',');
    text.append(std::to_string(frame)).push_back(':');
    const auto add = [&text](std::string_view word) {
      if (text.back() != ':') text.push_back('+');
      text.append(word);
    };
    for (const auto& button : buttons) {
      if ((pad.buttons & button.bit) != 0) add(button.name);
    }
    for (std::size_t i = 0; i < sticks.size(); ++i) {
      if (pad.sticks[i] != middle)
        add(std::string(sticks[i]).append("=").append(std::to_string(pad.sticks[i])));
    }
  }
  return text;
}

PadState at_frame(const PadScript& script, std::uint32_t frame) {
  const auto next = script.upper_bound(frame);
  if (next != script.begin()) return std::prev(next)->second;
  PadState nothing;
  nothing.is_analog = !script.empty() && script.begin()->second.is_analog;
  return nothing;
}

PadAnswer answer(const PadState& pad) {
  const auto held = static_cast<std::uint16_t>(~pad.buttons);  // a bit is 0 while its button is held
  const std::uint8_t kind = pad.is_analog ? PAD_ID_ANALOG << 4 | 3 : PAD_ID_DIGITAL << 4 | 1;
  return {{0, kind, static_cast<std::uint8_t>(held), static_cast<std::uint8_t>(held >> 8), pad.sticks[0],
           pad.sticks[1], pad.sticks[2], pad.sticks[3]},
          pad.is_analog ? std::size_t{8} : std::size_t{4}};
}

PadAnswer no_answer() { return {{0xff}, 1}; }

}  // namespace sdk
