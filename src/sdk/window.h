#pragma once
// The program's window: its picture, and the keys and controllers that are its pads.

#include <memory>
#include <string>
#include <vector>

#include "app/window/sdl.h"
#include "base/picture.h"
#include "base/result.h"
#include "sdk/pads.h"

namespace sdk {

class Window {
 public:
  /// Error (exit 2): there is no display.
  static base::Result<std::unique_ptr<Window>> open(const std::string& title);

  void show(const base::Picture& picture);
  void set_title(const std::string& title);

  struct Events {
    bool closed = false;
    bool pause = false, step = false;  ///< space; the key N
    bool zbuffer = false;              ///< the key TAB: OT or z-buffer
    bool record = false;               ///< F8
    bool back = false;                 ///< the key B: one second back
    PadState pad;                      ///< as held now
  };
  /// What happened since the last call.
  Events poll();

 private:
  Window() = default;
  [[nodiscard]] PadState held() const;

  std::unique_ptr<app::SdlSession> session_;
  app::Owned<SDL_Window> window_;
  app::Owned<SDL_Renderer> renderer_;
  app::Owned<SDL_Texture> texture_;
  int width_ = 0, height_ = 0;  // of the texture
  std::vector<app::Owned<SDL_GameController>> controllers_;
};

}  // namespace sdk
