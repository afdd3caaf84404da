// otter walk: a list in a saved RAM image, checked and drawn.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/ram_image.h"
#include "app/commands/recorded.h"
#include "app/commands/without_depth.h"
#include "base/message.h"
#include "display/png.h"
#include "display/vram_file.h"
#include "gpu/depth.h"
#include "gpu/gpu.h"
#include "gpu/trace.h"
#include "inspect/lint.h"
#include "ot/packet.h"
#include "ot/walker.h"
#include "scene/plan.h"

namespace app {
namespace {

struct WalkOptions {
  std::string image, head, table, vram_in, vram, output;
  scene::Knobs knobs;
};

/// How the drawing packets lie in the buckets, in list order.
struct Buckets {
  std::vector<std::uint32_t> packets;
  std::vector<std::uint32_t> visited;  // entries in the order in which the list passes them

  void print() const {
    const auto used = std::ranges::count_if(packets, [](auto n) { return n > 0; });
    const auto tied = std::ranges::count_if(packets, [](auto n) { return n > 1; });
    const auto fullest = std::ranges::max_element(packets);
    std::printf("buckets: %zu, used %lld, with more than one packet %lld, fullest %lld with %u packets\n",
                packets.size(), static_cast<long long>(used), static_cast<long long>(tied),
                static_cast<long long>(fullest - packets.begin()), *fullest);
    const auto rows = std::min<std::size_t>(packets.size(), 16);
    std::vector<std::uint64_t> sums(rows);
    for (std::size_t b = 0; b < packets.size(); ++b) sums[b * rows / packets.size()] += packets[b];
    const auto most = std::max<std::uint64_t>(1, *std::ranges::max_element(sums));
    for (std::size_t r = 0; r < rows; ++r) {
      const auto first = (r * packets.size() + rows - 1) / rows,
                 next = ((r + 1) * packets.size() + rows - 1) / rows;
      std::printf("  %6zu..%-6zu %7llu %s\n", first, next - 1, static_cast<unsigned long long>(sums[r]),
                  std::string(static_cast<std::size_t>(sums[r] * 40 / most), '#').c_str());
    }
  }

