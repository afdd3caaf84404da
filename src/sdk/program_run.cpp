#include "sdk/program_run.h"

#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>

#include "base/message.h"
#include "dump/bucket_note.h"
#include "dump/dump_file.h"
#include "sdk/call_site.h"

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace sdk {
namespace {

/// Frames behind the one at hand that can be gone back to at once: with 1 MiB each of the GPU's state.
constexpr std::uint32_t most_held = 90;
/// What a recording may take in memory.
constexpr std::int64_t most_recorded_bytes = std::int64_t{512} << 20;

/// The table on which most packets hang: buckets of others would count in another table.
std::pair<std::uint32_t, std::uint32_t> main_table(const std::vector<SentWords>& sent) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> packets;
  for (const auto& one : sent) {
    if (one.table_length != 0) ++packets[{one.table, one.table_length}];
  }
  const auto most = std::max_element(packets.begin(), packets.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == packets.end() ? std::pair<std::uint32_t, std::uint32_t>{} : most->first;
}

}  // namespace

ProgramRun::ProgramRun(Settings settings, std::string name)
    : settings_(std::move(settings)), name_(std::move(name)) {}

ProgramRun::~ProgramRun() {
  stop();
  if (!recording_) return;
  const auto written = write_recording();
  base::warn(name_, written ? *written : written.error().text);
}

base::Result<void> ProgramRun::start() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return base::fail(std::string("no socket for the program's process: ") + std::strerror(errno),
                      base::Exit::failed);
  // The other end under a number of its own, which is not closed by exec.
  const int theirs = dup(ends[1]);
  close(ends[1]);
  std::vector<std::string> words{name_, "--serve", std::to_string(theirs)};
  if (!settings_.pads[1].empty()) words.insert(words.end(), {"--pad2", to_text(settings_.pads[1])});
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int failed = posix_spawn(&process_, "/proc/self/exe", nullptr, nullptr, arguments.data(), environ);
  close(theirs);
  line_ = std::make_unique<Line>(ends[0]);
  if (failed != 0) {
    line_.reset();
    process_ = 0;
    return base::fail(std::string("the program's process cannot be made: ") + std::strerror(failed),
                      base::Exit::failed);
  }
  reached_ = ordered_ = began_ = 0;
  return {};
}

void ProgramRun::stop() {
  line_.reset();
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

std::array<PadState, 2> ProgramRun::pads_at(std::uint32_t number) {
  while (log_.size() < number) {
    const auto at = static_cast<std::uint32_t>(log_.size() + 1);
    const auto& script = settings_.pads[0];
    log_.push_back({script.empty() ? held_ : at_frame(script, at), at_frame(settings_.pads[1], at)});
  }
  return log_[number - 1];
}

// A button that is pressed where something is replayed counts from this frame on.
void ProgramRun::take_over(std::uint32_t number) {
  const bool is_replayed = number == shown_ + 1 && number <= log_.size() && settings_.pads[0].empty();
  if (!is_replayed || held_.buttons == 0 || log_[number - 1][0] == held_) return;
  log_.resize(number - 1);
  last_ = number - 1;
  ending_.reset();
  while (!held_frames_.empty() && held_frames_.back().number >= number) held_frames_.pop_back();
  if (reached_ >= number) stop();
}

void ProgramRun::order(std::uint32_t until) {
  Orders orders;
  orders.frames = until - reached_;
  orders.kept = std::min(until - reached_, most_held);
  orders.is_silent = until <= last_;
  for (auto number = reached_ + 1; number <= until; ++number) orders.pads.push_back(pads_at(number));
  began_ = reached_;
  ordered_ = until;
  line_->send(std::move(orders));
}

double ProgramRun::progress() const {
  if (ordered_ == reached_ || ordered_ == began_) return 1;
  return static_cast<double>(reached_ - began_) / static_cast<double>(ordered_ - began_);
}

void ProgramRun::read_on(int milliseconds) {
  TakenFrame taken;
  switch (line_->receive(taken, milliseconds)) {
    case Line::Came::nothing:
      break;
    case Line::Came::progress:
      reached_ = taken.number;
      break;
    case Line::Came::frame:
      take(taken);
      break;
    case Line::Came::end: {
      int status = 0;
      waitpid(process_, &status, 0);
      process_ = 0;
      line_.reset();
      Ending how;
      how.kind = Ending::Kind::crashed;
      how.place = "the program's process ended";
      how.signal = WIFSIGNALED(status) ? std::string(strsignal(WTERMSIG(status)))
                                       : "exit status " + std::to_string(WEXITSTATUS(status));
      ending_ = End{reached_ + 1, how};
      ordered_ = reached_;
      break;
    }
  }
}

base::Result<bool> ProgramRun::go_to(std::uint32_t number, int milliseconds) {
  take_over(number);
  if (ending_) number = std::min(number, std::max(last_, 1U));
  if (frame(number) != nullptr) {
    shown_ = number;
    return true;
  }
  const bool is_on_its_way = line_ && ordered_ > reached_;
  if (is_on_its_way && number != ordered_ && (number < ordered_ || ordered_ - began_ > most_held)) stop();
  if (line_ && number <= reached_) stop();
  if (!line_) {
    if (ending_ && last_ == 0) return true;
    if (auto started = start(); !started) return tl::make_unexpected(started.error());
  }
  if (ordered_ == reached_) order(number);
  const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(milliseconds);
  while (line_ && ordered_ > reached_) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    read_on(static_cast<int>(left.count()));
  }
  shown_ = number;
  return frame(number) != nullptr || has_ended();
}

const RunFrame* ProgramRun::frame(std::uint32_t number) const {
  const auto found =
      std::ranges::find_if(held_frames_, [number](const RunFrame& f) { return f.number == number; });
  return found == held_frames_.end() ? nullptr : &*found;
}

