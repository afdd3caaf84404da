#pragma once
// Where the picture goes in the window.

#include <cstdint>
#include <optional>

namespace app {

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Rect&) const = default;
};

/// How many times as large as designed (13 pixels high) letters are: `pixels_per_point` where the window
/// system counts in points, or else by the display's dots per inch where these are half as many again as the
/// usual 96; in steps of a quarter, times what the user asks for.
double letter_scale(double dots_per_inch, double pixels_per_point, double text_size);

/// Places a picture in an area: enlarged by whole numbers, centred, the rest letterbox. A television shows
/// every mode at 4:3, so pixels of 512 and 640 columns are half as wide and those of 480 lines half as high
/// as the others'. Only an area smaller than the picture gets a fraction; it is never empty.
Rect place(int picture_width, int picture_height, Rect area);

/// The area that `place` fills exactly at `scale` times the smallest whole size.
Rect wanted_area(int picture_width, int picture_height, int scale);

/// The same at the largest scale up to `scale`, at least 1, that leaves it within `room`.
Rect wanted_area_within(int picture_width, int picture_height, int scale, Rect room);

/// A rectangle of VRAM as it is shown in the window.
struct VramMapping {
  Rect place;                    ///< in the window
  double x = 0, y = 0;           ///< of VRAM, at the place's top left corner
  double width = 1, height = 1;  ///< so much of VRAM is shown
  [[nodiscard]] double to_x(double vram_x) const { return place.x + (vram_x - x) * place.width / width; }
  [[nodiscard]] double to_y(double vram_y) const { return place.y + (vram_y - y) * place.height / height; }
  /// The pixel of VRAM (y * 1024 + x) under a pixel of the window; nothing outside the place.
  [[nodiscard]] std::optional<std::uint32_t> pixel_at(int window_x, int window_y) const;
};

}  // namespace app
