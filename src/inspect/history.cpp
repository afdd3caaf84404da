#include "inspect/history.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "inspect/truth.h"

namespace inspect {
namespace {

using gpu::Kind;
using gpu::Primitive;

template <class... T>
std::string format(const char* pattern, T... values) {
  std::array<char, 256> line{};
  std::snprintf(line.data(), line.size(), pattern, values...);
  return line.data();
}

std::string kind_of(const Primitive& p) {
  switch (p.kind) {
    case Kind::polygon:
      return p.is_quad() ? "quad" : "triangle";
    case Kind::rectangle:
      return "rectangle";
    case Kind::line:
      return "line";
    case Kind::fill:
      return "fill";
    case Kind::copy:
      return "copy";
    default:
      return "upload";
  }
}

class Historian {
 public:
  Historian(const Report& report, const gpu::Trace& trace, std::uint32_t pixel)
      : report_(report), trace_(trace), pixel_(pixel), surfaces_(trace) {}

  std::vector<std::string> tell(int x, int y) {
    lines_.push_back(format("pixel (%d,%d) of frame %u, VRAM (%u,%u)", x, y, report_.frame,
                            pixel_ % gpu::Vram::width, pixel_ / gpu::Vram::width));
    for (const gpu::Event& event : trace_.history) {
      if (event.pixel == pixel_) tell(event);
    }
    if (lines_.size() == 1) lines_.emplace_back("  nothing was drawn here");
    verdict();
    return std::move(lines_);
  }

 private:
  [[nodiscard]] std::string name(std::uint32_t draw) const {
    return id(report_.frame, draw_id(trace_, draw));
  }
  [[nodiscard]] double depth(std::uint32_t draw) const {
    const auto found =
        std::find_if(fragments_.begin(), fragments_.end(), [&](const Fragment& f) { return f.draw == draw; });
    return found == fragments_.end() ? 0 : surfaces_.depth(*found, pixel_);
  }

  void tell(const gpu::Event& event) {
    const Primitive& p = trace_.draws[event.draw];
    std::string line = format("  %zu. %s %s ", lines_.size(), name(event.draw).c_str(), kind_of(p).c_str());
    if (event.rejected) {
      line += format("lost the depth test with %04X", event.fragment);
    } else if (event.blended) {
      line += format("blended %04X with %04X to %04X", event.fragment, event.before, event.after);
    } else {
      line += format("wrote %04X over %04X", event.after, event.before);
    }
    if (p.kind == Kind::polygon && p.has_depth) {
      const Fragment f{event.draw, event.depth, event.fragment, event.half, event.blended, event.rejected};
      fragments_.push_back(f);
      line += format(", depth %.4f", surfaces_.depth(f, pixel_));
      if (event.depth != 0) line += format(", stored key %u", event.depth);
    }
    lines_.push_back(std::move(line));
  }

  void verdict() {
    if (fragments_.empty()) {
      lines_.emplace_back("  no polygon with depth is here: nothing to judge");
      return;
    }
    const Verdict v = judge(fragments_, pixel_, surfaces_);
    if (v.is_right()) {
      lines_.push_back("  right: shows " + name(v.winner));
      return;
    }
    const auto wrong = std::find_if(report_.wrong.begin(), report_.wrong.end(),
                                    [&](const WrongPixel& w) { return w.pixel == pixel_; });
    const auto cause = wrong == report_.wrong.end() ? std::nullopt : wrong->causes.first();
    std::string line = "  wrong: ";
    if (!v.shows_owner) {
      line += format("shows %s at depth %.4f, should show %s at depth %.4f", name(v.winner).c_str(),
                     depth(v.winner), name(v.owner).c_str(), depth(v.owner));
    } else {
      line += format("shows %s, but %s at depth %.4f was drawn over %s at depth %.4f", name(v.winner).c_str(),
                     name(v.over).c_str(), depth(v.over), name(v.under).c_str(), depth(v.under));
    }
    if (cause) line.append(": ").append(inspect::name(*cause));
    lines_.push_back(std::move(line));
  }

  const Report& report_;
  const gpu::Trace& trace_;
  std::uint32_t pixel_;
  Surfaces surfaces_;
  std::vector<Fragment> fragments_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> pixel_history(const Report& report, const gpu::Trace& trace, int x, int y) {
  const Rectangle& p = report.picture;
  if (x < 0 || y < 0 || x >= p.width || y >= p.height) return {};
  const auto pixel = static_cast<std::uint32_t>(gpu::Vram::offset(p.x + x, p.y + y));
  return Historian(report, trace, pixel).tell(x, y);
}

}  // namespace inspect
