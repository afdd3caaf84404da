#include "door/session.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <sstream>
#include <thread>
#include <vector>

#include "base/write_file.h"
#include "display/png.h"
#include "door/knobs.h"

namespace door {

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

void say(const std::string& text) { std::fprintf(stderr, "otter: %s\n", text.c_str()); }

/// A whole number from 1; 0: the text is none.
std::uint64_t number_in(const std::string& text) {
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos) return 0;
  return std::strtoull(text.c_str(), nullptr, 10);
}

std::string numbered(const char* format, std::uint64_t n) {
  char name[64];
  std::snprintf(name, sizeof name, format, static_cast<unsigned>(n));
  return name;
}

void tell(const base::Result<void>& written) {
  if (!written) say(written.error().text);
}

}  // namespace

Session::Session() {
  if (const auto out = environment("OTTER_OUT"); !out.empty()) out_ = out;
  std::istringstream pictures(environment("OTTER_PICTURES"));
  for (std::string word; std::getline(pictures, word, ',');) {
    if (const auto n = number_in(word); n != 0)
      pictures_.insert(n);
    else
      say("OTTER_PICTURES: \"" + word + "\": expected numbers of fields from 1, with commas between");
  }
  if (const auto frames = environment("OTTER_FRAMES"); !frames.empty()) {
    last_field_ = number_in(frames);
    if (last_field_ == 0) say("OTTER_FRAMES: \"" + frames + "\": expected a number of fields from 1");
  }
  set_knobs(environment("OTTER_KNOBS"));
  if (const auto limit = environment("OTTER_LIMIT"); !limit.empty()) limit_ = limit == "1";
  if (const auto file = environment("OTTER_RECORD"); !file.empty()) device_.begin_recording(file);
}

void Session::set_knobs(const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto equals = std::min(word.find('='), word.size());
    const std::string name = word.substr(0, equals), value = word.substr(std::min(equals + 1, word.size()));
    const Knob* knob = find_knob(name);
    scene::Knobs knobs = device_.knobs();
    if (knob == nullptr) {
      say("OTTER_KNOBS: \"" + name + "\": expected a knob that a stream of words can honour");
    } else if (!takes(*knob, value) || !knob->info->set(knobs, value)) {
      say("OTTER_KNOBS: \"" + word + "\": expected " + name + "=" + knob->values);
    } else {
      tell(device_.use(knobs));
    }
  }
}

void Session::send_list(std::span<const std::uint32_t> ram, std::uint32_t head) {
  constexpr std::uint32_t most_tags = 0x80000;  // as many as there are words
  constexpr std::uint64_t most_told = 10;
  const ListResult sent = device_.send_list(ram, head, most_tags);
  ++lists_;
  nodes_ += sent.walk.nodes;
  last_head_ = head;
  for (const auto& table : sent.tables) buckets_ = std::max(buckets_, table.length);
  if (!sent.walk && faults_++ < most_told)
    say("field " + std::to_string(fields_ + 1) + ": " + sent.walk.message());
}

void Session::field() {
  ++fields_;
  if (pictures_.contains(fields_)) write_pictures();
  device_.vblank();
  if (fields_ == last_field_) {
    finish();
    std::fflush(stderr);
    std::_Exit(0);
  }
  if (window_) serve_window();
  // One event a field: emulators look at the last one only, and a key that goes down and up between two looks
  // would not have been typed.
  if (!keys_.empty()) {
    put_key(keys_.front());
    keys_.pop_front();
  }
  pace();
}

/// No faster than is wanted. Who is late does not hurry after it.
void Session::pace() {
  if (is_fast_ || !limit_.value_or(window_ != nullptr)) return;
  const bool is_pal = device_.gpu().display().is_pal();
  const double rate = fields_per_second_ != 0 ? fields_per_second_ : is_pal ? 50 : 60;
  using Clock = std::chrono::steady_clock;
  const auto length = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate));
  const auto now = Clock::now();
  next_field_ = std::max(next_field_ + length, now - length);
  std::this_thread::sleep_until(std::min(next_field_, now + length));
}

void Session::open_window(const std::string& program) {
  program_ = program;
  const auto wanted = environment("OTTER_WINDOW");
  const bool has_display = !environment("DISPLAY").empty() || !environment("WAYLAND_DISPLAY").empty();
  if (wanted == "0" || !has_display) return;
  crashes_ = 0;
  is_closed_ = false;
  start_window();
}

