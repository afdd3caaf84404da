#include "inspect/history.h"

#include <algorithm>

#include "base/printed.h"
#include "inspect/truth.h"

namespace inspect {
namespace {

using gpu::Kind;
using gpu::Primitive;

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
    lines_.push_back(base::printed("pixel (%d,%d) of frame %u, VRAM (%u,%u)", x, y, report_.frame,
                                   pixel_ % gpu::Vram::width, pixel_ / gpu::Vram::width));
    for (const gpu::Event& event : trace_.history) {
      if (event.pixel == pixel_) all_.push_back(as_fragment(event));
    }
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
  /// With the half of a quad that folds over itself here.
  [[nodiscard]] std::string name(const Fragment& f) const {
    return name(f.draw) + half_name(is_folded(all_, f.draw), f.half);
  }
  [[nodiscard]] std::string at_depth(const Fragment& f) const {
    return f.draw == nobody ? name(f) : name(f) + base::printed(" at depth %.4f", surfaces_.depth(f, pixel_));
  }
  static Fragment as_fragment(const gpu::Event& e) {
    return {e.draw, e.depth, e.fragment, e.half, e.blended, e.rejected, false};
  }

  void tell(const gpu::Event& event) {
    const Primitive& p = trace_.draws[event.draw];
    const Fragment f = as_fragment(event);
    std::string line = base::printed("  %zu. %s %s ", lines_.size(), name(f).c_str(), kind_of(p).c_str());
    if (event.rejected) {
      line += base::printed("lost the depth test with %04X", event.fragment);
    } else if (event.blended) {
      line += base::printed("blended %04X with %04X to %04X", event.fragment, event.before, event.after);
    } else {
      line += base::printed("wrote %04X over %04X", event.after, event.before);
    }
    if (!event.rejected) blended_over_ = event.blended ? blended_over_ + 1 : 0;
    begin_anew(event, p);
    if (p.kind == Kind::polygon && p.has_depth) {
      fragments_.push_back(f);
      ++all_of_depth_;
      line += base::printed(", depth %.4f", surfaces_.depth(f, pixel_));
      if (event.depth != 0) line += base::printed(", stored key %u", event.depth);
    }
    lines_.push_back(std::move(line));
  }

  /// What the event hides is not judged any more.
  void begin_anew(const gpu::Event& event, const Primitive& p) {
    if (hides(event, p) == Hides::nothing) return;
    background_ = event.draw;
    hidden_ = hidden_ || !fragments_.empty();
    if (hides(event, p, report_.order) == Hides::erases) fragments_.clear();
    for (Fragment& f : fragments_) f.covered = true;
  }

  /// What lies under the polygons that are judged.
  [[nodiscard]] std::string background() const {
    if (background_ == nobody) return "what was there before the frame";
    const std::string kind = kind_of(trace_.draws[background_]);
    return name(background_) + (kind == "upload" ? ", an " : ", a ") + kind;
  }
  [[nodiscard]] std::string shown(const Fragment& f) const {
    return f.draw == nobody ? background() : at_depth(f);
  }

  void verdict() {
    if (all_of_depth_ == 0) {
      lines_.emplace_back("  no polygon with depth is here: nothing to judge");
      return;
    }
    const Verdict v = judge(fragments_, pixel_, surfaces_);
    if (v.is_right()) {
      lines_.push_back("  right: " + what_is_right(v));
      return;
    }
    const auto wrong = std::find_if(report_.wrong.begin(), report_.wrong.end(),
                                    [&](const WrongPixel& w) { return w.pixel == pixel_; });
    const auto cause = wrong == report_.wrong.end() ? std::nullopt : wrong->causes.first();
    std::string line = "  wrong: ";
    if (!v.shows_owner) {
      line += "shows " + shown(v.winner) + ", should show " + at_depth(v.owner);
    } else {
      line += "shows " + (v.winner.draw == nobody ? background() : name(v.winner)) + ", but " +
              shown(v.over) + (v.over.draw == nobody ? " hides " : " was drawn over ") + at_depth(v.under);
    }
    if (cause) line.append(": ").append(inspect::name(*cause));
    lines_.push_back(std::move(line));
  }

  [[nodiscard]] std::string what_is_right(const Verdict& v) const {
    const std::string over =
        blended_over_ == 0 ? "" : base::printed(" under %zu blended over it", blended_over_);
    const bool is_erased = background_ != nobody && trace_.draws[background_].kind > Kind::line;
    const std::string hidden = is_erased ? "erased" : "covered by a layer";
    if (v.winner.draw != nobody) {
      return "shows " + name(v.winner) + over +
             (hidden_ ? "; what was there before " + background() + ", is " + hidden : "");
    }
    return "shows " + background() + over + (hidden_ ? "; what was there before it is " + hidden : "");
  }

  const Report& report_;
  const gpu::Trace& trace_;
  std::uint32_t pixel_;
  Surfaces surfaces_;
  std::vector<Fragment> all_, fragments_;  // of every event; those that are judged, as in Fragments
  std::size_t all_of_depth_ = 0;           // fragments of polygons with depth
  std::uint32_t background_ = nobody;      // the last draw that hid what was before it
  bool hidden_ = false;                    // and there was something
  std::size_t blended_over_ = 0;           // since the last opaque write
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
