#pragma once
// The table of span kernels for the processor at hand.

#include <span>
#include <string_view>
#include <vector>

#include "gpu/job.h"
#include "gpu/mode.h"
#include "gpu/watch.h"

namespace gpu {

/// Draws the spans in order. Pixels of one call must not be texels of the same call.
using Kernel = void (*)(const Job& job, std::span<const Span> spans);

/// One kernel per Mode::index().
using KernelTable = std::array<Kernel, Mode::count>;

/// One pixel after the other, left to right, each seeing what the one before it wrote: for textures that lie
/// where the primitive draws, and for whoever watches. All modes in one body, decided at run time; no kernel
/// has a trace.
void draw_in_order(const Mode& mode, const Job& job, std::span<const Span> spans);
void draw_watched(const Mode& mode, const Job& job, std::span<const Span> spans, const Watch& watch);

/// The table for the best target of this processor, or the one chosen by use_target.
const KernelTable& kernels();

/// What is done to whole blocks and rows. Rows of blocks are Vram::width apart, from the top, inside VRAM; up
/// to Vram::padding halfwords behind a row are read, and kept.
struct Operations {
  void (*fill)(std::uint16_t* to, int width, int height, std::uint16_t value);
  /// A row is read whole before it is written; the rows may overlap.
  void (*copy)(std::uint16_t* to, const std::uint16_t* from, int width, int height);
  /// For depths in fixed point: leaves out spans, of `least` pixels or more, that lose the depth test
  /// everywhere, and cuts what loses it at their start. Returns how many are left, at the front.
  std::size_t (*cut_hidden)(const DepthJob& depth, std::span<Span> spans, int least);
};
const Operations& operations();

/// The dispatch target in use: "avx512", "avx2", "sse4" or "scalar".
std::string_view target_name();
/// Targets this processor runs, best first; one of them for all later drawing, of every Gpu. False: it is not
/// one of them.
std::vector<std::string_view> target_names();
bool use_target(std::string_view name);

}  // namespace gpu
