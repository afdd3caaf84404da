#pragma once
// What goes into a GPU, frame by frame, for somebody who looks on.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "door/live.h"
#include "gpu/gpu.h"
#include "ot/command_stream.h"
#include "ot/tables.h"

namespace door {

/// A frame ends where the display turns to another buffer; at a vertical blank behind something drawn, for a
/// program that has not done so for some time; and at the latest after half a second. It begins between two
/// commands.
class FrameTap {
 public:
  /// `wants`: asked when a frame begins; false lets it pass. `take`: gets the frames.
  FrameTap(std::function<bool()> wants, std::function<void(LiveFrame)> take)
      : wants_(std::move(wants)), take_(std::move(take)) {}

  /// Before words are sent to the GPU: begins a frame, if that is possible now. False: it is not, and what
  /// comes belongs to none.
  bool catch_up(const gpu::Gpu& gpu);
  void gp0(std::span<const std::uint32_t> words);
  /// `gpu`: as it is before the word.
  void gp1(std::uint32_t word, const gpu::Gpu& gpu);
  void vblank();
  /// The GPU was given another state than the words led to.
  void jump();

  /// The words to come are those of the packet at `tag` of a list with these tables, or of no list.
  void begin_list(std::span<const ot::FoundTable> tables, std::vector<inspect::LintItem> lint);
  void set_tag(std::uint32_t tag);
  void end_list();

  /// Told with the next frame.
  void set_recording(bool is_recording) { is_recording_ = is_recording; }
  void set_doubtful(std::uint64_t polygons) { doubtful_ = polygons; }
  [[nodiscard]] bool is_collecting() const { return is_collecting_; }
  /// Frames handed over so far.
  [[nodiscard]] std::uint64_t frames() const { return handed_; }

 private:
  struct Place {
    bool is_list = false;
    std::uint32_t tag = 0, table = 0, bucket = gpu::no_bucket;
    bool operator==(const Place&) const = default;
  };

  void add(bool is_control, std::span<const std::uint32_t> words);
  void note(std::span<const std::uint32_t> words);
  void end_frame();

  std::function<bool()> wants_;
  std::function<void(LiveFrame)> take_;
  LiveFrame frame_;
  std::vector<std::uint32_t> run_tables_;  // of each run of frame_: index into tables_
  std::vector<ot::FoundTable> tables_;     // of the frame
  std::size_t list_tables_ = 0;            // where those of the list at hand begin
  Place place_;
  ot::CommandStream stream_;  // of everything, whether it is kept or not
  std::uint64_t number_ = 0, handed_ = 0, doubtful_ = 0, doubtful_before_ = 0;
  unsigned fields_ = 0;           // of this frame
  unsigned fields_of_flip_ = 99;  // since the display turned to another buffer
  bool has_drawn_ = false, has_begun_ = false, is_collecting_ = false, is_recording_ = false;
};

}  // namespace door
