#pragma once
// SDL's objects, owned.

#include <SDL.h>

#include <memory>

namespace app {

struct SdlDelete {
  void operator()(SDL_Window* p) const { SDL_DestroyWindow(p); }
  void operator()(SDL_Renderer* p) const { SDL_DestroyRenderer(p); }
  void operator()(SDL_Texture* p) const { SDL_DestroyTexture(p); }
  void operator()(SDL_GameController* p) const { SDL_GameControllerClose(p); }
};
template <class T>
using Owned = std::unique_ptr<T, SdlDelete>;

/// SDL itself, from init to quit. `ok` false: SDL_GetError() says why.
struct SdlSession {
  bool ok;
  SdlSession() {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // Ctrl-C ends the program with 130, as everywhere
    ok = SDL_Init(SDL_INIT_VIDEO) == 0;
    if (ok) SDL_InitSubSystem(SDL_INIT_GAMECONTROLLER);  // without one the keyboard serves
  }
  ~SdlSession() { SDL_Quit(); }
  SdlSession(const SdlSession&) = delete;
  SdlSession& operator=(const SdlSession&) = delete;
};

}  // namespace app
