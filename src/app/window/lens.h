#pragma once
// One frame, command by command: what the table panel, the VRAM panel and the marks on the picture show.
// Knows neither SDL nor drawing.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/subject.h"
#include "app/window/window_state.h"
#include "base/picture.h"
#include "debug/frame_view.h"

namespace app {

class Lens {
 public:
  /// Takes the frame of `state` apart if it is another one, and draws it again if its edits are others. What
  /// is selected stays so in another frame if something of the same origin is there, and edits go. True:
  /// something changed.
  base::Result<bool> update(WindowState& state, Subject& subject);

  /// nullptr before the first update.
  [[nodiscard]] debug::FrameView* view() const { return view_.get(); }
  /// The picture with the edits and as far as commands are shown; nothing: it is the subject's own.
  [[nodiscard]] std::optional<base::Picture> picture(const WindowState& state) const;
  /// VRAM likewise.
  [[nodiscard]] std::vector<std::uint16_t> vram(const WindowState& state) const;
  /// Which pixels are wrong, and why; rows count theirs once it was asked for.
  const inspect::Report& report() const;
  /// Where in VRAM the picture lies.
  [[nodiscard]] const display::Area& area() const { return area_; }
  /// "F:K" or "F:K:B" of a row.
  [[nodiscard]] std::string number(const debug::Row& row) const;

 private:
  std::unique_ptr<debug::FrameView> view_;
  display::Area area_;
  bool has_failed_ = false;  // it would fail again
  int scene_ = -1;
  std::int64_t frame_ = -1;
  scene::Knobs knobs_;
  CameraOffset camera_;
};

/// Goes on by one command, one group or to the next wrong row, at rest, and selects the row drawn last.
void take_step(WindowState& state, Lens& lens, Step step);

/// A pixel of VRAM was clicked: pins its history, and selects whose it is.
void pick(LensState& lens, const debug::FrameView& view, std::uint32_t pixel);

/// One line of the list: the head of a bucket or group, or a row below it.
struct TableLine {
  bool is_head = false;
  std::uint32_t group = 0;  ///< bucket, or number of the group
  std::size_t row = 0;      ///< of a head the first of its rows
  std::size_t count = 0;    ///< of a head: how many rows there are below it
};
/// Heads in the order drawn, and the rows of the open one; with a filter the rows of all that have any.
std::vector<TableLine> table_lines(const debug::FrameView& view, const LensState& lens);

/// How many of a frame's polygons bring what sorting and z-buffers need.
struct Shares {
  std::size_t polygons = 0, with_depth = 0, in_buckets = 0;
};
Shares shares_of(const debug::Clip& clip);
/// "1,024 polygons: 98 % with depth, 100 % in buckets": what is above none and not all is never told as such.
std::string to_text(const Shares& shares);

/// Drawing commands in `columns` neighbouring parts of the table, bucket 0 first.
struct Bar {
  std::uint32_t first = 0, last = 0;        ///< buckets, both included
  std::uint32_t commands = 0, fullest = 0;  ///< of all; the bucket that holds most of them
};
std::vector<Bar> histogram(const debug::FrameView& view, std::size_t columns);

}  // namespace app
