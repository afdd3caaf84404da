#pragma once
// One emulator's session with the plugin: the device, and what the environment asks to be done and written.
//
//   OTTER_OUT=DIR           where files go; default: the working directory
//   OTTER_PICTURES=60,200   fields, from 1, whose picture (picture-00060.png) and VRAM (vram-00060.bin) are
//   written OTTER_FRAMES=N          after N fields the recording is written and the process ends with status
//   0 OTTER_RECORD=FILE       records from the beginning; F8 ends it, and begins another recording-N.psxgpu
//   OTTER_KNOBS="visibility=zbuffer resolution=2"
//   OTTER_LIMIT=1           no faster than the console: 60 fields a second, 50 in PAL; 0: as fast as it can.
//                           Default: 1 with a window, else 0
//   OTTER_WINDOW=0          no window; default: one where there is a display
//   OTTER_WINDOW_ARGUMENTS="--panel table --frames 300"   more for the window's command line
//   OTTER_PROGRAM=PATH      the window's program

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "door/device.h"
#include "door/window_process.h"
#include "door/x11_keys.h"

namespace door {

class Session {
 public:
  /// Reads the environment. What is wrong there is told on standard error, and left out.
  Session();

  [[nodiscard]] Device& device() { return device_; }
  /// A field has ended.
  void field();
  void send_list(std::span<const std::uint32_t> ram, std::uint32_t head);
  /// Where there is a display and nothing forbids it. `program`: what the emulator runs, for the title.
  void open_window(const std::string& program);
  void close_window();
  [[nodiscard]] bool has_window() const { return window_ != nullptr; }
  /// Begins or ends a recording (F8).
  void toggle_recording();
  void snapshot();
  /// Ends the recording and says what was seen.
  void finish();

 private:
  void set_knobs(const std::string& text);
  void write_pictures();
  void start_window();
  void serve_window();
  void obey(const LiveRequest& request);
  void pace();
  [[nodiscard]] std::string path(const std::string& name) const { return out_ + "/" + name; }

  Device device_;
  std::string out_ = ".";
  std::set<std::uint64_t> pictures_;
  std::uint64_t fields_ = 0, last_field_ = 0, lists_ = 0, nodes_ = 0, faults_ = 0;
  std::uint32_t buckets_ = 0, last_head_ = 0;
  int recordings_ = 0, snapshots_ = 0;
  std::unique_ptr<WindowProcess> window_;
  std::string program_;
  std::deque<Key> keys_;  // the emulator is to see them
  int crashes_ = 0;
  bool is_paused_ = false, is_fast_ = false, is_closed_ = false;
  std::optional<std::uint64_t> step_until_;  // so many frames handed over
  double fields_per_second_ = 0;             // 0: the console's
  std::optional<bool> limit_;                // what the environment says
  bool is_finished_ = false;
  std::chrono::steady_clock::time_point next_field_{};
};

}  // namespace door
