#include "app/recording.h"

#include <array>
#include <vector>

#include "ot/main_ram.h"
#include "ot/walker.h"
#include "scene/pipeline.h"

namespace app {
namespace {

constexpr std::uint32_t gpu_version = 2;

/// Appends the payloads of the list in RAM.
scene::Result<void> append_list(const ot::MainRam& ram, std::uint32_t head,
                                std::vector<std::uint32_t>& words) {
  const auto walked = ot::walk(ram, head, [&](std::uint32_t, std::span<const std::uint32_t> payload) {
    words.insert(words.end(), payload.begin(), payload.end());
  });
  if (!walked) return scene::fail("the list: " + walked.message(), scene::Exit::failed);
  return {};
}

}  // namespace

scene::Result<gpu::Dump> record(const scene::Scene& scene, std::uint32_t frames, const scene::Knobs& knobs,
                                scene::Annotate annotate, const std::function<void()>& frame_done) {
  using gpu::PacketType;
  scene::FrameBuilder builder(scene, knobs);
  ot::MainRam ram(ot::RamSize::mib8);
  gpu::Dump dump;
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
    auto frame = builder.build(scene::frame_time(n), knobs, ram, annotate);
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
    if (frame_done) frame_done();
  }
  return dump;
}

}  // namespace app
