#pragma once
// Where the picture goes in the window.

namespace app {

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Rect&) const = default;
};

/// Places a picture in an area: enlarged by whole numbers, centred, the rest letterbox. A television shows
/// every mode at 4:3, so pixels of 512 and 640 columns are half as wide and those of 480 lines half as high
/// as the others'. Only an area smaller than the picture gets a fraction; it is never empty.
Rect place(int picture_width, int picture_height, Rect area);

/// The area that `place` fills exactly at `scale` times the smallest whole size.
Rect wanted_area(int picture_width, int picture_height, int scale);

/// The same at the largest scale up to `scale`, at least 1, that leaves it within `room`.
Rect wanted_area_within(int picture_width, int picture_height, int scale, Rect room);

}  // namespace app
