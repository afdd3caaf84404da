#pragma once
// SDL's objects, owned.

#include <SDL.h>

#include <memory>
#include <string>

namespace app {

struct SdlDelete {
  void operator()(SDL_Window* p) const { SDL_DestroyWindow(p); }
  void operator()(SDL_Renderer* p) const { SDL_DestroyRenderer(p); }
  void operator()(SDL_Texture* p) const { SDL_DestroyTexture(p); }
  void operator()(SDL_GameController* p) const { SDL_GameControllerClose(p); }
};
template <class T>
using Owned = std::unique_ptr<T, SdlDelete>;

/// SDL itself, from init to quit. A display that nobody can see ("offscreen") counts only if SDL_VIDEODRIVER
/// asks for it.
class SdlSession {
 public:
  SdlSession();
  ~SdlSession() { SDL_Quit(); }
  SdlSession(const SdlSession&) = delete;
  SdlSession& operator=(const SdlSession&) = delete;

  /// False: error() says why.
  [[nodiscard]] bool is_open() const { return error_.empty(); }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  std::string error_;
};

/// What a display asks letters to be, before what the user asks.
double dots_per_inch(SDL_Window* window);

}  // namespace app
