#pragma once
// Dear ImGui on an SDL renderer. Its SDL2 platform backend comes with the library; drawing is a few lines
// over SDL_RenderGeometryRaw.

#include <SDL.h>

namespace app {

class ImGuiLayer {
 public:
  /// `window` and `renderer` must outlive the layer; there may be one layer at a time.
  ImGuiLayer(SDL_Window* window, SDL_Renderer* renderer);
  ~ImGuiLayer();
  ImGuiLayer(const ImGuiLayer&) = delete;
  ImGuiLayer& operator=(const ImGuiLayer&) = delete;

  /// Makes the texture of the letters anew: the one before is lost.
  void renew_font();
  /// Shows the event to ImGui.
  void take(const SDL_Event& event);
  /// Begins a frame of widgets; `scale` enlarges letters and is a whole number, so that they stay crisp.
  void begin(float scale);
  /// Draws what was built since begin().
  void end();

 private:
  SDL_Renderer* renderer_;
  SDL_Texture* font_ = nullptr;
};

}  // namespace app
