#include "sdk/host.h"

#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <thread>
#include <utility>

#include "app/commands/progress.h"
#include "base/write_file.h"
#include "display/png.h"
#include "display/scanout.h"
#include "display/vram_file.h"
#include "dump/dump_file.h"
#include "machine/present.h"
#include "scene/plan.h"
#include "scene/world.h"
#include "sdk/console.h"
#include "sdk/crash.h"
#include "sdk/memory.h"
#include "sdk/report.h"
#include "sdk/window.h"

namespace sdk {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// So long a program may go without waiting for a blank before the clock makes them.
constexpr milliseconds patience{400}, blank_time{16};

struct Start {
  int (*main)(int, char**);
  const char* name;
};

void* run_program(void* given) {
  const auto start = *static_cast<Start*>(given);
  catch_crashes();
  std::string name = start.name;
  char* arguments[] = {name.data(), nullptr};
  start.main(1, arguments);
  the_console().handover.stop(ProgramState::ended);
}

[[noreturn]] void park() {
  for (;;) pause();
}

/// The pictures of a run, as `settings` want them shown.
class Screen {
 public:
  explicit Screen(const Settings& settings) : settings_(settings) {}

  /// Sets depth stage and canvas from the settings' knobs.
  void choose_targets(const scene::Knobs& knobs) {
    auto& console = the_console();
    knobs_ = knobs;
    Feed::Targets targets;
    targets.canvas = scene::canvas_options(knobs, scene::World{}, 1);
    Settings wanted = settings_;
    wanted.knobs = knobs;
    if (wanted.needs_depth()) console.depth.start();
    targets.annotate = targets.canvas || wanted.annotate || knobs.visibility == scene::Visibility::zbuffer;
    console.gpu.set_depth(targets.canvas ? std::nullopt : scene::depth_options(knobs));
    if (!targets.canvas) console.gpu.set_canvas(std::nullopt);
    console.gpu.begin_frame();
    console.feed.set_targets(targets);
    drawn_.clear();
  }

  /// A frame has ended: its canvas, if there is one, becomes a picture.
  void end_frame() {
    auto& console = the_console();
    const auto corner = console.feed.canvas_corner();
    if (console.gpu.canvas() == nullptr || !corner) return;
    drawn_[{corner->x, corner->y}] = presenter_.show(console.gpu, knobs_);
    last_ = {corner->x, corner->y};
    constexpr std::size_t most = 4;
    if (drawn_.size() > most)
      drawn_.erase(drawn_.begin()->first == last_ ? std::prev(drawn_.end()) : drawn_.begin());
  }

  [[nodiscard]] base::Picture picture() {
    auto& console = the_console();
    auto area = display::area_of(console.gpu.display());
    if (settings_.shown == Shown::drawn) {
      area.x = console.gpu.state().left();
      area.y = console.gpu.state().top();
    }
    const auto canvas = drawn_.find(settings_.shown == Shown::drawn ? last_ : std::pair{area.x, area.y});
    if (canvas != drawn_.end() && !area.is_off) return canvas->second;
    if (console.gpu.canvas() == nullptr && settings_.shown == Shown::display)
      return presenter_.show(console.gpu, knobs_);
    return display::scan_out(console.gpu.vram().pixels(), area);
  }

 private:
  const Settings& settings_;
  scene::Knobs knobs_;
  machine::Presenter presenter_;
  std::map<std::pair<int, int>, base::Picture> drawn_;  // by the corner of the buffer in VRAM
  std::pair<int, int> last_{};
};

class Host {
 public:
  Host(const Settings& settings, std::string name)
      : settings_(settings), name_(std::move(name)), screen_(settings) {}

  int run(int (*program_main)(int, char**)) {
    if (auto laid_out = check_layout(); !laid_out) return complain(laid_out.error());
    if (!settings_.is_headless()) {
      auto window = Window::open(name_);
      if (!window) return complain(window.error());
      window_ = std::move(*window);
    }
    auto& console = the_console();
    console.reversed = settings_.reversed;
    console.has_second_pad = !settings_.pads[1].empty();
    if (!settings_.record.empty()) console.feed.record(settings_.annotate);
    screen_.choose_targets(settings_.knobs);
    start({program_main, name_.c_str()});
    loop();
    return finish();
  }

 private:
  int complain(const base::Error& error) {
    std::fprintf(stderr, "%s: %s\n", name_.c_str(), error.text.c_str());
    return static_cast<int>(error.exit);
  }

  void start(Start how) {
    start_ = how;
    std::signal(SIGUSR1, [](int) { interrupt(after_blank); });
    std::signal(SIGUSR2, [](int) { interrupt(park); });
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, program_stack().data(), program_stack().size());
    pthread_create(&program_, &attributes, run_program, &start_);
    pthread_attr_destroy(&attributes);
  }

  void loop() {
    auto& console = the_console();
    app::Progress progress(name_, settings_.frames.value_or(0));
    auto waited = Clock::now();
    for (;;) {
      const auto state = console.handover.wait_for_program(blank_time);
      if (state == ProgramState::ended || state == ProgramState::crashed) {
        ending_.kind = state == ProgramState::ended ? Ending::Kind::ended : Ending::Kind::crashed;
        stay_open();
        return;
      }
      if (state == ProgramState::waiting) {
        waited = Clock::now();
        ever_waited_ = true;
      } else if (Clock::now() - waited < patience) {
        continue;
      }
      {
        const std::lock_guard lock(console.handover.console);
        blank();
      }
      if (settings_.is_headless()) progress.step();
      if (is_over()) break;
      if (state == ProgramState::waiting) {
        console.handover.release();
      } else {
        pthread_kill(program_, SIGUSR1);
      }
    }
    if (console.handover.wait_for_program(milliseconds(0)) == ProgramState::running) {
      pthread_kill(program_, SIGUSR2);
      std::this_thread::sleep_for(blank_time);
    }
  }

