#pragma once
// What of the keyboard and of game controllers is the console's controller, for a program that has one.

#include <array>
#include <cstdint>
#include <string_view>

#include "app/window/sdl.h"

namespace app {

/// One controller of the console. `buttons`: 1 while held, in the order of its answer: select, L3, R3, start,
/// up, right, down, left, L2, R2, L1, R1, triangle, circle, cross, square.
struct PadHeld {
  std::uint16_t buttons = 0;
  std::array<std::uint8_t, 4> sticks{128, 128, 128, 128};  ///< right x, y, left x, y; 0..255
  bool is_analog = false;
  bool operator==(const PadHeld&) const = default;
};

/// A key of the keyboard: its name is SDL's, and no key of app::bindings() but those with modifiers is one.
struct PadKey {
  std::string_view key;
  std::uint16_t button;
  std::string_view name;  ///< of the button
};
inline constexpr std::array pad_keys{
    PadKey{"Up", 1 << 4, "up"},        PadKey{"Right", 1 << 5, "right"},
    PadKey{"Down", 1 << 6, "down"},    PadKey{"Left", 1 << 7, "left"},
    PadKey{"W", 1 << 12, "triangle"},  PadKey{"D", 1 << 13, "circle"},
    PadKey{"S", 1 << 14, "cross"},     PadKey{"A", 1 << 15, "square"},
    PadKey{"R", 1 << 10, "L1"},        PadKey{"F", 1 << 8, "L2"},
    PadKey{"U", 1 << 11, "R1"},        PadKey{"J", 1 << 9, "R2"},
    PadKey{"Return", 1 << 3, "start"}, PadKey{"Backspace", 1 << 0, "select"},
};
/// Whether it is a key of the console's controller.
bool is_pad_key(std::string_view key);

/// What is held now: of the keyboard unless `is_typing`, and of the first game controller that is there.
PadHeld held_pad(bool is_typing);

}  // namespace app
