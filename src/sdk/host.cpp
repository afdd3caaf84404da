#include "sdk/host.h"

#include <fcntl.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <thread>
#include <utility>

#include "app/commands/progress.h"
#include "base/message.h"
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
#include "sdk/program_window.h"
#include "sdk/remote.h"
#include "sdk/report.h"

namespace sdk {
namespace {

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
    targets.depth_of_bucket = knobs.without_depth == scene::WithoutDepth::bucket;
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
    if (settings_.shown == app::Shown::drawn) {
      area.x = console.gpu.state().left();
      area.y = console.gpu.state().top();
    }
    const auto canvas = drawn_.find(settings_.shown == app::Shown::drawn ? last_ : std::pair{area.x, area.y});
    if (canvas != drawn_.end() && !area.is_off) return canvas->second;
    if (console.gpu.canvas() == nullptr && settings_.shown != app::Shown::drawn)
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
    if (auto laid_out = check_layout(the_console().memory); !laid_out) return complain(laid_out.error());
    if (!settings_.is_headless()) {
      const auto shown = show_in_window(settings_, name_);
      return shown ? *shown : complain(shown.error());
    }
    auto& console = the_console();
    console.reversed = settings_.reversed;
    console.has_second_pad = !settings_.pads[1].empty();
    if (!settings_.record.empty()) console.feed.record(settings_.annotate);
    screen_.choose_targets(settings_.knobs);
    if (settings_.served) {
      line_ = std::make_unique<Line>(*settings_.served);
      console.feed.keep();
      wait_for_orders();
      if (closed_) return 0;
    }
    start({program_main, name_.c_str()});
    loop();
    return line_ ? 0 : finish();
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
    pthread_attr_setstack(&attributes, the_console().memory.stack.data(), the_console().memory.stack.size());
    pthread_create(&program_, &attributes, run_program, &start_);
    pthread_attr_destroy(&attributes);
  }

