#include "app/live.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "base/socket.h"
#include "debug/item_cutter.h"
#include "ot/describe.h"

namespace app {

debug::Clip clip_of(const door::LiveFrame& frame) {
  debug::Clip clip;
  clip.state = frame.state;
  clip.buckets = frame.buckets;
  clip.lint = frame.lint;
  clip.is_list_in_ram =
      std::any_of(frame.runs.begin(), frame.runs.end(), [](const auto& run) { return run.is_list; });
  debug::ItemCutter cutter(clip.items);
  std::span<const std::uint32_t> words = frame.words;
  for (const auto& run : frame.runs) {
    const auto these = words.first(run.words);
    words = words.subspan(run.words);
    if (run.is_control) {
      cutter.gp1(these[0]);
      continue;
    }
    cutter.set_node(run.address, run.bucket, run.is_list ? ot::address_text(run.address) : std::string());
    cutter.gp0(these);
  }
  cutter.finish();
  return clip;
}

LiveLink::LiveLink(int socket, std::function<void()> wake)
    : socket_(socket), wake_(std::move(wake)), reader_([this] { read_frames(); }) {}

LiveLink::~LiveLink() {
  shutdown(socket_, SHUT_RDWR);
  reader_.join();
  close(socket_);
}

void LiveLink::read_frames() {
  constexpr std::size_t most_waiting = 4;
  std::vector<std::byte> bytes;
  std::string error;
  for (;;) {
    std::uint64_t length = 0;
    if (!base::receive_all(socket_, std::as_writable_bytes(std::span(&length, 1)))) break;
    if (length > door::most_frame_bytes) {
      error = "what comes is no frame of a program: " + std::to_string(length) + " bytes are announced";
      break;
    }
    bytes.resize(static_cast<std::size_t>(length));
    if (!base::receive_all(socket_, bytes)) break;
    auto frame = door::live_frame_of(bytes);
    gpu::Gpu trial;
    if (frame && trial.load(frame->state)) frame = base::fail("a frame's state is not one of this program's");
    if (!frame) {
      error = frame.error().text;
      break;
    }
    {
      const std::lock_guard lock(mutex_);
      inbox_.push_back(std::move(*frame));
      if (inbox_.size() > most_waiting) inbox_.pop_front();
    }
    if (wake_) wake_();
  }
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
    error_ = std::move(error);
  }
  if (wake_) wake_();
}

std::vector<door::LiveFrame> LiveLink::take() {
  const std::lock_guard lock(mutex_);
  std::vector<door::LiveFrame> frames(std::make_move_iterator(inbox_.begin()),
                                      std::make_move_iterator(inbox_.end()));
  inbox_.clear();
  return frames;
}

// Requests are small and rare: what the socket has no room for is not answered anyway.
void LiveLink::ask(door::LiveAsk what, std::uint32_t value) {
  const door::LiveRequest request{what, value};
  (void)send(socket_, &request, sizeof request, MSG_NOSIGNAL);
}

bool LiveLink::has_ended() {
  const std::lock_guard lock(mutex_);
  return has_ended_ && inbox_.empty();
}

std::string LiveLink::error() {
  const std::lock_guard lock(mutex_);
  return error_;
}

void LiveReel::add(const door::LiveFrame& frame) {
  kept_.push_back(
      {static_cast<std::int64_t>(frame.number), clip_of(frame), frame.doubtful, frame.is_recording});
  if (kept_.size() > kept_frames) kept_.pop_front();
}

const LiveReel::Kept& LiveReel::at(std::int64_t frame) const {
  const auto after =
      std::find_if(kept_.begin(), kept_.end(), [&](const auto& k) { return k.number > frame; });
  return after == kept_.begin() ? *after : *std::prev(after);
}

std::int64_t LiveReel::after(std::int64_t frame) const {
  const auto at = std::find_if(kept_.begin(), kept_.end(), [&](const auto& k) { return k.number > frame; });
  return at == kept_.end() ? last() : at->number;
}

std::int64_t LiveReel::before(std::int64_t frame) const {
  const auto at = std::find_if(kept_.rbegin(), kept_.rend(), [&](const auto& k) { return k.number < frame; });
  return at == kept_.rend() ? first() : at->number;
}

bool Live::take_frames() {
  if (!link_) return false;
  const auto frames = link_->take();
  for (const auto& frame : frames) reel_->add(frame);
  return !frames.empty();
}

base::Result<scene::FrameStats> Live::draw(std::int64_t frame, const scene::Knobs& knobs,
                                           const CameraOffset& /*camera*/) {
  if (reel_->is_empty()) return scene::FrameStats{};
  return show(reel_->at(frame).clip, knobs);
}

base::Result<debug::Clip> Live::clip(std::int64_t frame, const scene::Knobs& knobs,
                                     const CameraOffset& /*camera*/) {
  if (auto checked = check_visibility(knobs); !checked) return tl::make_unexpected(checked.error());
  return reel_->is_empty() ? debug::Clip{} : reel_->at(frame).clip;
}

std::unique_ptr<Subject> Live::another(const scene::Knobs& /*knobs*/) const {
  return std::make_unique<Live>(nullptr, reel_);
}

std::unique_ptr<Subject> Live::apart(std::int64_t frame, const scene::Knobs& /*knobs*/) {
  return std::make_unique<ClipSubject>(reel_->is_empty() ? debug::Clip{} : reel_->at(frame).clip);
}

}  // namespace app
