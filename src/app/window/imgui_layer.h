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
  /// Letters so many times as large as designed.
  void set_scale(float scale);
  static constexpr int designed_letter_width = 7;
  /// Of one letter, in pixels: they are all as wide.
  [[nodiscard]] static float letter_width();
  /// Shows the event to ImGui, but for Tab, with which ImGui would go from field to field: it is the
  /// window's.
  static void take(const SDL_Event& event);
  /// Begins a frame of widgets.
  static void begin();
  /// Draws what was built since begin().
  void end();

 private:
  SDL_Renderer* renderer_;
  SDL_Texture* font_ = nullptr;
  float letter_pixels_ = 0;
};

}  // namespace app
