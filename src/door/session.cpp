#include "door/session.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
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
  is_limited_ = environment("OTTER_LIMIT") == "1";
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
  if (!is_limited_) return;
  const std::chrono::microseconds length(device_.gpu().display().is_pal() ? 20000 : 16667);
  const auto now = std::chrono::steady_clock::now();
  next_field_ = std::max(next_field_ + length, now - length);
  std::this_thread::sleep_until(next_field_);
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
  if (device_.is_recording()) tell(device_.end_recording());
  const DepthShares& depth = device_.depth();
  char line[256];
  std::snprintf(line, sizeof line,
                "%llu fields, %llu lists, %llu tags, the longest table %u, %llu faulty; polygons %llu, with "
                "depth %llu, "
                "partly %llu, doubtful %llu; last list at %06Xh",
                static_cast<unsigned long long>(fields_), static_cast<unsigned long long>(lists_),
                static_cast<unsigned long long>(nodes_), static_cast<unsigned>(buckets_),
                static_cast<unsigned long long>(faults_), static_cast<unsigned long long>(depth.polygons),
                static_cast<unsigned long long>(depth.with_depth),
                static_cast<unsigned long long>(depth.partly),
                static_cast<unsigned long long>(depth.doubtful), static_cast<unsigned>(last_head_));
  say(line);
}

}  // namespace door