  /// A reversed table is passed from its last entry to its first, a forward one the other way; anything else
  /// draws buckets out of their order.
  [[nodiscard]] std::optional<inspect::LintItem> order() const {
    const bool forward = visited.size() > 1 && visited[1] > visited[0];
    for (std::size_t n = 1; n < visited.size(); ++n) {
      if ((visited[n] > visited[n - 1]) == forward) continue;
      return inspect::LintItem{
          "unsorted", "bucket " + std::to_string(visited[n]),
          "drawn after bucket " + std::to_string(visited[n - 1]) + ", against the order of the table"};
    }
    return std::nullopt;
  }
};

void print_lint(const std::vector<inspect::LintItem>& items) {
  for (const auto& item : items) {
    std::printf("lint: %s %s: %s\n", item.kind.c_str(), item.at.c_str(), item.text.c_str());
  }
}

/// Draws a list that is known to be good. There is no drawing area before the first
/// list sets one: all of VRAM.
gpu::FrameEnd draw(const ot::MainRam& ram, std::uint32_t head, std::uint32_t all_nodes,
                   const std::optional<inspect::TableRange>& table, bool by_bucket, gpu::Gpu& gpu,
                   gpu::Trace& trace, Buckets& buckets) {
  std::array<std::uint32_t, 2> area{};
  ot::encode(ot::DrawArea{}, area);
  gpu.gp0(area);
  gpu.set_trace(&trace);
  gpu.begin_frame();
  if (table) buckets.packets.resize(table->length);
  std::uint32_t nodes = 0;
  Progress progress("walk", all_nodes);
  ot::walk(ram, head, [&](std::uint32_t tag, std::span<const std::uint32_t> payload) {
    progress.at(++nodes);
    if (Interrupt::was_asked() || trace.is_full) return;
    const auto at = tag & (ram.size_bytes() - 4);
    if (table && at >= table->address && (at - table->address) / 4 < table->length) {
      trace.bucket = (at - table->address) / 4;
      buckets.visited.push_back(trace.bucket);
      if (by_bucket) gpu.set_default_depth(gpu::depth_of_bucket(trace.bucket, table->length));
    }
    const auto draws = trace.draws.size();
    gpu.gp0(payload);
    if (trace.draws.size() > draws && trace.bucket < buckets.packets.size()) ++buckets.packets[trace.bucket];
  });
  const auto end = gpu.end_frame();
  gpu.set_trace(nullptr);
  return end;
}

base::Result<int> walk(const WalkOptions& options) {
  const auto visibility = options.knobs.visibility;
  if (visibility != scene::Visibility::ot && visibility != scene::Visibility::zbuffer) {
    return base::fail("--visibility: a list can be drawn by ot, in its own order, or by zbuffer");
  }
  if (auto checked = scene::check_knobs(options.knobs); !checked) return tl::make_unexpected(checked.error());
  const auto image = read_ram_image(options.image, options.head, options.table);
  if (!image) return tl::make_unexpected(image.error());
  const auto& [ram, head, table] = *image;
  if (auto checked = check_without_depth(options.image, options.knobs, table.has_value()); !checked)
    return tl::make_unexpected(checked.error());
  gpu::Gpu gpu;
  const auto vram = read_vram(options.vram_in);
  if (!vram) return tl::make_unexpected(vram.error());
  std::ranges::copy(*vram, gpu.vram().pixels().begin());

  auto lint = inspect::lint_list(ram, head, table);
  const auto walked = ot::validate(ram, head);
  std::printf("%s: %u tags, %u words\n", base::printable(options.image).c_str(), walked.nodes, walked.words);
  if (!walked) {
    print_lint(lint);
    return base::fail(options.image + ": " + walked.message());
  }
  gpu.set_depth(scene::depth_options(options.knobs));
  gpu::Trace trace;
  Buckets buckets;
  const Interrupt interrupt;
  const auto end = draw(ram, head, walked.nodes, table,
                        options.knobs.without_depth == scene::WithoutDepth::bucket, gpu, trace, buckets);
  if (trace.is_full) return base::fail(options.image + ": " + trace.limit_text());
  std::printf("drawing commands: %zu\n", trace.draws.size());
  if (table) buckets.print();
  if (const auto unsorted = buckets.order()) lint.push_back(*unsorted);
  std::ranges::copy(inspect::lint_draws(trace, 1), std::back_inserter(lint));
  print_lint(lint);
  if (auto judged = judge_without_depth(options.image, options.knobs, {end, 1}); !judged)
    return tl::make_unexpected(judged.error());
  if (!options.vram.empty()) {
    if (auto saved = display::save_vram(options.vram, gpu.vram()); !saved)
      return tl::make_unexpected(saved.error());
  }
  if (!options.output.empty()) {
    auto recording = debug::Recording::of_list(*image, *vram);
    if (!recording) return tl::make_unexpected(recording.error());
    debug::Timeline timeline(std::move(*recording), draw_options(options.knobs));
    if (auto first = timeline.read_first_frame(); !first) return tl::make_unexpected(first.error());
    const auto picture =
        recorded_picture(timeline, options.image, 1, options.knobs, Shown::either, options.output);
    if (!picture) return tl::make_unexpected(picture.error());
    if (auto written = display::write_png(options.output, *picture); !written)
      return tl::make_unexpected(written.error());
  }
  if (interrupt.was_asked()) {
    return base::fail("interrupted: what was drawn until then is told and written", base::Exit::interrupted);
  }
  return 0;
}

}  // namespace

Action add_walk(Arguments arguments) {
  const auto options = std::make_shared<WalkOptions>();
  arguments.positional("image", "RAM.bin", options->image, "2 or 8 MiB of main RAM as an emulator saves it",
                       Presence::required);
  arguments.text("--head", "ADDR", options->head, "the first tag of the list, hexadecimal",
                 Presence::required);
  arguments.text("--table", "ADDR,N", options->table,
                 "the ordering table: address of entry 0, number of entries");
  arguments.text("--vram-in", "FILE", options->vram_in, "1 MiB of VRAM to draw into [black]");
  arguments.text("--vram", "FILE", options->vram,
                 "write all of VRAM: FILE.png, or 1 MiB of little-endian halfwords");
  options->knobs.without_depth = foreign_without_depth;
  arguments.text("-o,--output", "FILE", options->output,
                 "write the picture as a PNG: the drawing area of the list");
  arguments.knobs(options->knobs, recording_knobs);
  return [options] { return walk(*options); };
}

}  // namespace app
