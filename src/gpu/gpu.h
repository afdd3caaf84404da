#pragma once
// The console's depthless 2D GPU: words in, pixels out, to the bit.
// [docs/hardware.md]
//
// Beyond the console, and only when asked: a z-buffer fed by annotation words, and a trace of who wrote what.
// Not modelled: time (every command completes at once, so the FIFO is always empty), the texture cache
// (texels are read from VRAM as it is), the second megabyte of VRAM.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gpu/columns.h"
#include "gpu/counters.h"
#include "gpu/depth.h"
#include "gpu/display.h"
#include "gpu/pixel_counts.h"
#include "gpu/primitive.h"
#include "gpu/trace.h"
#include "gpu/transfer.h"
#include "gpu/vram.h"

namespace gpu {

namespace canvas {
class Canvas;
struct Options;
}  // namespace canvas

/// What became of the polygons of a z-buffered frame.
struct FrameEnd {
  std::uint32_t polygons_without_depth = 0;  ///< drawn in list order, neither tested nor stored
  std::uint32_t first_without_depth = 0;     ///< of the first, if any: Primitive::command_number
  std::uint32_t queued = 0;                  ///< semi-transparent polygons drawn in the second pass
};

/// Why bytes are not a state: what was expected and what was there, and the first byte that is wrong.
struct StateError {
  std::string message;
  std::uint64_t offset = 0;
};

class DepthQueue;
struct Surface;

class Gpu {
 public:
  /// As after GP1(00h), VRAM all zero.
  Gpu();
  ~Gpu();
  Gpu(Gpu&&) noexcept;
  Gpu& operator=(Gpu&&) noexcept;

  /// GP0: commands and their data. A command may be split between calls in any way; any word is accepted.
  void gp0(std::uint32_t word) { gp0(std::span(&word, 1)); }
  void gp0(std::span<const std::uint32_t> words);

  /// GP1: control.
  void gp1(std::uint32_t word);

  /// GPUREAD: the next two pixels of a VRAM->CPU transfer, else what GP1(10h) latched.
  std::uint32_t read();

  /// GPUSTAT of a GPU that is never busy. Bit 31, the lowest bit of the line being displayed, has no line to
  /// follow here: it changes with every vertical blank, so that a program that waits for it goes on.
  [[nodiscard]] std::uint32_t status() const;

  /// The next word of GP0 begins a command.
  [[nodiscard]] bool is_between_commands() const {
    return gathered_count_ == 0 && !polyline_open_ && !upload_.is_active();
  }

  [[nodiscard]] Vram& vram() { return vram_; }
  [[nodiscard]] const Vram& vram() const { return vram_; }
  [[nodiscard]] const Display& display() const { return display_; }
  [[nodiscard]] const DrawState& state() const { return current_.state; }
  [[nodiscard]] const ClutCache& palette() const { return clut_; }

  /// Polygons draw inside these limits only; nothing: everywhere. The columns stay the
  /// caller's, until the next call. On a canvas its own pixels are meant, and it may have one sample each.
  void set_limits(std::optional<Limits> limits) { limits_ = limits; }

  /// A vertical blank: an interlaced picture goes on with its other field.
  void next_field();

  // --- z-buffer ---

  /// Sets the depth stage of VRAM; nothing is the console. Allocates or frees the depth plane; drops what is
  /// queued.
  void set_depth(const std::optional<DepthOptions>& options);
  /// Depth (20.12) of polygons that bring none; nothing: they are counted as polygons without depth. The
  /// caller may change it before every node it feeds.
  void set_default_depth(std::optional<std::uint32_t> z) { default_depth_ = z; }
  /// Restarts command numbers. z-buffer: empties depths, forgets the queue. A canvas is placed over the
  /// frame, whose top left pixel is x, y of VRAM.
  void begin_frame(int x = 0, int y = 0);
  /// In a frame, what a fill, copy or upload writes begins anew: its depths are emptied.
  /// z-buffer, of VRAM or of a canvas: draws the queued semi-transparent polygons, far to near.
  FrameEnd end_frame();
  /// nullptr without set_depth.
  [[nodiscard]] const DepthPlane* depth_plane() const { return depth_.get(); }

  // --- accurate target ---

  /// Sets the target beside VRAM; nothing is the console. Primitives whose drawing area touches the canvas
  /// are drawn there instead of in VRAM; fills, copies and uploads act on both. Allocates, and drops what is
  /// queued, unless the options are those it has.
  void set_canvas(const std::optional<canvas::Options>& options);
  /// nullptr without set_canvas.
  [[nodiscard]] canvas::Canvas* canvas() { return canvas_.get(); }
  [[nodiscard]] const canvas::Canvas* canvas() const { return canvas_.get(); }

  // --- saved states ---