  void loop() {
    auto& console = the_console();
    app::Progress progress(name_, settings_.frames.value_or(0));
    int waits = 0;  // since the last blank that the program waited for; none pass while a debugger stops it
    for (;;) {
      const auto state = console.handover.wait_for_program(blank_time);
      if (state == ProgramState::ended || state == ProgramState::crashed) {
        ending_.kind = state == ProgramState::ended ? Ending::Kind::ended : Ending::Kind::crashed;
        describe_end();
        if (line_) serve_end();
        return;
      }
      if (state == ProgramState::waiting) {
        ever_waited_ = true;
      } else if (++waits * blank_time < patience) {
        continue;
      }
      {
        const std::lock_guard lock(console.handover.console);
        blank();
      }
      if (state == ProgramState::waiting) waits = 0;
      if (settings_.frames) progress.step();
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
      console.pads[i] = line_ ? orders_.pads[done_][i] : at_frame(settings_.pads[i], frame);
    if (line_) serve(frame);
    if (pad_log_.empty() || std::prev(pad_log_.end())->second != console.pads[0])
      pad_log_[frame] = console.pads[0];
  }

  [[nodiscard]] bool is_over() const {
    return closed_ || (settings_.frames && the_console().blanks >= *settings_.frames);
  }

  /// So many frames are not told before progress is.
  static constexpr std::uint32_t told_every = 64;

  // The window's next orders; it may be long until they come.
  void wait_for_orders() {
    auto orders = line_->receive_orders();
    closed_ = !orders;
    if (closed_) return;
    orders_ = std::move(*orders);
    done_ = 0;
    set_silent(orders_.is_silent);
    if (orders_.frames <= orders_.kept) state_ = the_console().gpu.save();
  }

  void set_silent(bool is_silent) {
    if (is_silent == is_silent_) return;
    is_silent_ = is_silent;
    std::fflush(stdout);
    if (is_silent) {
      output_ = dup(STDOUT_FILENO);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      close(nowhere);
    } else {
      dup2(output_, STDOUT_FILENO);
      close(output_);
    }
  }

  // A frame has ended: told, if it is one of those wanted.
  void serve(std::uint32_t frame) {
    auto& console = the_console();
    ++done_;
    const auto left = orders_.frames - done_;
    if (left < orders_.kept) {
      tell(frame, false);
    } else {
      console.feed.take();
      if (done_ % told_every == 0) line_->send_progress(frame);
    }
    if (left == 0) return wait_for_orders();
    if (left <= orders_.kept) state_ = console.gpu.save();
  }

  void tell(std::uint32_t frame, bool is_last) {
    auto& console = the_console();
    ending_.never_waited = !ever_waited_;
    line_->send({frame, is_last, ending_, console.depth.shares(), console.lint.findings(), std::move(state_),
                 console.feed.take()});
  }

  // The program is over; the window that shows it is not.
  void serve_end() {
    auto& console = the_console();
    console.feed.next_field();
    if (state_.empty()) state_ = console.gpu.save();
    tell(console.blanks + 1, true);
    while (line_->receive_orders()) {
    }
  }

  void describe_end() {
    if (ending_.kind != Ending::Kind::crashed) return;
    const auto crash = describe_crash();
    ending_.signal = crash.signal;
    ending_.place = crash.place;
  }

  int finish() {
    auto& console = the_console();
    ending_.never_waited = !ever_waited_ && ending_.kind == Ending::Kind::reached;
    if (ending_.kind != Ending::Kind::reached) {  // what was drawn since the last blank
      console.feed.next_field();
      screen_.end_frame();
    }
    if (const auto& fault = console.feed.canvas_fault()) return complain(*fault);
    const auto judged = judge_without_depth();
    std::fflush(stdout);
    if (settings_.json != "-") std::fputs(to_text(console, ending_, name_).c_str(), stderr);
    if (auto written = write_files(); !written) return complain(written.error());
    if (!judged) return complain(judged.error());
    std::fflush(nullptr);
    return ending_.kind == Ending::Kind::crashed ? static_cast<int>(base::Exit::failed) : 0;
  }

  // One line that counts what a z-buffer drew in list order, or an error where that is refused.
  [[nodiscard]] base::Result<void> judge_without_depth() const {
    const auto count = the_console().feed.polygons_without_depth();
    if (count == 0 || settings_.knobs.visibility != scene::Visibility::zbuffer) return {};
    const auto text = std::to_string(count) + " polygons without depth";
    if (settings_.knobs.without_depth == scene::WithoutDepth::error)
      return base::fail(text + "; --without-depth list-order draws them", base::Exit::failed);
    const bool by_bucket = settings_.knobs.without_depth == scene::WithoutDepth::bucket;
    base::warn(name_, text + (by_bucket ? ": drawn with the depth of their bucket where they have one"
                                        : ": drawn in list order"));
    return {};
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
      if (auto done = dump::write_dump(settings_.record, dump::DumpFormat::standard, recording); !done)
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
  std::unique_ptr<Line> line_;  // to the window, if one shows this
  Orders orders_;
  std::uint32_t done_ = 0;        // frames of the orders
  std::vector<std::byte> state_;  // of the GPU before the frame at hand, if it will be told
  bool is_silent_ = false;
  int output_ = -1;  // standard output, while it is silent
  Start start_{};
  pthread_t program_{};
  PadScript pad_log_;
  Ending ending_;
  bool ever_waited_ = false, closed_ = false;
};

}  // namespace

int run(const Settings& settings, int (*program_main)(int, char**), const char* name,
        const ProgramMemory& memory) {
  the_console().memory = memory;
  return Host(settings, name).run(program_main);
}

void run_executable(int argc, char** argv, int (*program_main)(int, char**), const ProgramMemory& memory) {
  const auto name = std::filesystem::path(argv[0]).filename().string();
  int status = static_cast<int>(base::Exit::failed);
  try {
    const auto settings = parse_settings(argc, argv);
    if (settings) {
      status = run(*settings, program_main, name.c_str(), memory);
    } else {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), settings.error().text.c_str());
      status = static_cast<int>(settings.error().exit);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
  }
  // The program's thread stands still inside its frames: nothing of it may be destroyed.
  std::fflush(nullptr);
  std::_Exit(status);
}

}  // namespace sdk
