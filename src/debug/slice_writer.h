#pragma once
// The commands of a slice as a dump: the registers they were drawn under, the pieces of uploads that are
// needed, and what is shown in the end.

#include <cstdint>
#include <map>
#include <vector>

#include "debug/needs.h"
#include "debug/slice.h"
#include "gpu/gpu.h"

namespace debug {

/// A rectangle of VRAM with its pixels, rows from the top.
struct UploadPiece {
  int x = 0, y = 0, width = 0;
  std::vector<std::uint16_t> pixels;
  [[nodiscard]] int height() const { return static_cast<int>(pixels.size()) / width; }
};

/// Rectangles that hold all `needed` pixels (y * 1024 + x), and of `known` ones a few between them where that
/// takes fewer words than another upload. `known`: what may be sent.
std::vector<UploadPiece> cut_upload(const std::map<std::uint32_t, std::uint16_t>& needed,
                                    const std::map<std::uint32_t, std::uint16_t>& known);

class SliceWriter {
 public:
  SliceWriter(Timeline& timeline, Slice& slice) : timeline_(timeline), slice_(slice) {}

  /// Resets the GPU, and sends what is needed of a VRAM that was not black.
  void begin(const Needs& needs);
  /// In the order of the recording.
  void add(std::uint64_t frame, const Kept& kept);
  /// What the recording shows at the end of `frame`.
  void end(std::uint64_t frame);

 private:
  void port0(std::span<const std::uint32_t> words);
  void port1(std::uint32_t word);
  void vsync();
  void upload(const std::map<std::uint32_t, std::uint16_t>& needed,
              const std::map<std::uint32_t, std::uint16_t>& known);
  void set_registers(const gpu::Gpu& original, const Kept& kept, std::uint32_t first_word);
  void set_skipped_rows(const gpu::Gpu& original);

  Timeline& timeline_;
  Slice& slice_;
  gpu::Gpu gpu_;  // as the slice leaves it
  bool has_palette_ = false;
  std::vector<std::uint32_t> held_;  // words of port 0 that are not in a packet yet
  void flush();
};

}  // namespace debug
