// Any bytes as a recording that is debugged: its frames are the same whether its packets come at once or one
// by one, every moment that is sought is that of a plain replay, and a slice replays to what it was cut for.

#include "debug/timeline.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "debug/slice.h"
#include "dump/compression.h"
#include "dump/frames.h"

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{1} << 17;

std::vector<std::size_t> ends_of(const dump::Frames& frames) {
  std::vector<std::size_t> ends;
  for (std::uint64_t n = 1; n <= frames.count(); ++n) ends.push_back(frames.end(n));
  return ends;
}

void find_frames(const dump::Dump& dump) {
  using Rest = dump::Frames::Rest;
  dump::Frames frames(dump::FrameBy::display);
  dump::Dump part;
  for (const auto& packet : dump.packets) {
    part.add(packet.type, dump.payload(packet));
    const auto told = ends_of(frames);
    const bool was_settled = frames.is_settled();
    const bool holds = frames.extend(part, Rest::to_come);
    const auto now = ends_of(frames);
    if (was_settled && !holds) std::abort();
    if (holds && (now.size() < told.size() || !std::equal(told.begin(), told.end(), now.begin())))
      std::abort();
  }
  frames.extend(part, Rest::nothing);
  if (ends_of(frames) != ends_of(dump::Frames(dump))) std::abort();
}

void seek(debug::Timeline& timeline, const dump::Dump& dump, std::uint64_t frame) {
  static gpu::Gpu gpu;
  gpu = gpu::Gpu();
  (void)dump::replay(dump, gpu, {.end_packet = timeline.frame(frame).end_packet});
  const auto& sought = timeline.seek({.frame = frame, .command = debug::whole_frame});
  if (!std::ranges::equal(std::as_const(gpu).vram().pixels(), sought.vram().pixels())) std::abort();
  for (const auto& command : timeline.commands(frame)) (void)debug::describe(dump, command);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  dump::DumpReader reader(most_bytes);
  const auto unpacked = dump::unpack_to(
      bytes, [&](std::span<const std::byte> more) { return reader.feed(more); }, most_bytes);
  if (!unpacked) return 0;
  auto dump = reader.finish();
  if (!dump || dump->packets.size() > 2000) return 0;
  find_frames(*dump);
  debug::Timeline timeline{debug::Recording(*dump)};
  const auto frames = timeline.frames();
  for (const auto frame : {frames, std::uint64_t{1}, (frames + 1) / 2}) seek(timeline, *dump, frame);
  const std::uint32_t pixel = size == 0 ? 0 : data[size - 1] * 1024U + data[size / 2];
  const auto slice = debug::slice(timeline, frames, std::vector{pixel, pixel + 1});
  if (!slice && slice.error().text.find("error of ours") != std::string::npos) std::abort();
  return 0;
}
