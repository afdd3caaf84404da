// Any bytes as a GPU dump, packed or plain: refused with an offset, or replayed whole, and then frame by
// frame with everybody watching, as `otter inspect` does: commands may lie across the border of two frames.

#include "dump/dump.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "dump/compression.h"
#include "inspect/history.h"
#include "inspect/json.h"
#include "inspect/maps.h"
#include "inspect/report.h"

namespace {

// A history of so many events is judged in milliseconds.
constexpr std::int64_t history_bytes = std::int64_t{1} << 20;

void observe(const gpu::Trace& trace, const gpu::Gpu& gpu, inspect::Order order) {
  const auto report = inspect::inspect(trace, {.order = order});
  (void)inspect::to_json(report);
  (void)inspect::to_text(report);
  (void)inspect::heatmap(report, gpu.vram().pixels());
  (void)inspect::overdraw(report, trace);
  (void)inspect::ids(report, trace);
  (void)inspect::truth_image(report, trace, gpu.vram().pixels());
  (void)inspect::depth_image(report, trace);
  for (int x = 0; x < report.picture.width; x += 97) {
    (void)inspect::pixel_history(report, trace, x, report.picture.height / 3);
  }
}

void inspect_frames(const dump::Dump& dump, bool has_depth) {
  static gpu::Gpu gpu;
  static gpu::Trace trace;
  if (has_depth != (gpu.depth_plane() != nullptr)) {
    gpu.set_depth(has_depth ? std::optional(gpu::DepthOptions{}) : std::nullopt);
  }
  gpu.gp1(0);
  trace.keep_history = true;
  trace.allowance = history_bytes;
  std::size_t first = 0;
  for (int frame = 0; frame < 4 && first < dump.packets.size(); ++frame) {
    std::size_t end = first;
    while (end < dump.packets.size() && dump.packets[end++].type != dump::PacketType::vsync) {
    }
    trace.clear();
    gpu.set_trace(frame % 3 == 2 ? nullptr : &trace);  // the third frame is skipped, as by --frame 4
    (void)dump::replay(dump, gpu,
                       {.keep_going = [](std::uint64_t) { return !trace.is_full; },
                        .first_packet = first,
                        .end_packet = end});
    gpu.set_trace(nullptr);
    if (!trace.is_full) observe(trace, gpu, has_depth ? inspect::Order::depth : inspect::Order::list);
    first = end;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A lower limit than the program's keeps one input from taking seconds.
  const auto bytes = std::as_bytes(std::span(data, size));
  dump::DumpReader reader(std::uint64_t{1} << 20);
  const auto unpacked = dump::unpack_to(
      bytes, [&](std::span<const std::byte> more) { return reader.feed(more); }, std::uint64_t{1} << 20);
  if (!unpacked) return 0;
  auto dump = reader.finish();
  if (!dump) return 0;
  if (!dump::parse_dump(dump::write_dump(*dump, dump->format))) std::abort();  // what is written can be read
  // One GPU for all inputs: its pixels are what earlier inputs left, and a new one takes longer than a
  // replay.
  static gpu::Gpu gpu;
  gpu.gp1(0);
  (void)dump::replay(*dump, gpu);
  inspect_frames(*dump, size % 2 == 0);
  return 0;
}
