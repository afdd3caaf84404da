#pragma once
// Keys that a live program's emulator is to see: what SDL calls them, and what X11 does.

#include <SDL.h>

#include <cstdint>
#include <string_view>

namespace app {

/// X11's keysym of a key; 0: it has none here.
std::uint32_t x11_keysym(SDL_Keycode key);
/// "F1" .. "F12".
bool is_function_key(std::string_view name);

}  // namespace app
