#include "debug/frame_view.h"

#include <algorithm>
#include <map>
#include <utility>

#include "gpu/number.h"
#include "inspect/lint.h"
#include "ot/gp0.h"

namespace debug {
namespace {

constexpr std::uint32_t page_mask =
    ot::gp0::draw_mode::PageX64::mask | ot::gp0::draw_mode::PageY256::mask | ot::gp0::draw_mode::Format::mask;

// Of one frame, beside all else that the window holds.
constexpr std::int64_t trace_bytes = std::int64_t{192} << 20;

std::string lower(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace

std::string page_text(std::uint32_t word) {
  namespace mode = ot::gp0::draw_mode;
  constexpr std::array formats{"4 bits", "8 bits", "15 bits", "15 bits"};
  return "page " + std::to_string(64 * mode::PageX64::get(word)) + "," +
         std::to_string(256 * mode::PageY256::get(word)) + ", " + formats[mode::Format::get(word)];
}

FrameView::FrameView(Clip clip, ViewOptions options) : clip_(std::move(clip)), options_(std::move(options)) {
  trace_.keep_history = true;
  trace_.allowance = trace_bytes;
  set_edits({});
}

void FrameView::set_edits(const Edits& edits) {
  edits_ = edits;
  edited_ = apply(clip_, edits_);
  draw();
}

void FrameView::draw() {
  first_draws_.assign(edited_.clip.items.size() + 1, 0);
  report_.reset();
  end_ = play(edited_.clip, gpu_,
              {.depth = options_.depth, .trace = &trace_, .before = [this](std::size_t item) {
                 first_draws_[item] = static_cast<std::uint32_t>(trace_.draws.size());
               }});
  first_draws_.back() = static_cast<std::uint32_t>(trace_.draws.size());
  // A command that was moved, and those between, keep the numbers they were sent with.
  for (std::size_t i = 0; i < edited_.clip.items.size(); ++i) {
    const auto number = edited_.clip.items[i].number;
    for (auto d = first_draws_[i]; d < first_draws_[i + 1]; ++d)
      trace_.draws[d].command_number = number == 0 ? gpu::going_on : number - 1;
  }
  make_rows();
  make_groups();
}

void FrameView::make_rows() {
  std::vector<std::uint64_t> seen(trace_.draws.size());
  for (const auto writer : trace_.last_writer) {
    if (writer != 0 && writer <= seen.size()) ++seen[writer - 1];
  }
  std::map<std::string, std::string> faults;
  for (const auto& lint : clip_.lint) {
    if (lint.at.empty()) continue;
    auto& text = faults[lint.at];
    text += (text.empty() ? "" : "; ") + lint.kind + ": " + lint.text;
  }
  rows_.clear();
  row_of_draw_.assign(trace_.draws.size(), 0);
  buckets_.assign(clip_.buckets, 0);
  for (std::size_t i = 0; i < edited_.clip.items.size(); ++i) {
    const auto& item = edited_.clip.items[i];
    Row row{.item = edited_.origin[i], .number = item.number, .bucket = item.bucket};
    row.first_draw = first_draws_[i];
    row.draws = first_draws_[i + 1] - first_draws_[i];
    row.is_drawing = item.is_drawing();
    row.is_control = item.is_control;
    row.text = item.text();
    for (std::uint32_t d = row.first_draw; d < row.first_draw + row.draws; ++d) {
      row.written += trace_.written[d];
      row.seen += seen[d];
      row_of_draw_[d] = rows_.size();
    }
    if (const auto fault = faults.find(item.origin); fault != faults.end()) row.fault = fault->second;
    if (row.is_drawing && row.written == 0 && row.draws != 0) {
      row.fault += (row.fault.empty() ? "" : "; ") + inspect::why_nothing(trace_, row.first_draw);
    }
    if (row.is_drawing && row.bucket < buckets_.size()) ++buckets_[row.bucket];
    rows_.push_back(std::move(row));
  }
}

// A group begins where, after something was drawn, a state changes, an upload or a fill comes.
void FrameView::make_groups() {
  groups_.clear();
  bool has_drawn = true;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto* drawn = primitive(rows_[i]);
    const bool is_shape = drawn != nullptr && drawn->kind <= gpu::Kind::line;
    if (!is_shape && has_drawn) groups_.push_back({i, 0, {}});
    if (groups_.empty()) groups_.push_back({i, 0, {}});
    has_drawn = is_shape;
    ++groups_.back().count;
  }
  for (auto& group : groups_) {
    std::size_t shapes = 0, uploads = 0, states = 0;
    std::string page;
    for (std::size_t i = group.first; i < group.first + group.count; ++i) {
      const auto* drawn = primitive(rows_[i]);
      if (drawn == nullptr) {
        ++states;
      } else if (drawn->kind > gpu::Kind::line) {
        ++uploads;
      } else {
        ++shapes;
        if (page.empty() && drawn->is_textured()) page = page_text(drawn->state.draw_mode);
      }
    }
    const auto add = [&group](std::size_t count, const char* one, const char* many) {
      if (count == 0) return;
      group.text += (group.text.empty() ? "" : ", ") + std::to_string(count) + (count == 1 ? one : many);
    };
    add(states, " state", " states");
    add(uploads, " fill, copy or upload", " fills, copies or uploads");
    add(shapes, " shape", " shapes");
    if (!page.empty()) group.text += "; " + page;
  }
}

const gpu::Primitive* FrameView::primitive(const Row& row) const {
  return row.draws == 0 ? nullptr : &trace_.draws[row.first_draw];
}

std::optional<std::size_t> FrameView::row_of_item(std::size_t item) const {
  const auto found =
      std::find_if(rows_.begin(), rows_.end(), [item](const Row& row) { return row.item == item; });
  if (found == rows_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows_.begin());
}

std::optional<std::size_t> FrameView::row_of_draw(std::uint32_t draw) const {
  if (draw >= row_of_draw_.size()) return std::nullopt;
  return row_of_draw_[draw];
}

std::optional<std::size_t> FrameView::row_at(std::uint32_t pixel) const {
  if (pixel >= trace_.last_writer.size() || trace_.last_writer[pixel] == 0) return std::nullopt;
  return row_of_draw(trace_.last_writer[pixel] - 1);
}

// Draws write one after the other, but for a z-buffer's second pass.
std::span<const gpu::Event> FrameView::events_of(const Row& row) const {
  const auto& all = trace_.history;
  if (options_.depth || row.draws == 0) return all;
  const auto earlier = [](const gpu::Event& event, std::uint32_t draw) { return event.draw < draw; };
  const auto begin = std::lower_bound(all.begin(), all.end(), row.first_draw, earlier);
  const auto end = std::lower_bound(begin, all.end(), row.first_draw + row.draws, earlier);
  return {begin, end};
}

bool FrameView::wrote_in(const Row& row, const inspect::Rectangle& rectangle) const {
  if (row.written == 0) return false;
  const auto events = events_of(row);
  return std::any_of(events.begin(), events.end(), [&](const gpu::Event& event) {
    const int x = static_cast<int>(event.pixel % gpu::Vram::width) - rectangle.x;
    const int y = static_cast<int>(event.pixel / gpu::Vram::width) - rectangle.y;
    return !event.rejected && event.draw >= row.first_draw && event.draw < row.first_draw + row.draws &&
           x >= 0 && y >= 0 && x < rectangle.width && y < rectangle.height;
  });
}

bool FrameView::passes(const Row& row, const Filter& filter) const {
  if (filter.only_drawing && !row.is_drawing) return false;
  if (filter.only_seen && row.seen == 0) return false;
  if (filter.only_wrong && row.wrong == 0) return false;
  if (filter.only_faulty && row.fault.empty()) return false;
  if (filter.bucket && row.bucket != *filter.bucket) return false;
  const auto* drawn = primitive(row);
  const bool wants_drawn = filter.kind || filter.page || filter.clut || filter.blend || filter.rectangle;
  if (wants_drawn && drawn == nullptr) return false;
  if (filter.kind && drawn->kind != *filter.kind) return false;
  if ((filter.page || filter.clut) && !drawn->is_textured()) return false;
  if (filter.page && (drawn->state.draw_mode & page_mask) != (*filter.page & page_mask)) return false;
  if (filter.clut && (drawn->clut & 0x7fff) != (*filter.clut & 0x7fff)) return false;
  if (filter.blend) {
    const auto blend = drawn->is_semi_transparent() ? drawn->state.blend() : gpu::Blend::opaque;
    if (blend != *filter.blend) return false;
  }
  if (!filter.text.empty()) {
    const auto wanted = lower(filter.text);
    const auto& origin = clip_.items[row.item].origin;
    const auto number = std::to_string(options_.frame) + ":" + std::to_string(row.number);
    const bool is_found = lower(row.text).find(wanted) != std::string::npos ||
                          lower(origin).find(wanted) != std::string::npos || number == wanted;
    if (!is_found) return false;
  }
  return !filter.rectangle || wrote_in(row, *filter.rectangle);
}

std::vector<std::size_t> FrameView::filtered(const Filter& filter) const {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (passes(rows_[i], filter)) left.push_back(i);
  }
  return left;
}

std::vector<std::uint16_t> FrameView::vram_after(std::size_t count) const {
  const auto pixels = gpu_.vram().pixels();
  std::vector<std::uint16_t> vram(pixels.begin(), pixels.end());
  if (count >= rows_.size()) return vram;
  const auto draw = first_draws_[count];
  const auto first = std::find_if(trace_.history.begin(), trace_.history.end(),
                                  [draw](const gpu::Event& event) { return event.draw >= draw; });
  for (auto event = trace_.history.end(); event != first;) {
    --event;
    vram[event->pixel] = event->before;
  }
  return vram;
}

std::vector<std::uint32_t> FrameView::pixels_of(const Row& row) const {
  std::vector<std::uint32_t> pixels;
  if (row.draws == 0) return pixels;
  for (const auto& event : events_of(row)) {
    if (!event.rejected && event.draw >= row.first_draw && event.draw < row.first_draw + row.draws)
      pixels.push_back(event.pixel);
  }
  std::sort(pixels.begin(), pixels.end());
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

const inspect::Report& FrameView::report(const inspect::Rectangle& picture) {
  if (report_ && report_->picture == picture) return *report_;
  report_ = inspect::inspect(trace_, {.order = options_.order,
                                      .scene = options_.source,
                                      .frame = static_cast<std::uint32_t>(options_.frame),
                                      .picture = picture});
  for (auto& row : rows_) row.wrong = 0;
  for (const auto& wrong : report_->wrong) {
    if (const auto row = row_at(wrong.pixel)) ++rows_[*row].wrong;
  }
  return *report_;
}

}  // namespace debug
