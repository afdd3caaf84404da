#pragma once
// The X11 display that an emulator reads its keys from, and keys put into it as if they had been typed there.
// Xlib is looked for when it is needed: without it there is no display, and no keys.

#include <cstdint>

namespace door {

/// Opens the display once; what GPUopen hands back. 0: there is none.
unsigned long open_key_display();
struct Key {
  std::uint32_t keysym;  ///< X11's
  bool is_down;
};
/// The next event of that display. Nothing without a display.
void put_key(Key key);

inline constexpr std::uint32_t keysym_escape = 0xff1b, keysym_f8 = 0xffc5;

}  // namespace door
