#pragma once
// A clip drawn and watched: for every command what it is, where it comes from, which pixels it wrote and
// which of them are still seen; what any filter leaves of them; the picture after any of them.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "debug/clip.h"
#include "debug/edits.h"
#include "gpu/gpu.h"
#include "gpu/trace.h"
#include "inspect/report.h"

namespace debug {

struct ViewOptions {
  std::optional<gpu::DepthOptions> depth{};
  inspect::Order order = inspect::Order::list;
  std::string source{};
  std::uint64_t frame = 0;
};

/// One item of the clip, in the order drawn.
struct Row {
  std::size_t item = 0;      ///< index into the clip without edits
  std::uint32_t number = 0;  ///< K of F:K
  std::uint32_t bucket = gpu::no_bucket;
  std::uint32_t first_draw = 0, draws = 0;  ///< in the trace; a polyline has one for each segment
  std::uint64_t written = 0;                ///< pixels, those written twice counted twice
  std::uint64_t seen = 0;                   ///< pixels of VRAM that hold what it wrote
  std::uint64_t wrong = 0;                  ///< pixels where it is seen and should not be
  bool is_drawing = false, is_control = false;
  std::string text{};   ///< the command in words
  std::string fault{};  ///< what is suspicious about it, of the list in RAM or why it drew nothing; or empty
};

/// What to show of the rows; the default is everything.
struct Filter {
  std::string text{};  ///< in the command's words, its number or its origin
  std::optional<gpu::Kind> kind{};
  std::optional<std::uint32_t> page{};  ///< texture page halfword, bits 0-4 and 7-8
  std::optional<std::uint32_t> clut{};  ///< halfword, bits 0-14
  std::optional<gpu::Blend> blend{};    ///< opaque: not semi-transparent
  std::optional<std::uint32_t> bucket{};
  std::optional<inspect::Rectangle> rectangle{};  ///< of VRAM: it wrote a pixel in there
  bool only_drawing = false, only_seen = false, only_wrong = false, only_faulty = false;
  bool operator==(const Filter&) const = default;
};

/// Rows in a row, with nothing between them that changes what they draw with: of a list without buckets.
struct Group {
  std::size_t first = 0, count = 0;  ///< rows
  std::string text;
};

class FrameView {
 public:
  FrameView(Clip clip, ViewOptions options);

  /// Draws again with these.
  void set_edits(const Edits& edits);
  [[nodiscard]] const Edits& edits() const { return edits_; }
  [[nodiscard]] const Clip& clip() const { return clip_; }
  /// With the edits.
  [[nodiscard]] const Clip& edited() const { return edited_.clip; }
  [[nodiscard]] const Item& item(const Row& row) const { return clip_.items[row.item]; }

  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  /// Indices of the rows that are left.
  [[nodiscard]] std::vector<std::size_t> filtered(const Filter& filter) const;
  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  /// Drawing commands in each bucket; empty without a table.
  [[nodiscard]] std::span<const std::uint32_t> buckets() const { return buckets_; }
  /// The row of an item; nothing if edits leave it out.
  [[nodiscard]] std::optional<std::size_t> row_of_item(std::size_t item) const;
  /// Whose pixel is seen at VRAM pixel y * 1024 + x; nothing: nobody's of this frame.
  [[nodiscard]] std::optional<std::size_t> row_at(std::uint32_t pixel) const;
  [[nodiscard]] std::optional<std::size_t> row_of_draw(std::uint32_t draw) const;

  [[nodiscard]] const gpu::Gpu& gpu() const { return gpu_; }
  [[nodiscard]] const gpu::Trace& trace() const { return trace_; }
  [[nodiscard]] const gpu::FrameEnd& end() const { return end_; }
  [[nodiscard]] const gpu::Primitive* primitive(const Row& row) const;
  /// VRAM when all rows before `count` were drawn. A z-buffer's second pass comes last.
  [[nodiscard]] std::vector<std::uint16_t> vram_after(std::size_t count) const;
  /// Where in the VRAM pixels lie that the row wrote, each once.
  [[nodiscard]] std::vector<std::uint32_t> pixels_of(const Row& row) const;

  /// Which pixels of `picture` are wrong and why; judged when first asked for. Row::wrong counts after that.
  const inspect::Report& report(const inspect::Rectangle& picture);

 private:
  void draw();
  void make_rows();
  void make_groups();
  [[nodiscard]] bool passes(const Row& row, const Filter& filter) const;
  [[nodiscard]] bool wrote_in(const Row& row, const inspect::Rectangle& rectangle) const;
  [[nodiscard]] std::span<const gpu::Event> events_of(const Row& row) const;

  Clip clip_;
  ViewOptions options_;
  Edits edits_;
  Edited edited_;
  gpu::Gpu gpu_;
  gpu::Trace trace_;
  gpu::FrameEnd end_;
  std::vector<std::uint32_t> first_draws_;  // of each edited item
  std::vector<Row> rows_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> buckets_;
  std::vector<std::size_t> row_of_draw_;
  std::optional<inspect::Report> report_;
};

/// "page 640,256, 4 bits": what a texture page halfword or draw mode word says.
std::string page_text(std::uint32_t word);

}  // namespace debug
