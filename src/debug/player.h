#pragma once
// A recording on its way into a GPU, from place to place.

#include <functional>
#include <optional>

#include "debug/frames.h"
#include "debug/recording.h"
#include "gpu/depth.h"
#include "gpu/gpu.h"

namespace debug {

/// How a recording is drawn: nothing of it is the console.
struct DrawOptions {
  std::optional<gpu::DepthOptions> depth{};  ///< a z-buffer, fed by annotation words
  bool depth_of_bucket = false;  ///< polygons without depth get that of their bucket (RAM lists with a table)
  bool operator==(const DrawOptions&) const = default;
};

class Player {
 public:
  /// At the beginning. `recording` and `frames`, where its frames end, must outlive it; `options` may differ
  /// from player to player.
  Player(const Recording& recording, const dump::Frames& frames, const DrawOptions& options);

  [[nodiscard]] const gpu::Gpu& gpu() const { return gpu_; }
  [[nodiscard]] gpu::Gpu& gpu() { return gpu_; }
  [[nodiscard]] Place place() const { return place_; }
  /// Words of the frame at hand have been sent; a z-buffer's second pass is still to come.
  [[nodiscard]] bool is_in_frame() const { return is_in_frame_; }
  /// What became of the polygons of the frame that ended last.
  [[nodiscard]] const gpu::FrameEnd& frame_end() const { return frame_end_; }

  /// Goes on to `end`, which is not before place(). Words that end a frame end it, and its field. Asked after
  /// some hundred words: false stops there.
  void run(Place end, const std::function<bool()>& keep_going = {});
  /// Ends the frame at hand, as the packet that ends it would, the field apart: for frames that nothing ends,
  /// and to see a z-buffered frame that is drawn in part (the player cannot go on from there).
  void end_frame();
  /// Goes on from a place where the state was saved.
  void restore(std::span<const std::byte> state, Place place, bool is_in_frame);

 private:
  void send(std::size_t packet, std::uint32_t first, std::uint32_t end);
  void send_words(std::span<const std::uint32_t> words, std::uint32_t first);
  void begin_frame();

  const Recording& recording_;
  const dump::Frames& frames_;
  DrawOptions options_;
  gpu::Gpu gpu_;
  Place place_;
  bool is_in_frame_ = false;
  gpu::FrameEnd frame_end_;
};

}  // namespace debug