const RunFrame* ProgramRun::frame_drawn(std::uint32_t number) const {
  const RunFrame* best = frame(number);
  if (best != nullptr && best->drawing != 0) return best;
  for (const auto& one : held_frames_) {
    if (one.number <= number && one.drawing != 0) best = &one;
  }
  return best;
}

std::string ProgramRun::place_of(CallSite site) {
  const auto known = std::ranges::find_if(places_, [site](const auto& one) { return one.first == site; });
  if (known != places_.end()) return known->second;
  const std::array sites{site};
  return places_.emplace_back(site, describe(sites)[0]).second;
}

// "corridor.c:88/3": the third packet in memory of those that this line linked in the frame, for a program
// makes them one behind the other.
void ProgramRun::name_origins(debug::Clip& clip, const std::vector<SentWords>& sent) {
  std::map<std::uint32_t, CallSite> sites;
  for (const auto& one : sent) {
    if (one.site != nullptr) sites[one.address] = one.site;
  }
  std::map<CallSite, int> counts;
  std::map<std::uint32_t, std::string> names;
  for (const auto& [address, site] : sites)
    names[address] = place_of(site) + "/" + std::to_string(++counts[site]);
  for (auto& item : clip.items) {
    const auto name = names.find(item.address);
    if (name != names.end()) item.origin = name->second;
  }
}

std::vector<std::string> ProgramRun::notes_of(const TakenFrame& taken) const {
  std::vector<std::string> notes;
  if (taken.shares.polygons() != 0) notes.push_back(to_text(taken.shares));
  if (taken.ending.never_waited) notes.push_back("no VSync so far: the blanks come from the clock");
  return notes;
}

void ProgramRun::take(TakenFrame& taken) {
  reached_ = taken.number;
  last_ = std::max(last_, reached_);
  if (taken.is_last) {
    ending_ = End{taken.number, taken.ending};
    ordered_ = reached_;
  }
  std::vector<debug::Sent> sent;
  const auto [table, length] = main_table(taken.sent);
  for (auto& one : taken.sent) {
    const bool is_of_table = one.table_length != 0 && one.table == table && one.table_length == length;
    sent.push_back(
        {one.is_control, is_of_table ? one.bucket : gpu::no_bucket, one.address, {}, std::move(one.words)});
  }
  RunFrame frame{taken.number, {}, 0};
  frame.clip.state = std::move(taken.state);
  frame.clip.items = debug::items_of(sent);
  frame.clip.buckets = length;
  frame.clip.is_list_in_ram = true;
  frame.clip.notes = notes_of(taken);
  name_origins(frame.clip, taken.sent);
  for (const auto& finding : taken.findings) {
    frame.clip.lint.push_back({finding.kind, place_of(finding.site), to_text(finding)});
  }
  frame.drawing = static_cast<std::uint64_t>(
      std::ranges::count_if(frame.clip.items, [](const debug::Item& item) { return item.is_drawing(); }));
  add_to_recording(frame);
  if (!held_frames_.empty() && held_frames_.back().number + 1 != frame.number) held_frames_.clear();
  held_frames_.push_back(std::move(frame));
  if (held_frames_.size() > most_held) held_frames_.pop_front();
}

std::string ProgramRun::ending() const {
  if (!ending_) return {};
  const auto frame = " in frame " + std::to_string(ending_->frame);
  if (ending_->how.kind == Ending::Kind::ended) return name_ + " ended" + frame;
  return ending_->how.place + ": " + ending_->how.signal + frame;
}

std::string ProgramRun::pad_log() const {
  PadScript script;
  for (std::size_t i = 0; i < log_.size(); ++i) {
    if (script.empty() || std::prev(script.end())->second != log_[i][0])
      script[static_cast<std::uint32_t>(i + 1)] = log_[i][0];
  }
  return to_text(script);
}

void ProgramRun::add_to_recording(const RunFrame& frame) {
  if (!recording_ || (recording_->next != 0 && frame.number != recording_->next)) return;
  auto& dump = recording_->dump;
  if (recording_->next == 0) {
    recording_->first = frame.number;
    debug::add_state(frame.clip.state, dump);
  }
  if (dump.held_bytes() > most_recorded_bytes) return;
  dump::BucketNote noted;
  for (const auto& item : frame.clip.items) {
    const bool hangs = item.bucket < frame.clip.buckets;
    const dump::BucketNote note{hangs ? item.bucket : 0, hangs ? frame.clip.buckets : 0};
    if (note != noted) dump.add_text(dump::PacketType::comment, dump::to_text(note));
    noted = note;
    dump.add(item.is_control ? dump::PacketType::port1 : dump::PacketType::port0, item.words);
  }
  if (noted != dump::BucketNote{})
    dump.add_text(dump::PacketType::comment, dump::to_text(dump::BucketNote{}));
  dump.add(dump::PacketType::vsync);
  recording_->next = frame.number + 1;
}

base::Result<std::string> ProgramRun::record(const std::string& path) {
  if (recording_) return write_recording();
  recording_ = Recording{path, {}, 0, 0};
  return "recording from the next frame on; F8 ends it";
}

base::Result<std::string> ProgramRun::write_recording() {
  const auto recording = std::move(*recording_);
  recording_.reset();
  if (recording.next == 0) return std::string("nothing was recorded: no frame was drawn meanwhile");
  if (auto done = dump::write_dump(recording.path, dump::DumpFormat::standard, recording.dump); !done)
    return tl::make_unexpected(done.error());
  return "recorded frames " + std::to_string(recording.first) + " to " + std::to_string(recording.next - 1) +
         ": " + recording.path;
}

}  // namespace sdk
