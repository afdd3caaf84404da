#include "app/window/sdl.h"

#include <algorithm>
#include <cstdlib>

namespace app {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

// SDL would try Wayland without a session, which complains on stderr, and then settle for a window in memory.
void choose_video_driver() {
#if defined(__linux__)
  if (is_set("SDL_VIDEODRIVER")) return;
  std::string drivers = is_set("DISPLAY") ? "x11," : "";
  if (is_set("XDG_RUNTIME_DIR")) drivers += "wayland,";
  SDL_SetHint(SDL_HINT_VIDEODRIVER, (drivers + "KMSDRM").c_str());
#endif
}

}  // namespace

SdlSession::SdlSession() {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // Ctrl-C ends the program with 130, as everywhere
  choose_video_driver();
  if (SDL_Init(SDL_INIT_VIDEO) != 0) {
    error_ = is_set("SDL_VIDEODRIVER") || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
                 ? std::string("no display could be opened: ") + SDL_GetError()
                 : "no display: neither DISPLAY nor WAYLAND_DISPLAY is set";
    return;
  }
  SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER);  // without one the keyboard serves
}

double dots_per_inch(SDL_Window* window) {
  float dots = 0;
  const int display = std::max(SDL_GetWindowDisplayIndex(window), 0);
  return SDL_GetDisplayDPI(display, nullptr, &dots, nullptr) == 0 ? double{dots} : 96;
}

}  // namespace app
