#include "app/window/program_keys.h"

#include <algorithm>
#include <array>

namespace app {
namespace {

struct Key {
  SDL_Keycode sdl;
  std::uint32_t x11;
};
constexpr std::array keys{
    Key{SDLK_BACKSPACE, 0xff08}, Key{SDLK_TAB, 0xff09},      Key{SDLK_RETURN, 0xff0d},
    Key{SDLK_ESCAPE, 0xff1b},    Key{SDLK_HOME, 0xff50},     Key{SDLK_LEFT, 0xff51},
    Key{SDLK_UP, 0xff52},        Key{SDLK_RIGHT, 0xff53},    Key{SDLK_DOWN, 0xff54},
    Key{SDLK_PAGEUP, 0xff55},    Key{SDLK_PAGEDOWN, 0xff56}, Key{SDLK_END, 0xff57},
    Key{SDLK_DELETE, 0xffff},    Key{SDLK_LSHIFT, 0xffe1},   Key{SDLK_RSHIFT, 0xffe2},
    Key{SDLK_LCTRL, 0xffe3},     Key{SDLK_RCTRL, 0xffe4},    Key{SDLK_LALT, 0xffe9},
    Key{SDLK_RALT, 0xffea},      Key{SDLK_KP_ENTER, 0xff8d}, Key{SDLK_KP_MULTIPLY, 0xffaa},
    Key{SDLK_KP_PLUS, 0xffab},   Key{SDLK_KP_MINUS, 0xffad}, Key{SDLK_KP_PERIOD, 0xffae},
    Key{SDLK_KP_DIVIDE, 0xffaf}, Key{SDLK_KP_0, 0xffb0},
};

}  // namespace

std::uint32_t x11_keysym(SDL_Keycode key) {
  if (key >= SDLK_SPACE && key < SDLK_DELETE) return static_cast<std::uint32_t>(key);  // as in Latin-1
  if (key >= SDLK_F1 && key <= SDLK_F12) return 0xffbe + static_cast<std::uint32_t>(key - SDLK_F1);
  if (key >= SDLK_KP_1 && key <= SDLK_KP_9) return 0xffb1 + static_cast<std::uint32_t>(key - SDLK_KP_1);
  const auto* found = std::ranges::find(keys, key, &Key::sdl);
  return found == keys.end() ? 0 : found->x11;
}

bool is_function_key(std::string_view name) {
  return name.size() >= 2 && name[0] == 'F' &&
         std::ranges::all_of(name.substr(1), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace app
