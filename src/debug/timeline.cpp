#include "debug/timeline.h"

#include <algorithm>
#include <cassert>

#include "base/clock.h"
#include "ot/describe.h"

namespace debug {
namespace {

constexpr double first_spacing_ms = 4;
constexpr std::size_t read_bytes = std::size_t{1} << 14;  // packed they may hold thousands of times as many
constexpr std::uint64_t least_for_states = std::uint64_t{64} << 20;

}  // namespace

Timeline::Timeline(Recording recording, const DrawOptions& options, std::uint64_t limit_bytes)
    : recording_(std::move(recording)), options_(options), limit_bytes_(limit_bytes) {
  find_frames();
  set_options(options);
}

Timeline::~Timeline() = default;

void Timeline::end_frames_by(dump::FrameBy by) {
  if (by == frames_.by()) return;
  frames_ = dump::Frames(by);
  number_anew();
  find_frames();
}

void Timeline::set_options(const DrawOptions& options) {
  options_ = options;
  keyframes_.clear();
  spacing_ms_ = first_spacing_ms;
  since_state_ms_ = 0;
  indexer_ = std::make_unique<Player>(recording_, frames_, options_);
  player_ = std::make_unique<Player>(recording_, frames_, options_);
  player_can_go_on_ = true;
  keep_state();
}

void Timeline::find_frames() {
  using Rest = dump::Frames::Rest;
  const Rest rest = !recording_.is_read()        ? Rest::to_come
                    : recording_.fault().empty() ? Rest::nothing
                                                 : Rest::lost;
  if (!frames_.extend(recording_.dump(), rest)) number_anew();
  index_.extend(recording_.dump(), frames_, rest);
}

/// Frames end elsewhere: states along the way do not fit.
void Timeline::number_anew() {
  index_ = {};
  commands_of_ = 0;
  set_options(options_);
}

bool Timeline::index_some(double milliseconds) {
  const double deadline = base::now_ms() + milliseconds;
  // Reading goes first: what there is to see matters more than how soon it is reached.
  while (!recording_.is_read() && base::now_ms() < deadline) {
    recording_.read_some(read_bytes);
    find_frames();
  }
  if (base::now_ms() < deadline) keep_states(end_of_frames(), deadline);
  return !is_indexed();
}

base::Result<void> Timeline::read_first_frame() {
  while (frames() == 0 && !recording_.is_read()) {
    recording_.read_some(read_bytes);
    find_frames();
  }
  if (frames() == 0) return base::fail(fault());
  return {};
}

base::Result<void> Timeline::read_all(const std::function<bool(double)>& keep_going) {
  while (!recording_.is_read()) {
    recording_.read_some(64 * read_bytes);
    find_frames();
    if (keep_going && !keep_going(recording_.read_progress())) break;
  }
  return read_first_frame();
}

bool Timeline::is_indexed() const { return recording_.is_read() && indexer_->place() >= end_of_frames(); }

double Timeline::progress() const {
  const Place end = end_of_frames();
  const double kept =
      end.packet == 0 ? 1 : static_cast<double>(indexer_->place().packet) / static_cast<double>(end.packet);
  return std::min(1.0, (recording_.read_progress() + recording_.read_progress() * kept) / 2);
}

Place Timeline::end_of_frames() const {
  return {index_.frames().empty() ? 0 : index_.frames().back().end_packet, 0};
}

std::uint64_t Timeline::allowance() const {
  const auto held = static_cast<std::uint64_t>(dump().held_bytes());
  const auto least = std::min(least_for_states, limit_bytes_);
  return held + least > limit_bytes_ ? least : limit_bytes_ - held;
}

/// Draws on with the indexer, up to a place or a moment, and keeps states as often as is due.
void Timeline::keep_states(Place until, double deadline_ms) {
  double last = base::now_ms();
  while (indexer_->place() < until && last < deadline_ms) {
    // Where keeping a state takes long, most time still goes into drawing.
    const double spacing_ms = std::max(spacing_ms_, 2 * keeping_ms_);
    indexer_->run(until, [&, words = 0]() mutable {
      if (++words % 8 != 0) return true;
      return base::now_ms() - last + since_state_ms_ < spacing_ms && base::now_ms() < deadline_ms;
    });
    const double now = base::now_ms();
    since_state_ms_ += now - last;
    last = now;
    if (since_state_ms_ >= spacing_ms) keep_state();
  }
}

void Timeline::keep_state() {
  const double begun = base::cpu_ms();
  keyframes_.add(indexer_->place(), indexer_->is_in_frame(), indexer_->gpu().save());
  since_state_ms_ = 0;
  while (keyframes_.bytes() > allowance() && keyframes_.size() >= 4) {
    keyframes_.thin();
    spacing_ms_ *= 2;
  }
  keeping_ms_ = base::cpu_ms() - begun;
}

const std::vector<Command>& Timeline::commands(std::uint64_t frame) {
  assert(frame >= 1 && frame <= frames());
  if (commands_of_ != frame) commands_ = index_.commands(dump(), frame - 1);
  commands_of_ = frame;
  return commands_;
}

std::optional<Number> Timeline::find_drawing(std::uint64_t drawing) {
  const auto& all = index_.frames();
  const auto after = std::ranges::lower_bound(all, drawing, {}, &Frame::drawing_before);
  for (auto at = after == all.begin() ? after : std::prev(after); at != all.end(); ++at) {
    const auto frame = static_cast<std::uint64_t>(at - all.begin()) + 1;
    for (const Command& command : commands(frame))
      if (command.drawing == drawing) return number_of(frame, command);
    if (at->drawing_before >= drawing) break;
  }
  return std::nullopt;
}

Number Timeline::at_vsync(std::uint64_t vsync) {
  const auto& packets = dump().packets;
  std::size_t end = 0;
  while (vsync > 0)
    if (packets[end++].type == dump::PacketType::vsync) --vsync;
  const auto frame = frame_at({end - 1, 0});
  if (this->frame(frame).end_packet == end) return {frame, whole_frame};
  const auto& all = commands(frame);
  const auto after = std::ranges::upper_bound(all, Place{end, 0}, {}, &Command::end);
  return {frame, static_cast<std::uint64_t>(after - all.begin())};
}

std::uint64_t Timeline::frame_at(Place place) const {
  const auto next = std::ranges::upper_bound(index_.frames(), place.packet, {}, &Frame::first_packet);
  return static_cast<std::uint64_t>(std::max<std::ptrdiff_t>(next - index_.frames().begin(), 1));
}

Number Timeline::number_of(std::uint64_t frame, const Command& command) const {
  const Node* const node = command.is_control ? nullptr : recording_.node_at(command.first);
  return {frame, command.number, node == nullptr ? gpu::no_bucket : node->bucket};
}

std::string Timeline::origin_of(const Command& command) const {
  const Node* const node = command.is_control ? nullptr : recording_.node_at(command.first);
  return node == nullptr || node->address == 0 ? std::string() : ot::address_text(node->address);
}

Place Timeline::place_of(const Number& number) {
  assert(number.frame >= 1 && number.frame <= frames());
  const Frame& frame = index_.frames()[number.frame - 1];
  if (number.command == 0) return {frame.first_packet, 0};
  if (number.command == whole_frame || number.command > frame.commands) return {frame.end_packet, 0};
  return commands(number.frame)[number.command - 1].end;
}

void Timeline::go_to(Place place) {
  keep_states(place, 1e300);
  const auto& key = keyframes_.before(place);
  if (!player_can_go_on_ || player_->place() > place || key.place > player_->place())
    player_->restore(keyframes_.state_of(key), key.place, key.is_in_frame);
  player_can_go_on_ = true;
  player_->run(place);
}

const gpu::Gpu& Timeline::seek(const Number& number) {
  go_to(place_of(number));
  const bool is_end = place_of({number.frame, whole_frame}) == player_->place();
  if (player_->is_in_frame() && (is_end || options_.depth)) {
    player_can_go_on_ = false;  // a z-buffered frame is not over: its second pass was drawn to be seen
    player_->end_frame();
  }
  return player_->gpu();
}

Watched Timeline::watch(std::uint64_t frame, gpu::Trace& trace, std::uint64_t until) {
  go_to(place_of({frame, 0}));
  trace.clear();
  player_->gpu().set_trace(&trace);
  const Place end = place_of({frame, until});
  // What goes on from the frame before has a number of that one.
  const auto& commands = this->commands(frame);
  player_->run(commands.empty() ? end : std::min(end, commands.front().begin));
  for (gpu::Primitive& draw : trace.draws) draw.command_number = going_on;
  if (player_->place() < end) player_->run(end);
  if (player_->is_in_frame()) {
    player_can_go_on_ = false;
    player_->end_frame();
  }
  player_->gpu().set_trace(nullptr);
  return {player_->frame_end(), commands_in(frame)};
}

std::uint64_t Timeline::bytes() const {
  return keyframes_.bytes() + index_.frames().size() * sizeof(Frame) +
         commands_.capacity() * sizeof(Command) + 2 * (gpu::Vram::size * 2 + player_->gpu().depth_bytes());
}

}  // namespace debug
