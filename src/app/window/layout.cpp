#include "app/window/layout.h"

#include <algorithm>
#include <cmath>

#include "gpu/vram.h"

namespace app {

double letter_scale(double dots_per_inch, double pixels_per_point, double text_size) {
  const double by_dots = dots_per_inch >= 96 * 1.5 ? std::round(dots_per_inch / 96 * 4) / 4 : 1;
  const double display = pixels_per_point > 1 ? pixels_per_point : by_dots;
  return std::clamp(display, 1.0, 4.0) * text_size;
}

Rect wanted_area(int picture_width, int picture_height, int scale) {
  const bool narrow = picture_width > 400;  // half-width pixels
  const bool flat = picture_height > 300;   // half-height pixels
  const int across = flat && !narrow ? 2 : 1;
  const int down = narrow && !flat ? 2 : 1;
  return {0, 0, picture_width * across * scale, picture_height * down * scale};
}

Rect wanted_area_within(int picture_width, int picture_height, int scale, Rect room) {
  auto area = wanted_area(picture_width, picture_height, scale);
  while (scale > 1 && (area.width > room.width || area.height > room.height)) {
    area = wanted_area(picture_width, picture_height, --scale);
  }
  return area;
}

Rect place(int picture_width, int picture_height, Rect area) {
  const auto unit = wanted_area(std::max(picture_width, 1), std::max(picture_height, 1), 1);
  const int room_x = std::max(area.width, 1);
  const int room_y = std::max(area.height, 1);
  const int scale = std::min(room_x / unit.width, room_y / unit.height);
  int width = unit.width * scale;
  int height = unit.height * scale;
  if (scale == 0) {  // too small for one to one: shrink, keeping the shape
    const double fraction =
        std::min(room_x / static_cast<double>(unit.width), room_y / static_cast<double>(unit.height));
    width = std::max(static_cast<int>(unit.width * fraction), 1);
    height = std::max(static_cast<int>(unit.height * fraction), 1);
  }
  return {area.x + (area.width - width) / 2, area.y + (area.height - height) / 2, width, height};
}

std::optional<std::uint32_t> VramMapping::pixel_at(int window_x, int window_y) const {
  const double across = (window_x - place.x + 0.5) / std::max(place.width, 1);
  const double down = (window_y - place.y + 0.5) / std::max(place.height, 1);
  if (across < 0 || across >= 1 || down < 0 || down >= 1) return std::nullopt;
  const auto column = static_cast<std::uint32_t>(x + across * width) % gpu::Vram::width;
  const auto row = static_cast<std::uint32_t>(y + down * height) % gpu::Vram::height;
  return row * gpu::Vram::width + column;
}

}  // namespace app
