#include "app/commands/recorded.h"

#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/shown.h"
#include "app/commands/without_depth.h"
#include "debug/clip.h"
#include "display/scanout.h"
#include "machine/present.h"

namespace app {

base::Result<std::unique_ptr<debug::Timeline>> open_at_frame(Source& source, const scene::Knobs& knobs,
                                                             std::uint64_t frame, DrawnTo drawn_to) {
  warn_of_idle_knobs(source.name, knobs, drawn_to);
  auto timeline = open_timeline(source, knobs);
  if (!timeline) return timeline;
  const Interrupt interrupt;
  Progress progress("read", 1000);
  const auto goes_on = [&](double done) {
    progress.at(static_cast<std::size_t>(done * 1000));
    const bool is_found = (*timeline)->is_numbered() && (*timeline)->frames() >= frame;
    return !interrupt.was_asked() && !is_found;
  };
  if (auto read = (*timeline)->read_all(goes_on); !read) return tl::make_unexpected(read.error());
  if (interrupt.was_asked()) return base::fail("interrupted", base::Exit::interrupted);
  warn_of_fault(**timeline);
  if (frame < 1 || frame > (*timeline)->frames())
    return base::fail("--frame " + std::to_string(frame) + ": " + source.name + " has the frames 1.." +
                      std::to_string((*timeline)->frames()));
  return timeline;
}

namespace {

// What the display shows of a program with two buffers was drawn some frames ago: a canvas is sought there.
constexpr std::uint64_t buffers = 4;

base::Result<base::Picture> canvas_picture(debug::Timeline& timeline, const std::string& source,
                                           std::uint64_t frame, const scene::Knobs& knobs, Shown shown,
                                           const std::string& output) {
  display::Area area;
  for (auto number = frame;; --number) {
    gpu::Gpu gpu;
    const auto drawn = draw_clip(debug::clip_of(timeline, number), knobs, gpu, nullptr);
    if (!drawn) return tl::make_unexpected(drawn.error());
    if (number == frame) {
      if (auto judged = judge_without_depth(source, knobs, {drawn->end, frame}); !judged)
        return tl::make_unexpected(judged.error());
      area = shown_area(gpu, shown);
      if (area.width <= 0 || area.height <= 0) return shown_picture(gpu, output);
    }
    const bool is_last = number == 1 || frame - number + 1 == buffers;
    if (is_last || is_on_canvas(*drawn, gpu, area)) return picture_of_clip(*drawn, gpu, area, knobs);
  }
}

}  // namespace

base::Result<base::Picture> recorded_picture(debug::Timeline& timeline, const std::string& source,
                                             std::uint64_t frame, const scene::Knobs& knobs, Shown shown,
                                             const std::string& output) {
  if (asks_for_canvas(knobs)) return canvas_picture(timeline, source, frame, knobs, shown, output);
  const auto& gpu = timeline.seek({frame, debug::whole_frame});
  if (auto judged = judge_without_depth(source, knobs, {timeline.frame_end(), frame}); !judged)
    return tl::make_unexpected(judged.error());
  if (shown != Shown::drawn) {
    return shown_picture(gpu, output).map([&](const base::Picture& picture) {
      return machine::Presenter::show(picture, knobs);
    });
  }
  return picture_of_clip({}, gpu, shown_area(gpu, shown), knobs);
}

void add_shown_option(Arguments& arguments, std::string& shown) {
  arguments.choice("--shown", shown, {"drawn", "display"},
                   "recording with two buffers: the one drawn to, or what the display shows [display; with "
                   "knobs that VRAM cannot hold: drawn]");
}

cost::RecordedFrame recorded_frame(debug::Timeline& timeline, const std::string& name, std::uint64_t frame) {
  cost::RecordedFrame recorded{.name = name,
                               .frame = static_cast<std::uint32_t>(frame),
                               .before = timeline.seek({frame, 0}).save(),
                               .pieces = {},
                               .depth = timeline.options().depth};
  const auto area = display::area_of(timeline.seek({frame, debug::whole_frame}).display());
  recorded.width = area.width;
  recorded.height = area.height;
  const debug::Frame& span = timeline.frame(frame);
  const auto& commands = timeline.commands(frame);
  // Until the first command of the frame what goes on from the frame before.
  debug::Place rest_end{span.end_packet, 0};
  if (!commands.empty()) {
    const auto& first = commands.front();
    rest_end = first.begin.packet < span.first_packet ? first.end : first.begin;
  }
  const auto add = [&](bool is_control, bool is_rest, std::span<const std::uint32_t> words) {
    if (words.empty()) return;
    auto& pieces = recorded.pieces;
    if (pieces.empty() || pieces.back().is_control != is_control || pieces.back().is_rest != is_rest)
      pieces.push_back({is_control, is_rest, {}});
    pieces.back().words.insert(pieces.back().words.end(), words.begin(), words.end());
  };
  const dump::Dump& dump = timeline.dump();
  for (std::size_t n = span.first_packet; n < span.end_packet; ++n) {
    const auto& packet = dump.packets[n];
    const auto payload = dump.payload(packet);
    if (packet.type == dump::PacketType::port1) add(true, false, payload);
    if (packet.type != dump::PacketType::port0) continue;
    const std::size_t rest = n < rest_end.packet    ? payload.size()
                             : n == rest_end.packet ? std::min<std::size_t>(rest_end.word, payload.size())
                                                    : 0;
    add(false, true, payload.first(rest));
    add(false, false, payload.subspan(rest));
  }
  return recorded;
}

}  // namespace app
