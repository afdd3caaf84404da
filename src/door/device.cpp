#include "door/device.h"

#include <utility>

#include "door/lint.h"
#include "ot/gp1.h"

namespace door {

/// Words are looked at only when something asks for it.
void Device::choose_path() {
  is_plain_ = !has_vertices_ && !recorder_ && !tap_ && !frames_.has_canvas();
  annotator_.follow(frames_.has_canvas());
}

void Device::gp0_watched(std::span<const std::uint32_t> words) {
  annotator_.feed(words, gpu_.is_between_commands(),
                  [this](std::span<const std::uint32_t> run) { send(run); });
}

void Device::send(std::span<const std::uint32_t> words) {
  frames_.before_words(gpu_);
  // A recording that waits, or a frame that is watched, begins at the first word of a command.
  const auto all_have_begun = [this] {
    const bool records = !recorder_ || recorder_->catch_up(gpu_);
    const bool watches = !tap_ || tap_->catch_up(gpu_);
    return records && watches;
  };
  while (!words.empty() && !all_have_begun()) {
    send_run(words.first(1));
    words = words.subspan(1);
  }
  send_run(words);
}

/// Who has not begun leaves them out.
void Device::send_run(std::span<const std::uint32_t> words) {
  if (recorder_) recorder_->gp0(words);
  if (tap_) tap_->gp0(words);
  gpu_.gp0(words);
}

/// The GPU has all words before anything else happens to it; a polygon that was half sent has no depth then.
void Device::release_held() {
  if (annotator_.holds_words())
    annotator_.release([this](std::span<const std::uint32_t> words) { send(words); });
}

void Device::gp1(std::uint32_t word) {
  release_held();
  if (recorder_ && recorder_->catch_up(gpu_)) recorder_->gp1(word);
  if (tap_) tap_->gp1(word, gpu_);
  gpu_.gp1(word);
  if (ot::gp1::aborts_command(word)) annotator_.abort();
}

std::uint32_t Device::read() {
  std::uint32_t word = 0;
  read(std::span(&word, 1));
  return word;
}

void Device::read(std::span<std::uint32_t> words) {
  release_held();
  for (std::uint32_t& word : words) word = gpu_.read();
  if (recorder_) recorder_->reads(words.size());
}

std::uint32_t Device::status() {
  release_held();
  return gpu_.status();
}

void Device::vblank() {
  release_held();
  annotator_.end_list();
  if (recorder_ && recorder_->catch_up(gpu_)) recorder_->vblank();
  if (tap_) {
    tap_->set_doubtful(annotator_.shares().doubtful);
    tap_->set_recording(is_recording());
    tap_->vblank();
  }
  frames_.vblank(gpu_);
  if (trace_) trace_->clear();
}

ListResult Device::send_list(std::span<const std::uint32_t> ram, std::uint32_t head,
                             std::uint32_t max_nodes) {
  ListResult result;
  result.walk = ot::validate(ram, head, max_nodes);
  result.tables = ot::find_tables(ram, head, result.walk.nodes);
  if (tap_) {
    tap_->catch_up(gpu_);
    auto faults = tap_->is_collecting() ? lint(ram, head) : std::vector<inspect::LintItem>{};
    tap_->begin_list(result.tables, std::move(faults));
  }
  ot::send_nodes(ram, head, result.walk.nodes,
                 [&](std::uint32_t tag, std::span<const std::uint32_t> payload) {
                   if (tap_) tap_->set_tag(tag);
                   if (payload.empty()) {
                     if (trace_) trace_->bucket = bucket_of(result.tables, tag).value_or(gpu::no_bucket);
                     return;
                   }
                   gp0(payload);
                 });
  if (trace_) trace_->bucket = gpu::no_bucket;
  if (tap_) {
    release_held();
    tap_->end_list();
  }
  annotator_.end_list();
  return result;
}

void Device::vertex(std::uint32_t xy, std::uint32_t z, std::uint8_t fx, std::uint8_t fy) {
  annotator_.tell(xy, z, fx, fy);
  if (std::exchange(has_vertices_, true)) return;
  choose_path();
}

std::vector<std::byte> Device::save() {
  release_held();
  return gpu_.save();
}

std::optional<gpu::StateError> Device::load(std::span<const std::byte> state) {
  if (auto error = gpu_.load(state)) return error;
  annotator_.forget();
  frames_.jump(gpu_);
  if (recorder_) recorder_->jump();
  if (tap_) tap_->jump();
  return std::nullopt;
}

base::Result<void> Device::use(const scene::Knobs& knobs) {
  release_held();
  auto used = frames_.use(knobs, gpu_);
  choose_path();
  return used;
}

void Device::begin_recording(std::string path) {
  release_held();
  recorder_.emplace(std::move(path));
  choose_path();
}

base::Result<void> Device::end_recording() {
  release_held();
  if (!recorder_) return base::fail("nothing is being recorded", base::Exit::failed);
  auto written = recorder_->finish(gpu_);
  recorder_.reset();
  choose_path();
  return written;
}

void Device::watch(std::function<bool()> wants, std::function<void(LiveFrame)> take) {
  release_held();
  tap_.emplace(std::move(wants), std::move(take));
  choose_path();
}

void Device::stop_watching() {
  release_held();
  tap_.reset();
  choose_path();
}

void Device::trace(TraceMode mode) {
  release_held();
  if (mode == TraceMode::off) {
    gpu_.set_trace(nullptr);
    trace_ = nullptr;
    return;
  }
  if (!trace_) trace_ = std::make_unique<gpu::Trace>();
  trace_->clear();
  trace_->keep_history = mode == TraceMode::history;
  gpu_.set_trace(nullptr);
  gpu_.set_trace(trace_.get());
}

gpu::PixelCounts Device::take_pixel_counts() {
  release_held();
  if (!counts_) {
    counts_ = std::make_unique<gpu::PixelCounts>();
    gpu_.set_pixel_counts(counts_.get());
  }
  return std::exchange(*counts_, {});
}

}  // namespace door
