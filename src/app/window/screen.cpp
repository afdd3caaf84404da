#include "app/window/screen.h"

namespace app {

void Screen::show(SDL_Renderer* renderer, const base::Picture& picture) {
  if (picture.pixels.empty()) return;
  if (is_empty() || picture.width != width_ || picture.height != height_) {
    texture_.reset(SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STREAMING,
                                     picture.width, picture.height));
    width_ = picture.width;
    height_ = picture.height;
    if (is_empty()) return;
    SDL_SetTextureScaleMode(texture_.get(), SDL_ScaleModeNearest);
  }
  SDL_UpdateTexture(texture_.get(), nullptr, picture.pixels.data(), picture.width * 4);
}

void Screen::draw(SDL_Renderer* renderer, Rect place, double from, double to) const {
  if (is_empty()) return;
  const int begin = place.x + static_cast<int>(from * place.width);
  const int end = place.x + static_cast<int>(to * place.width);
  if (end <= begin) return;
  const SDL_Rect clip{begin, place.y, end - begin, place.height};
  const SDL_Rect target{place.x, place.y, place.width, place.height};
  SDL_RenderSetClipRect(renderer, &clip);
  SDL_RenderCopy(renderer, texture_.get(), nullptr, &target);
  SDL_RenderSetClipRect(renderer, nullptr);
}

void Screen::draw_part(SDL_Renderer* renderer, Rect place, double x, double y, double width,
                       double height) const {
  if (is_empty()) return;
  const SDL_Rect clip{place.x, place.y, place.width, place.height};
  const auto across = static_cast<float>(place.width / width),
             down = static_cast<float>(place.height / height);
  const SDL_FRect target{static_cast<float>(place.x) - static_cast<float>(x) * across,
                         static_cast<float>(place.y) - static_cast<float>(y) * down, across, down};
  SDL_RenderSetClipRect(renderer, &clip);
  SDL_RenderCopyF(renderer, texture_.get(), nullptr, &target);
  SDL_RenderSetClipRect(renderer, nullptr);
}

}  // namespace app
