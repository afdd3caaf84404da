#pragma once
// One emulated GPU behind the C library and the plugin: ports, lists, depth of vertices, knobs, recording and
// trace put together.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "door/annotator.h"
#include "door/frame_tap.h"
#include "door/frames.h"
#include "door/recorder.h"
#include "gpu/gpu.h"
#include "gpu/pixel_counts.h"
#include "ot/tables.h"
#include "ot/walker.h"

namespace door {

enum class TraceMode : std::uint8_t { off, writers, history };

struct ListResult {
  ot::WalkResult walk;
  std::vector<ot::FoundTable> tables;
};

class Device {
 public:
  void gp0(std::span<const std::uint32_t> words) {
    if (is_plain_) return gpu_.gp0(words);
    gp0_watched(words);
  }
  /// Words go to the GPU and to nobody else.
  [[nodiscard]] bool is_plain() const { return is_plain_; }
  void gp1(std::uint32_t word);
  std::uint32_t read();
  void read(std::span<std::uint32_t> words);
  [[nodiscard]] std::uint32_t status();
  void vblank();

  /// Sends a list up to its fault. `ram`: a power of two of words.
  ListResult send_list(std::span<const std::uint32_t> ram, std::uint32_t head, std::uint32_t max_nodes);

  void vertex(std::uint32_t xy, std::uint32_t z, std::uint8_t fx, std::uint8_t fy);
  [[nodiscard]] bool has_vertices() const { return has_vertices_; }
  [[nodiscard]] const DepthShares& depth() const { return annotator_.shares(); }

  [[nodiscard]] gpu::Gpu& gpu() { return gpu_; }
  [[nodiscard]] const gpu::Gpu& gpu() const { return gpu_; }
  [[nodiscard]] base::Picture picture() { return frames_.picture(gpu_); }

  [[nodiscard]] std::vector<std::byte> save();
  [[nodiscard]] std::optional<gpu::StateError> load(std::span<const std::byte> state);

  [[nodiscard]] const scene::Knobs& knobs() const { return frames_.knobs(); }
  base::Result<void> use(const scene::Knobs& knobs);

  [[nodiscard]] bool is_recording() const { return recorder_.has_value(); }
  void begin_recording(std::string path);
  /// Error: nothing is being recorded, or the file cannot be written.
  base::Result<void> end_recording();

  /// Hands frames to somebody who looks on, until stop_watching().
  void watch(std::function<bool()> wants, std::function<void(LiveFrame)> take);
  void stop_watching();
  /// Of watch(): frames handed over so far.
  [[nodiscard]] std::uint64_t watched_frames() const { return tap_ ? tap_->frames() : 0; }

  void trace(TraceMode mode);
  /// nullptr while nothing is traced.
  [[nodiscard]] const gpu::Trace* trace() const { return trace_.get(); }

  /// What was counted since the last call; the first begins the count.
  gpu::PixelCounts take_pixel_counts();

 private:
  void gp0_watched(std::span<const std::uint32_t> words);
  void send(std::span<const std::uint32_t> words);
  void send_run(std::span<const std::uint32_t> words);
  void release_held();
  void choose_path();

  gpu::Gpu gpu_;
  Annotator annotator_;
  Frames frames_;
  std::optional<Recorder> recorder_;
  std::optional<FrameTap> tap_;
  std::unique_ptr<gpu::Trace> trace_;
  std::unique_ptr<gpu::PixelCounts> counts_;
  bool is_plain_ = true;  // nothing but the GPU wants the words
  bool has_vertices_ = false;
};

}  // namespace door