  void blank() {
    auto& console = the_console();
    console.feed.next_field();
    screen_.end_frame();
    const auto frame = ++console.blanks;
    console.lint.frame = frame;
    for (std::size_t i = 0; i < console.pads.size(); ++i)
      console.pads[i] = at_frame(settings_.pads[i], frame);
    if (window_) serve_window();
    if (pad_log_.empty() || std::prev(pad_log_.end())->second != console.pads[0])
      pad_log_[frame] = console.pads[0];
  }

  [[nodiscard]] bool is_over() const {
    return closed_ || (settings_.frames && the_console().blanks >= *settings_.frames);
  }

  // One blank's worth of window; while paused, until it is no longer.
  void serve_window() {
    bool steps = false;
    do {
      const auto events = window_->poll();
      closed_ = closed_ || events.closed;
      if (events.pause) paused_ = !paused_;
      steps = events.step;
      if (events.zbuffer) toggle_zbuffer();
      if (settings_.pads[0].empty()) the_console().pads[0] = events.pad;
      window_->show(screen_.picture());
      keep_pace();
    } while (paused_ && !steps && !closed_);
  }

  void toggle_zbuffer() {
    using scene::Visibility;
    knobs_now_.visibility = knobs_now_.visibility == Visibility::ot ? Visibility::zbuffer : Visibility::ot;
    screen_.choose_targets(knobs_now_);
    window_->set_title(name_ + (knobs_now_.visibility == Visibility::ot ? "" : " - z-buffer"));
  }

  void keep_pace() {
    constexpr std::chrono::microseconds field{16683};  // 59.94 Hz
    next_ += field;
    const auto now = Clock::now();
    if (next_ > now) {
      std::this_thread::sleep_until(next_);
    } else {
      next_ = now;
    }
  }

  // The program is over; its window is not.
  void stay_open() {
    if (!window_) return;
    if (ending_.kind == Ending::Kind::crashed) {
      const auto crash = describe_crash();
      window_->set_title(name_ + " - " + crash.signal + " at " + crash.place);
    } else {
      window_->set_title(name_ + " - ended");
    }
    while (!window_->poll().closed) {
      window_->show(screen_.picture());
      keep_pace();
    }
  }

  int finish() {
    auto& console = the_console();
    ending_.never_waited = !ever_waited_ && ending_.kind == Ending::Kind::reached;
    if (ending_.kind == Ending::Kind::crashed) {
      const auto crash = describe_crash();
      ending_.signal = crash.signal;
      ending_.place = crash.place;
    }
    if (ending_.kind != Ending::Kind::reached) {  // what was drawn since the last blank
      console.feed.next_field();
      screen_.end_frame();
    }
    std::fflush(stdout);
    if (settings_.json != "-") std::fputs(to_text(console, ending_, name_).c_str(), stderr);
    if (auto written = write_files(); !written) return complain(written.error());
    std::fflush(nullptr);
    return ending_.kind == Ending::Kind::crashed ? static_cast<int>(base::Exit::failed) : 0;
  }

  base::Result<void> write_files() {
    auto& console = the_console();
    if (!settings_.output.empty()) {
      const auto picture = screen_.picture();
      if (picture.width <= 0 || picture.height <= 0) {
        return base::fail(settings_.output + ": the display area is empty, expected PutDispEnv with a size",
                          base::Exit::failed);
      }
      if (auto done = display::write_png(settings_.output, picture); !done) return done;
    }
    if (!settings_.vram.empty()) {
      if (auto done = display::save_vram(settings_.vram, console.gpu.vram()); !done) return done;
    }
    if (!settings_.record.empty()) {
      const auto& recording = *console.feed.recording();
      const auto add_all = [&recording](dump::DumpWriter& writer) -> base::Result<void> {
        for (const auto& packet : recording.packets) writer.add(packet.type, recording.payload(packet));
        return {};
      };
      if (auto done = dump::write_dump(settings_.record, dump::DumpFormat::standard, add_all); !done)
        return done;
    }
    if (!settings_.ram.empty()) {
      const auto words = console.ram.words();
      if (auto done = base::write_file(settings_.ram, std::as_bytes(words)); !done) return done;
      std::fprintf(stderr, "%s: the last list begins at %s: otter walk %s --head %X\n", name_.c_str(),
                   hex(console.last_list).c_str(), settings_.ram.c_str(), console.last_list);
    }
    if (!settings_.pad_log.empty()) {
      if (auto done = base::write_file(settings_.pad_log, to_text(pad_log_) + "\n"); !done) return done;
    }
    if (settings_.json.empty()) return {};
    const auto json = to_json(console, ending_, name_);
    if (settings_.json == "-") {
      std::fputs(json.c_str(), stdout);
      return {};
    }
    return base::write_file(settings_.json, json);
  }

  const Settings& settings_;
  std::string name_;
  Screen screen_;
  std::unique_ptr<Window> window_;
  scene::Knobs knobs_now_ = settings_.knobs;
  Start start_{};
  pthread_t program_{};
  PadScript pad_log_;
  Ending ending_;
  Clock::time_point next_ = Clock::now();
  bool ever_waited_ = false, paused_ = false, closed_ = false;
};

}  // namespace

int run(const Settings& settings, int (*program_main)(int, char**), const char* name) {
  return Host(settings, name).run(program_main);
}

}  // namespace sdk
