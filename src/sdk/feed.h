#pragma once
// What the program sends to the two ports of the GPU goes through here: into the GPU, with depth where it is
// known, and into the recording.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dump/dump.h"
#include "gpu/canvas/options.h"
#include "gpu/gpu.h"
#include "ot/command_stream.h"
#include "sdk/depth_notes.h"
#include "sdk/program_lint.h"

namespace sdk {

class Feed {
 public:
  Feed(gpu::Gpu& gpu, DepthNotes& depth, ProgramLint& lint) : gpu_(gpu), depth_(depth), lint_(lint) {}

  /// What the GPU gets besides the program's own words.
  struct Targets {
    bool annotate = false;  ///< depth before each polygon
    /// The accurate target; its size is that of the drawing area it is put over.
    std::optional<gpu::canvas::Options> canvas;
  };
  void set_targets(const Targets& targets) { targets_ = targets; }

  /// Records from now on. The depth words that the GPU gets are recorded only if asked for.
  void record(bool with_depth);
  /// The recording so far; nothing without record().
  [[nodiscard]] const std::optional<dump::Dump>& recording();

  void gp1(std::uint32_t word);
  /// Words of GP0 that come from nowhere in particular.
  void gp0(std::span<const std::uint32_t> words);
  /// The payload of a packet; its first word lies at `address`.
  void packet(std::span<const std::uint32_t> words, std::uint32_t address);
  /// GPUREAD, `words.size()` times.
  void read(std::span<std::uint32_t> words);

  /// A vertical blank: what is drawn afterwards is the next frame.
  void next_field();
  /// Of all frames that have ended: polygons that brought no depth to a z-buffer.
  [[nodiscard]] std::uint64_t polygons_without_depth() const { return without_depth_; }
  /// Where the canvas of the frame that ended last lies in VRAM; nothing: no canvas was drawn.
  struct Corner {
    int x = 0, y = 0;
    bool operator==(const Corner&) const = default;
  };
  [[nodiscard]] std::optional<Corner> canvas_corner() const { return corner_; }

 private:
  void command(std::span<const std::uint32_t> words, std::uint32_t address);
  void place_canvas();
  void check_texture(std::span<const std::uint32_t> words);
  void end_frame();
  void send(std::span<const std::uint32_t> words, bool is_depth = false);
  void flush();

  gpu::Gpu& gpu_;
  DepthNotes& depth_;
  ProgramLint& lint_;
  Targets targets_;
  ot::CommandStream stream_;  // where commands begin
  bool frame_is_open_ = false, canvas_is_open_ = false;
  std::optional<Corner> corner_;
  std::uint64_t without_depth_ = 0;
  std::optional<dump::Dump> dump_;
  bool records_depth_ = false;
  std::vector<std::uint32_t> unrecorded_;  // of port 0
};

}  // namespace sdk
