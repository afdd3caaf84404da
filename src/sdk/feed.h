#pragma once
// What the program sends to the two ports of the GPU goes through here: into the GPU, with depth where it is
// known, and into the recording.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "dump/bucket_note.h"
#include "dump/dump.h"
#include "gpu/canvas/options.h"
#include "gpu/gpu.h"
#include "machine/canvas_place.h"
#include "ot/command_stream.h"
#include "sdk/depth_notes.h"
#include "sdk/program_lint.h"

namespace sdk {

/// Words that a program sent in a row, all of one packet or of none.
struct SentWords {
  bool is_control = false;  ///< one word of port 1
  std::uint32_t bucket = gpu::no_bucket;
  std::uint32_t table = 0, table_length = 0;  ///< that the bucket counts in; length 0: none
  std::uint32_t address = 0;                  ///< of the packet's tag; 0: it lies in no packet
  CallSite site = nullptr;                    ///< that linked it; nullptr: not known
  std::vector<std::uint32_t> words{};         ///< with annotations
};

class Feed {
 public:
  Feed(gpu::Gpu& gpu, DepthNotes& depth, ProgramLint& lint) : gpu_(gpu), depth_(depth), lint_(lint) {}

  /// What the GPU gets besides the program's own words.
  struct Targets {
    bool annotate = false;         ///< depth before each polygon
    bool depth_of_bucket = false;  ///< polygons without depth get that of their bucket
    /// The accurate target; its size is that of the drawing area it is put over.
    std::optional<gpu::canvas::Options> canvas;
  };
  void set_targets(const Targets& targets) { targets_ = targets; }

  /// Records from now on. The depth words that the GPU gets are recorded only if asked for.
  void record(bool with_depth);
  /// The recording so far; nothing without record().
  [[nodiscard]] const std::optional<dump::Dump>& recording();

  /// Where the packets to come hang: entry `bucket` of the ordering table at `address`. Length 0: in none.
  struct Hook {
    std::uint32_t bucket = gpu::no_bucket, address = 0, length = 0;
  };
  void hang(const Hook& hook) { hook_ = hook; }
  /// From now on what is sent is kept, frame by frame, with annotations and where it comes from.
  void keep() { keeps_ = true; }
  /// What was kept since the last call.
  std::vector<SentWords> take() { return std::exchange(kept_, {}); }

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
  [[nodiscard]] std::optional<machine::Corner> canvas_corner() const { return corner_; }
  /// Why there is no canvas though the targets had one: it would have been too large.
  [[nodiscard]] const std::optional<base::Error>& canvas_fault() const { return canvas_fault_; }

 private:
  void command(std::span<const std::uint32_t> words, std::uint32_t address);
  void place_canvas();
  void check_texture(std::span<const std::uint32_t> words);
  void end_frame();
  void send(std::span<const std::uint32_t> words, bool is_depth = false);
  void flush();
  void note_bucket();
  void keep(std::span<const std::uint32_t> words, bool is_control);

  gpu::Gpu& gpu_;
  DepthNotes& depth_;
  ProgramLint& lint_;
  Targets targets_;
  ot::CommandStream stream_;  // where commands begin
  bool frame_is_open_ = false, canvas_is_open_ = false;
  std::optional<machine::Corner> corner_;
  std::optional<base::Error> canvas_fault_;
  std::uint64_t without_depth_ = 0;
  std::optional<dump::Dump> dump_;
  bool records_depth_ = false;
  std::vector<std::uint32_t> unrecorded_;  // of port 0
  Hook hook_;
  dump::BucketNote noted_;
  std::uint32_t packet_ = 0;  // address of its tag
  bool keeps_ = false;
  std::vector<SentWords> kept_;
};

}  // namespace sdk
