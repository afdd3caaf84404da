#include "app/commands/recording.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <vector>

#include "display/scanout.h"
#include "gpu/gpu.h"
#include "machine/machine.h"
#include "ot/main_ram.h"
#include "ot/walker.h"
#include "scene/pipeline.h"

namespace app {
namespace {

constexpr std::uint32_t gpu_version = 2;

/// Appends the payloads of the list in RAM.
base::Result<void> append_list(const ot::MainRam& ram, std::uint32_t head,
                               std::vector<std::uint32_t>& words) {
  const auto walked = ot::walk(ram, head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    words.insert(words.end(), payload.begin(), payload.end());
  });
  if (!walked) return base::fail("the list: " + walked.message(), base::Exit::failed);
  return {};
}

/// Draws every frame twice, live and from the words recorded, and counts where the two differ.
class Comparison {
 public:
  Comparison(const scene::Scene& scene, const scene::Knobs& knobs) : live_(scene), knobs_(knobs) {
    live_.builder(knobs).upload(replay_);
  }

  base::Result<void> frame(std::uint32_t number, const scene::Frame& recorded,
                           std::span<const std::uint32_t> words) {
    const auto drawn = live_.draw(scene::frame_time(number), knobs_);
    if (!drawn) return tl::make_unexpected(drawn.error());
    replay_.gp0(words);
    replay_.gp1(scene::FrameBuilder::show_gp1(recorded));
    cost.pieces += recorded.stats.snapped;
    compare(number);
    return {};
  }

  SnapCost cost;

 private:
  void compare(std::uint32_t number) {
    const auto& live = live_.picture();
    const auto replay = display::scan_out(replay_.vram().pixels(), display::area_of(replay_.display()));
    std::uint64_t pixels = 0;
    for (std::size_t i = 0; i < live.pixels.size(); ++i) {
      const auto &a = live.pixels[i], &b = replay.pixels[i];
      const int difference =
          std::max({std::abs(a.r / 8 - b.r / 8), std::abs(a.g / 8 - b.g / 8), std::abs(a.b / 8 - b.b / 8)});
      if (difference != 0) ++pixels;
      cost.largest = std::max(cost.largest, static_cast<std::uint32_t>(difference));
    }
    cost.pixels += pixels;
    if (pixels > cost.worst_pixels) {
      cost.worst_pixels = pixels;
      cost.worst_frame = number;
    }
  }

  machine::Machine live_;
  gpu::Gpu replay_;
  scene::Knobs knobs_;
};

}  // namespace

base::Result<SnapCost> record(const scene::Scene& scene, std::uint32_t frames, const scene::Knobs& knobs,
                              scene::Annotate annotate, dump::DumpWriter& dump,
                              const std::function<bool()>& frame_done) {
  using dump::PacketType;
  scene::FrameBuilder builder(scene, knobs);
  std::optional<Comparison> comparison;
  if (knobs.visibility == scene::Visibility::bsp) comparison.emplace(scene, knobs);
  ot::MainRam ram(ot::RamSize::mib8);
  dump.add_text(PacketType::comment, "otter: " + scene.name);
  dump.add_text(PacketType::video_format, "NTSC");
  dump.add(PacketType::gpu_version, std::array{gpu_version});
  dump.add(PacketType::port1, std::array{0U});  // reset
  dump.add(PacketType::port0, builder.upload_gp0());
  dump.add(PacketType::port1, builder.display_gp1());
  dump.add(PacketType::trace_begin);
  std::vector<std::uint32_t> words;
  for (std::uint32_t n = 0; n < frames; ++n) {
    words.clear();
    auto frame = builder.build(scene::frame_time(n), knobs, ram, annotate, scene::Pieces::snapped);
    if (!frame) return tl::make_unexpected(frame.error());
    for (;;) {
      if (auto appended = append_list(ram, frame->head, words); !appended) {
        return tl::make_unexpected(appended.error());
      }
      if (frame->nearer_lists == 0) break;
      if (auto next = builder.next(*frame, ram); !next) return tl::make_unexpected(next.error());
    }
    dump.add(PacketType::port0, words);
    dump.add(PacketType::port1, std::array{scene::FrameBuilder::show_gp1(*frame)});
    dump.add(PacketType::vsync);
    if (comparison) {
      if (auto compared = comparison->frame(n, *frame, words); !compared) {
        return tl::make_unexpected(compared.error());
      }
    }
    if (frame_done && !frame_done()) break;
  }
  return comparison ? comparison->cost : SnapCost{};
}

}  // namespace app