  /// All that the words to come depend on: VRAM, registers, the CLUT cache, what is half sent, half received
  /// or half annotated; of a z-buffered frame the depth plane and the queue. 1 MiB and about 1 KiB, 3 MiB
  /// with a depth plane. Not in it: what the caller set (depth stage, canvas, limits, default depth, trace,
  /// counters).
  [[nodiscard]] std::vector<std::byte> save() const;
  /// Goes on where save() was called, in this or another process, on any machine. What the caller set stays.
  /// A depth plane goes on only in a GPU with the same depth options; with others the plane begins empty, and
  /// without one the queue is drawn at once. A canvas takes its picture from VRAM.
  /// Returns an error for a state of another version, cut short or damaged; the GPU is then as it was.
  [[nodiscard]] std::optional<StateError> load(std::span<const std::byte> bytes);

  // --- watching ---

  /// nullptr: nobody watches and nothing is paid. May change, or begin anew, in the middle of a command.
  /// Polygons that wait in the queue are the first draws of a trace that is set.
  void set_trace(Trace* trace);
  [[nodiscard]] Trace* trace() const { return trace_; }
  /// nullptr: nobody counts and nothing is paid. The caller owns it and keeps it alive.
  void set_pixel_counts(PixelCounts* counts);
  [[nodiscard]] const Counters& counters() const { return counters_; }
  void reset_counters() { counters_ = {}; }
  /// Bytes held besides VRAM, by purpose: depth plane, queue.
  [[nodiscard]] std::uint64_t depth_bytes() const { return depth_ ? depth_->bytes() : 0; }
  [[nodiscard]] std::uint64_t queue_bytes() const;

 private:
  /// What E7h-EFh said about the next polygon, as it came.
  struct Annotation {
    std::array<std::uint32_t, 10> words;  // by code, E7h first; [9]: the second E7h
    std::uint32_t seen = 0;               // bit n: words[n] came
  };

  // port.cpp: the GP0 state machine
  const std::uint32_t* run_commands(const std::uint32_t* at, const std::uint32_t* end);
  const std::uint32_t* gather(const std::uint32_t* at, const std::uint32_t* end);
  const std::uint32_t* continue_polyline(const std::uint32_t* at, const std::uint32_t* end);
  void execute(const std::uint32_t* words);
  const std::uint32_t* annotate(const std::uint32_t* at, const std::uint32_t* end);
  void set_attribute(std::uint32_t word);
  void abort_command();

  // draw.cpp: one function per kind of command
  void polygon(const std::uint32_t* words);
  [[nodiscard]] bool tests_depth() const;
  void draw_either(const Surface& surface, const Primitive& polygon, Pass pass);
  void rectangle(const std::uint32_t* words);
  void line(const std::uint32_t* words);
  void line_segment();
  void fill(const std::uint32_t* words);
  void copy(const std::uint32_t* words);
  void begin_upload(const std::uint32_t* words);
  void begin_download(const std::uint32_t* words);
  const std::uint32_t* upload(const std::uint32_t* at, const std::uint32_t* end);
  [[nodiscard]] std::uint32_t allowed_mode(std::uint32_t word) const;
  void use_texture_page(std::uint32_t halfword);
  void take_depth();
  void begin_command();
  void note(Kind kind);
  void follow_trace();
  [[nodiscard]] Surface surface();
  // canvas/port.cpp
  [[nodiscard]] bool draw_on_canvas(const Surface& surface, const Primitive& primitive, Pass pass);
  void transfer_to_canvas();

  // frame.cpp
  void draw_with_depth();
  void draw_queue();
  void draw_queue_in_order();
  void note_queue();

  // save.cpp
  struct Saved;

  /// Of an upload that its trace does not know: it becomes a draw when it goes on.
  static constexpr std::uint32_t no_draw = 0xffffffff;

  // control.cpp
  void latch_register(std::uint32_t number);
  void update_skipped_rows();

  Vram vram_;
  Display display_;
  // The registers E1h-E6h live in current_.state: the primitive being decoded needs no copy of them.
  Primitive current_;
  Annotation annotation_;
  ClutCache clut_;
  std::array<std::uint32_t, 12> gathered_{};  // the beginning of a command whose rest has not come yet
  std::size_t gathered_count_ = 0;
  bool polyline_open_ = false;
  std::uint32_t polyline_colour_ = 0;  // the gouraud colour that waits for its vertex
  bool polyline_has_colour_ = false;
  Transfer upload_, download_;
  bool texture_disable_allowed_ = false;
  bool irq_ = false;
  std::uint32_t dma_direction_ = 0;
  std::uint32_t latch_ = 0;
  std::uint32_t next_command_ = 0;
  std::optional<Limits> limits_;

  std::optional<std::uint32_t> default_depth_;
  std::unique_ptr<DepthPlane> depth_;
  std::unique_ptr<DepthQueue> queue_;  // only when something is semi-transparent
  FrameEnd frame_;
  Trace* trace_ = nullptr;
  PixelCounts* pixel_counts_ = nullptr;
  bool is_noted_ = false;              // there is a trace or somebody counts: one test a primitive
  std::uint64_t trace_beginning_ = 0;  // Trace::beginnings() when the draw numbers kept here were given
  std::uint32_t current_draw_ = 0;     // number of the primitive last noted
  std::unique_ptr<canvas::Canvas> canvas_;
  Counters counters_;
};

}  // namespace gpu
