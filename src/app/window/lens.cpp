#include "app/window/lens.h"

#include <algorithm>
#include <utility>

#include "app/commands/describe.h"
#include "app/order_of.h"
#include "app/window/inspection.h"
#include "debug/number.h"
#include "display/scanout.h"
#include "ot/gp0.h"
#include "scene/plan.h"

namespace app {
namespace {

// What was selected before, in a frame that has taken its place.
std::optional<std::size_t> find_again(const debug::Clip& before, const debug::Clip& now, std::size_t item) {
  if (item >= before.items.size()) return std::nullopt;
  const auto& old = before.items[item];
  const auto same = [&old](const debug::Item& other) {
    return old.origin.empty() ? other.number == old.number && other.is_rest == old.is_rest
                              : other.origin == old.origin;
  };
  const auto found = std::find_if(now.items.begin(), now.items.end(), same);
  if (found == now.items.end()) return std::nullopt;
  return static_cast<std::size_t>(found - now.items.begin());
}

// To which group each row belongs.
std::vector<std::uint32_t> groups_of(const debug::FrameView& view) {
  std::vector<std::uint32_t> group(view.rows().size());
  if (view.clip().buckets != 0) {
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = view.rows()[i].bucket;
    return group;
  }
  for (std::size_t g = 0; g < view.groups().size(); ++g) {
    const auto& one = view.groups()[g];
    for (std::size_t i = one.first; i < one.first + one.count; ++i) group[i] = static_cast<std::uint32_t>(g);
  }
  return group;
}

}  // namespace

base::Result<bool> Lens::update(WindowState& state, Subject& subject) {
  auto& lens = state.lens;
  const bool is_same = (view_ || has_failed_) && scene_ == state.scene && frame_ == state.frame &&
                       knobs_ == state.knobs && camera_ == state.camera;
  if (is_same) {
    if (has_failed_ || view_->edits() == lens.edits) return false;
    view_->set_edits(lens.edits);
    return true;
  }
  const bool is_same_subject = scene_ == state.scene;
  scene_ = state.scene;
  frame_ = state.frame;
  knobs_ = state.knobs;
  camera_ = state.camera;
  auto clip = subject.clip(frame_, knobs_, camera_);
  has_failed_ = !clip;
  if (!clip) {
    view_.reset();
    return tl::make_unexpected(clip.error());
  }
  area_ = subject.area();
  if (view_ && lens.selected) {
    lens.selected = is_same_subject ? find_again(view_->clip(), *clip, *lens.selected) : std::nullopt;
  }
  lens.edits = {};
  lens.shown.reset();
  view_ = std::make_unique<debug::FrameView>(
      std::move(*clip), debug::ViewOptions{scene::depth_options(knobs_),
                                           order_of(knobs_.visibility),
                                           {},
                                           static_cast<std::uint64_t>(std::max<std::int64_t>(frame_, 0))});
  return true;
}

std::vector<std::uint16_t> Lens::vram(const WindowState& state) const {
  if (!view_) return {};
  return view_->vram_after(state.lens.shown.value_or(view_->rows().size()));
}

std::optional<base::Picture> Lens::picture(const WindowState& state) const {
  const bool is_own = !state.lens.shown && state.lens.edits.is_empty();
  if (!view_ || is_own || area_.width <= 0 || area_.height <= 0) return std::nullopt;
  return display::scan_out(vram(state), area_);
}

const inspect::Report& Lens::report() const {
  return view_->report({area_.x, area_.y, area_.width, area_.height});
}

std::string Lens::number(const debug::Row& row) const {
  return debug::to_text(
      debug::Number{static_cast<std::uint64_t>(std::max<std::int64_t>(frame_, 0)), row.number, row.bucket});
}

void take_step(WindowState& state, Lens& lens, Step step) {
  auto* view = lens.view();
  if (view == nullptr) return;
  if (step.by == StepBy::wrong) lens.report();
  const auto rows = view->rows();
  const auto groups = groups_of(*view);
  const auto stops = [&](std::size_t shown) {  // after so many rows
    if (step.by == StepBy::command) return true;
    if (step.by == StepBy::wrong) return shown != 0 && rows[shown - 1].wrong != 0;
    return shown == 0 || groups[shown] != groups[shown - 1];
  };
  state.paused = true;
  auto shown = state.lens.shown.value_or(rows.size());
  if (step.is_forward && shown == rows.size()) shown = 0;
  do {
    if (step.is_forward ? shown == rows.size() : shown == 0) break;
    step.is_forward ? ++shown : --shown;
  } while (shown != 0 && shown != rows.size() && !stops(shown));
  state.lens.shown = shown == rows.size() ? std::nullopt : std::optional(shown);
  if (shown == 0) return;
  const auto& last = rows[shown - 1];
  state.lens.selected = last.item;
  state.lens.open_bucket = groups[shown - 1];
}

void pick(LensState& lens, const debug::FrameView& view, std::uint32_t pixel) {
  lens.pinned = pixel;
  const auto row = view.row_at(pixel);
  lens.selected = row ? std::optional(view.rows()[*row].item) : std::nullopt;
  if (row) lens.open_bucket = groups_of(view)[*row];
}

std::vector<TableLine> table_lines(const debug::FrameView& view, const LensState& lens) {
  const auto groups = groups_of(view);
  const bool opens_all = !(lens.filter == debug::Filter{});
  std::vector<TableLine> lines;
  std::size_t head = 0;
  for (const auto row : view.filtered(lens.filter)) {
    const auto group = groups[row];
    if (lines.empty() || lines[head].group != group) {
      head = lines.size();
      lines.push_back({true, group, row, 0});
    }
    ++lines[head].count;
    if (opens_all || lens.open_bucket == group) lines.push_back({false, group, row, 0});
  }
  return lines;
}

Shares shares_of(const debug::Clip& clip) {
  Shares shares;
  for (const auto& item : clip.items) {
    const auto at = item.command_at();
    if (!item.is_drawing() || ot::gp0::command_of(item.words[at]) != ot::gp0::Command::polygon) continue;
    ++shares.polygons;
    if (at != 0) ++shares.with_depth;
    if (item.bucket != gpu::no_bucket) ++shares.in_buckets;
  }
  return shares;
}

std::string to_text(const Shares& shares) {
  if (shares.polygons == 0) return "no polygons";
  const auto percent = [&](std::size_t part) -> std::string {
    if (part == 0 || part == shares.polygons) return part == 0 ? "none" : "all";
    const auto rounded = (part * 200 + shares.polygons) / (2 * shares.polygons);
    return std::to_string(std::clamp<std::size_t>(rounded, 1, 99)) + " %";
  };
  return with_commas(shares.polygons) + " polygons: " + percent(shares.with_depth) + " with depth, " +
         percent(shares.in_buckets) + " in buckets";
}

std::vector<Bar> histogram(const debug::FrameView& view, std::size_t columns) {
  const auto buckets = view.buckets();
  const auto count = std::min(columns, buckets.size());
  std::vector<Bar> bars(count);
  for (std::size_t c = 0; c < count; ++c) {
    auto& bar = bars[c];
    bar.first = static_cast<std::uint32_t>(c * buckets.size() / count);
    bar.last = static_cast<std::uint32_t>((c + 1) * buckets.size() / count - 1);
    bar.fullest = bar.first;
    for (auto b = bar.first; b <= bar.last; ++b) {
      bar.commands += buckets[b];
      if (buckets[b] > buckets[bar.fullest]) bar.fullest = b;
    }
  }
  return bars;
}

}  // namespace app
