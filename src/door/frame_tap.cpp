#include "door/frame_tap.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "ot/gp0.h"
#include "ot/gp1.h"

namespace door {

namespace {

constexpr unsigned flip_is_past = 30, longest_frame = 30;  // fields
constexpr std::size_t most_lint = 64;                      // of a frame: nobody reads more

/// A z-buffer's keys and queue are nothing to who draws the frame again.
std::vector<std::byte> state_of(const gpu::Gpu& gpu) {
  auto state = gpu.save();
  if (gpu.depth_plane() == nullptr) return state;
  gpu::Gpu plain;
  (void)plain.load(state);
  return plain.save();
}

}  // namespace

bool FrameTap::catch_up(const gpu::Gpu& gpu) {
  if (has_begun_) return true;
  if (!gpu.is_between_commands()) return false;
  has_begun_ = true;
  ++number_;
  stream_ = {};
  frame_ = {};
  run_tables_.clear();
  is_collecting_ = wants_();
  if (is_collecting_) frame_.state = state_of(gpu);
  return true;
}

void FrameTap::note(std::span<const std::uint32_t> words) {
  for (std::size_t n = 0; n < words.size();) {
    const std::size_t pixels = stream_.skip_pixels(words.size() - n);
    n += pixels;
    if (pixels != 0) continue;
    stream_.take(words[n++]);
    has_drawn_ = has_drawn_ || ot::gp0::is_drawing(stream_.command());
  }
}

void FrameTap::add(bool is_control, std::span<const std::uint32_t> words) {
  if (!is_collecting_ || words.empty()) return;
  auto& runs = frame_.runs;
  const LiveRun run{is_control, place_.is_list, place_.tag, place_.bucket,
                    static_cast<std::uint32_t>(words.size())};
  const bool goes_on = !is_control && !runs.empty() && !runs.back().is_control &&
                       runs.back().is_list == run.is_list && runs.back().address == run.address &&
                       runs.back().bucket == run.bucket && run_tables_.back() == place_.table;
  if (goes_on) {
    runs.back().words += run.words;
  } else {
    runs.push_back(run);
    run_tables_.push_back(place_.table);
  }
  frame_.words.insert(frame_.words.end(), words.begin(), words.end());
}

void FrameTap::gp0(std::span<const std::uint32_t> words) {
  if (!has_begun_) return;
  note(words);
  add(false, words);
}

void FrameTap::gp1(std::uint32_t word, const gpu::Gpu& gpu) {
  namespace gp1 = ot::gp1;
  if (gp1::command_of(word) == gp1::Command::display_start &&
      gp1::display_start::All::get(word) != gpu.display().start) {
    fields_of_flip_ = 0;
    if (has_drawn_) end_frame();
  }
  if (!catch_up(gpu)) return;
  add(true, std::span(&word, 1));
  if (gp1::aborts_command(word)) stream_.abort();
}

void FrameTap::vblank() {
  ++fields_;
  fields_of_flip_ = std::min(fields_of_flip_ + 1, 2 * flip_is_past);
  const bool is_flipping = fields_of_flip_ < flip_is_past;
  if (has_begun_ && ((has_drawn_ && !is_flipping) || fields_ >= longest_frame)) end_frame();
}

void FrameTap::jump() {
  has_begun_ = is_collecting_ = has_drawn_ = false;
  fields_ = 0;
  tables_.clear();
}

void FrameTap::begin_list(std::span<const ot::FoundTable> tables, std::vector<inspect::LintItem> lint) {
  list_tables_ = tables_.size();
  tables_.insert(tables_.end(), tables.begin(), tables.end());
  place_ = {.is_list = true};
  for (auto& item : lint) {
    if (frame_.lint.size() < most_lint) frame_.lint.push_back(std::move(item));
  }
}

void FrameTap::set_tag(std::uint32_t tag) {
  place_.tag = tag;
  for (std::size_t n = list_tables_; n < tables_.size(); ++n) {
    const auto bucket = ot::bucket_of(std::span(tables_).subspan(n, 1), tag);
    if (!bucket) continue;
    place_.table = static_cast<std::uint32_t>(n);
    place_.bucket = *bucket;
  }
}

void FrameTap::end_list() { place_ = {}; }

/// Buckets are those of one table: the longest.
void FrameTap::end_frame() {
  if (is_collecting_) {
    const auto longest = std::ranges::max_element(tables_, {}, &ot::FoundTable::length);
    const auto table = static_cast<std::uint32_t>(longest - tables_.begin());
    frame_.buckets = longest != tables_.end() ? longest->length : 0;
    for (std::size_t n = 0; n < frame_.runs.size(); ++n) {
      if (run_tables_[n] != table || frame_.buckets == 0) frame_.runs[n].bucket = gpu::no_bucket;
    }
    frame_.number = number_;
    frame_.is_recording = is_recording_;
    frame_.doubtful = doubtful_ - std::exchange(doubtful_before_, doubtful_);
    ++handed_;
    take_(std::move(frame_));
  }
  jump();
}

}  // namespace door
