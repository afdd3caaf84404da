#pragma once
// A picture as a texture that follows its size.

#include "app/window/layout.h"
#include "app/window/sdl.h"
#include "base/picture.h"

namespace app {

class Screen {
 public:
  void show(SDL_Renderer* renderer, const base::Picture& picture);
  /// Draws the columns from `from` to `to` (0..1 of the width) of the picture where they lie in `place`.
  void draw(SDL_Renderer* renderer, Rect place, double from = 0, double to = 1) const;
  /// Draws a part of the picture, in fractions of its size, over all of `place`.
  void draw_part(SDL_Renderer* renderer, Rect place, double x, double y, double width, double height) const;
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] bool is_empty() const { return texture_ == nullptr; }

 private:
  Owned<SDL_Texture> texture_;
  int width_ = 0, height_ = 0;
};

}  // namespace app