void Session::start_window() {
  std::vector<std::string> words;
  for (const Knob& knob : knobs()) {
    const auto value = knob.info->get(device_.knobs());
    if (value == knob.info->get(scene::Knobs{})) continue;
    const bool is_switch = knob.values == "off|on";
    words.push_back("--" + std::string(knob.info->name));
    if (!is_switch) words.push_back(value);
  }
  if (!program_.empty()) words.insert(words.end(), {"--title", program_});
  std::istringstream more(environment("OTTER_WINDOW_ARGUMENTS"));
  for (std::string word; more >> word;) words.push_back(word);
  auto started = WindowProcess::start(find_window_program(), words);
  if (!started) return say(started.error().text);
  window_ = std::move(*started);
  is_paused_ = is_fast_ = false;
  step_until_.reset();
  fields_per_second_ = 0;
  device_.watch([this] { return window_ != nullptr && window_->is_ready(); },
                [this](const LiveFrame& frame) {
                  if (window_) window_->send(frame);
                });
}

void Session::close_window() {
  if (!window_) return;
  device_.stop_watching();
  window_.reset();
}

/// What the window asks for; while it is paused the program waits here. A window that crashes is opened
/// again: the program goes on.
void Session::serve_window() {
  constexpr int wait_ms = 20, most_crashes = 3;
  const auto waits = [this] {
    return is_paused_ && !(step_until_ && device_.watched_frames() < *step_until_);
  };
  do {
    while (const auto request = window_->poll(waits() ? wait_ms : 0)) obey(*request);
  } while (waits() && !window_->has_ended());
  if (!window_->has_ended()) return;
  close_window();
  if (is_closed_) return;
  if (++crashes_ > most_crashes) return say("the window has ended too often: the program goes on without");
  say("the window has ended by itself: another one is opened");
  start_window();
}

void Session::obey(const LiveRequest& request) {
  switch (request.what) {
    case LiveAsk::pause:
      is_paused_ = request.value != 0;
      step_until_.reset();
      break;
    case LiveAsk::step:
      step_until_ = device_.watched_frames() + 1;
      break;
    case LiveAsk::pace:
      if (request.value < std::size(live_paces)) fields_per_second_ = live_paces[request.value];
      break;
    case LiveAsk::fast:
      is_fast_ = request.value != 0;
      break;
    case LiveAsk::record:
      toggle_recording();
      break;
    case LiveAsk::key_down:
    case LiveAsk::key_up:
      keys_.push_back({request.value, request.what == LiveAsk::key_down});
      break;
    case LiveAsk::close_program:
      is_closed_ = true;
      is_paused_ = false;
      keys_.insert(keys_.end(), {{keysym_escape, true}, {keysym_escape, false}});
      break;
  }
}

void Session::write_pictures() {
  const auto pixels = device_.gpu().vram().pixels();
  std::vector<std::byte> bytes;
  bytes.reserve(pixels.size_bytes());
  for (const std::uint16_t pixel : pixels) {
    bytes.push_back(static_cast<std::byte>(pixel & 0xff));
    bytes.push_back(static_cast<std::byte>(pixel >> 8));
  }
  tell(base::write_file(path(numbered("vram-%05u.bin", fields_)), bytes));
  const auto picture = device_.picture();
  if (!picture.pixels.empty()) tell(display::write_png(path(numbered("picture-%05u.png", fields_)), picture));
}

void Session::snapshot() {
  const auto picture = device_.picture();
  if (picture.pixels.empty()) return say("the display area is empty: there is no picture");
  tell(display::write_png(path(numbered("snapshot-%u.png", static_cast<std::uint64_t>(++snapshots_))),
                          picture));
}

void Session::toggle_recording() {
  if (device_.is_recording()) {
    tell(device_.end_recording());
    say("the recording has ended");
    return;
  }
  const std::string file = path(numbered("recording-%u.psxgpu", static_cast<std::uint64_t>(++recordings_)));
  device_.begin_recording(file);
  say("recording to " + file);
}

void Session::finish() {
  if (is_finished_) return;
  is_finished_ = true;
  close_window();
  if (device_.is_recording()) tell(device_.end_recording());
  const auto number = [](std::uint64_t n) { return std::to_string(n); };
  std::string line = number(fields_) + " fields, " + number(lists_) + " lists, " + number(nodes_) +
                     " tags, the longest table " + number(buckets_) + ", " + number(faults_) + " faulty; ";
  if (device_.has_vertices()) {
    const DepthShares& depth = device_.depth();
    line += "polygons " + number(depth.polygons) + ", with depth " + number(depth.with_depth) + ", partly " +
            number(depth.partly) + ", doubtful " + number(depth.doubtful);
  } else {
    line += "no vertex was told, so no polygon has depth";
  }
  if (lists_ != 0) line += numbered("; last list at %06Xh", last_head_);
  say(line);
}

}  // namespace door
