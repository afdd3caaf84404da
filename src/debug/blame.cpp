#include "debug/blame.h"

#include <array>
#include <cstdio>

#include "gpu/trace.h"

namespace debug {

std::string_view name(gpu::Kind kind) {
  static constexpr std::array<std::string_view, gpu::kind_count> names{"polygon", "rectangle", "line",
                                                                       "fill",    "copy",      "upload"};
  return names[static_cast<std::size_t>(kind)];
}

std::vector<std::optional<Writer>> last_writers(Timeline& timeline, const Number& moment,
                                                std::span<const std::uint32_t> pixels,
                                                const std::function<bool()>& keep_going) {
  std::vector<std::optional<Writer>> writers(pixels.size());
  std::size_t unknown = pixels.size();
  gpu::Trace trace;
  for (std::uint64_t frame = moment.frame; frame >= 1 && unknown != 0; --frame) {
    if (keep_going && !keep_going()) break;
    timeline.watch(frame, trace, frame == moment.frame ? moment.command : whole_frame);
    for (std::size_t n = 0; n < pixels.size(); ++n) {
      const std::uint32_t last = trace.last_writer[pixels[n]];
      if (writers[n] || last == 0) continue;
      const gpu::Primitive& draw = trace.draws[last - 1];
      writers[n] = Writer{number_of(frame, draw), draw.kind};
      --unknown;
    }
  }
  return writers;
}

std::vector<std::string> pixel_events(Timeline& timeline, const Number& moment, std::uint32_t pixel) {
  gpu::Trace trace;
  trace.keep_history = true;
  timeline.watch(moment.frame, trace, moment.command);
  std::vector<std::string> lines;
  for (const gpu::Event& event : trace.history) {
    if (event.pixel != pixel) continue;
    const gpu::Primitive& draw = trace.draws[event.draw];
    std::array<char, 96> text{};
    const auto number = to_text(number_of(moment.frame, draw));
    const auto kind = std::string(name(draw.kind));
    if (event.rejected) {
      std::snprintf(text.data(), text.size(), "%s %s lost the depth test with %04X", number.c_str(),
                    kind.c_str(), static_cast<unsigned>(event.fragment));
    } else if (event.blended) {
      std::snprintf(text.data(), text.size(), "%s %s blended %04X with %04X to %04X", number.c_str(),
                    kind.c_str(), static_cast<unsigned>(event.fragment), static_cast<unsigned>(event.before),
                    static_cast<unsigned>(event.after));
    } else {
      std::snprintf(text.data(), text.size(), "%s %s wrote %04X over %04X", number.c_str(), kind.c_str(),
                    static_cast<unsigned>(event.after), static_cast<unsigned>(event.before));
    }
    lines.emplace_back(text.data());
  }
  if (trace.is_full) lines.push_back("and more: " + trace.limit_text());
  return lines;
}

}  // namespace debug
