#include "app/window/window.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/window/cost_meter.h"
#include "app/window/cost_panel.h"
#include "app/window/imgui_layer.h"
#include "app/window/input.h"
#include "app/window/inspect_panel.h"
#include "app/window/inspection.h"
#include "app/window/knob_panel.h"
#include "app/window/layout.h"
#include "app/window/overlay.h"
#include "app/window/screen.h"
#include "app/window/sdl.h"
#include "app/window/show.h"
#include "app/window/vram_view.h"
#include "display/png.h"
#include "display/scanout.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

// Of the 16 that a frame at 60 Hz has.
constexpr double measuring_ms_per_frame = 6;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// For pictures in a window on the first screen, its frame and status line taken off.
Rect screen_room() {
  SDL_Rect usable{};
  if (SDL_GetDisplayUsableBounds(0, &usable) != 0) return {0, 0, 1 << 15, 1 << 15};
  constexpr int title_bar = 40;  // of what is not there yet nobody knows the height
  return {0, 0, usable.w, usable.h - title_bar - status_height(1)};
}

class Window {
 public:
  explicit Window(const WindowOptions& options)
      : options_(options), state_(options.first), show_(options.scenes) {}

  base::Result<int> run();

 private:
  base::Result<void> open();
  void take_events();
  void renew_textures();
  void update();
  void inspect();
  void measure();
  void draw();
  void draw_pictures();
  void follow_state();
  void take_screenshot();
  base::Result<void> write_window(const std::filesystem::path& path);
  void wait_for_next();
  void say(std::string text, bool is_error);

  const WindowOptions& options_;
  WindowState state_;
  SdlSession sdl_;
  Owned<SDL_Window> window_;
  Owned<SDL_Renderer> renderer_;
  std::unique_ptr<ImGuiLayer> gui_;
  Input input_;
  Show show_;
  std::unique_ptr<Inspection> inspection_;  // only while it is asked for
  int inspected_scene_ = -1;
  std::pair<Map, int> inspected_{Map::none, -1};  // what it last showed
  std::unique_ptr<CostMeter> meter_;              // likewise
  int metered_scene_ = -1;
  Screen left_, right_, vram_;
  Rect area_, picture_;  // for pictures; where the picture is
  float scale_ = 1;      // of letters
  bool is_fullscreen_ = false, is_minimised_ = false;
  Pace pace_ = Pace::vsync;
  std::string title_, message_;
  bool message_is_error_ = false;
  double message_until_ = 0;
  Clock::time_point begin_ = Clock::now(), due_ = begin_;
  double last_ = 0, frame_seconds_ = 1.0 / 60;
};

base::Result<void> Window::open() {
  if (!sdl_.is_open()) return base::fail(sdl_.error() + "; `otter render` needs none");
  const auto failed = [] { return base::fail(std::string("no window could be opened: ") + SDL_GetError()); };
  const auto size =
      wanted_area_within(state_.knobs.width, state_.knobs.height, options_.scale, screen_room());
  window_.reset(SDL_CreateWindow("Otter", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.width,
                                 size.height + status_height(1), SDL_WINDOW_RESIZABLE));
  if (!window_) return failed();
  SDL_SetWindowMinimumSize(window_.get(), 320, 240);
  renderer_.reset(SDL_CreateRenderer(window_.get(), -1, SDL_RENDERER_PRESENTVSYNC));
  if (!renderer_) renderer_.reset(SDL_CreateRenderer(window_.get(), -1, SDL_RENDERER_SOFTWARE));
  if (!renderer_) return failed();
  gui_ = std::make_unique<ImGuiLayer>(window_.get(), renderer_.get());
  return {};
}

void Window::say(std::string text, bool is_error) {
  message_ = std::move(text);
  message_is_error_ = is_error;
  message_until_ = seconds_since(begin_) + 4;
}

void Window::take_events() {
  SDL_Event event;
  while (SDL_PollEvent(&event) != 0) {
    gui_->take(event);
    if (event.type == SDL_WINDOWEVENT) {
      if (event.window.event == SDL_WINDOWEVENT_MINIMIZED) is_minimised_ = true;
      if (event.window.event == SDL_WINDOWEVENT_RESTORED || event.window.event == SDL_WINDOWEVENT_EXPOSED) {
        is_minimised_ = false;
      }
    }
    if (event.type == SDL_RENDER_DEVICE_RESET || event.type == SDL_RENDER_TARGETS_RESET) renew_textures();
    input_.take(event, seconds_since(begin_), picture_, state_);
  }
}

// The graphics driver has lost what it was given; a scene at rest would not bring it again.
void Window::renew_textures() {
  gui_->renew_font();
  left_ = {};
  right_ = {};
  vram_ = {};
  left_.show(renderer_.get(), show_.left());
  if (state_.compares()) right_.show(renderer_.get(), show_.right());
  inspected_ = {Map::none, -1};
}

// Lets time pass, moves the camera, draws the scene if anything has changed.
void Window::update() {
  const double now = seconds_since(begin_);
  const double passed = now - std::exchange(last_, now);
  frame_seconds_ += (passed - frame_seconds_) * 0.05;
  let_pass(state_, passed);
  input_.move_camera(now, std::min(passed, 0.1), show_.machine(), state_);
  const auto updated = show_.update(state_);
  if (!updated) {
    say(updated.error().text, true);
    return;
  }
  if (*updated) {
    left_.show(renderer_.get(), show_.left());
    if (state_.compares()) right_.show(renderer_.get(), show_.right());
    if (message_is_error_) message_.clear();
  }
  inspect();
  measure();
  if (state_.vram && show_.machine() != nullptr) {
    vram_.show(renderer_.get(), display::scan_out_all(show_.machine()->gpu().vram().pixels()));
  }
}

// Watches the frame while the inspector is open, and shows what it asks for in place of the left picture.
void Window::inspect() {
  if (!state_.inspect || show_.machine() == nullptr) {
    if (inspection_ && !show_.left().pixels.empty()) left_.show(renderer_.get(), show_.left());
    inspection_.reset();
    return;
  }
  if (!inspection_ || inspected_scene_ != state_.scene) {
    inspection_ = std::make_unique<Inspection>(*show_.machine(), state_.knobs);
    inspected_scene_ = state_.scene;
  }
  const auto drawn = inspection_->update(state_);
  if (!drawn) return say(drawn.error().text, true);
  const std::pair asked(inspection_->unwatched().empty() ? state_.map : Map::none, state_.first_draws);
  if (!*drawn && asked == inspected_ && asked.first != Map::none) return;  // a map takes a while
  inspected_ = asked;
  if (asked.first != Map::none) {
    left_.show(renderer_.get(), inspection_->map(asked.first));
  } else {
    left_.show(renderer_.get(),
               state_.first_draws < 0 ? show_.left() : inspection_->after(state_.first_draws));
  }
}

// Grants the cost panel its share of this frame. A meter that is no longer wanted goes when its last drawing
// is done: waiting for it would show.
void Window::measure() {
  const bool wanted = state_.cost && show_.machine() != nullptr;
  if (meter_ && (!wanted || metered_scene_ != state_.scene)) meter_->stop();
  if (meter_ && meter_->has_ended()) meter_.reset();
  if (!wanted) return;
  if (!meter_) {
    meter_ = std::make_unique<CostMeter>(show_.machine()->scene_as_given());
    metered_scene_ = state_.scene;
  }
  meter_->follow(state_.frame, state_.knobs, state_.camera, measuring_ms_per_frame);
}

void Window::follow_state() {
  if (state_.fullscreen != is_fullscreen_) {
    is_fullscreen_ = state_.fullscreen;
    SDL_SetWindowFullscreen(window_.get(), is_fullscreen_ ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
  }
  if (state_.pace != pace_) {
    pace_ = state_.pace;
    SDL_RenderSetVSync(renderer_.get(), pace_ == Pace::vsync ? 1 : 0);
    due_ = Clock::now();
  }
  auto title = "Otter: " + show_.scene_name();
  if (title != title_) SDL_SetWindowTitle(window_.get(), title.c_str());
  title_ = std::move(title);

  int width = 0;
  int height = 0;
  SDL_GetRendererOutputSize(renderer_.get(), &width, &height);
  scale_ = static_cast<float>(std::max(1, std::min(width / 900, height / 700)));
  area_ = {0, 0, width, std::max(height - status_height(scale_), 1)};
  if (state_.vram) {
    picture_ = place_vram(area_);
  } else {
    picture_ = left_.is_empty() ? area_ : place(left_.width(), left_.height(), area_);
  }
}

void Window::draw_pictures() {
  if (state_.vram) {
    vram_.draw(renderer_.get(), picture_);
  } else if (state_.split) {
    left_.draw(renderer_.get(), picture_, 0, state_.divider);
    right_.draw(renderer_.get(), picture_, state_.divider, 1);
  } else {
    left_.draw(renderer_.get(), picture_);
  }
}

void Window::draw() {
  SDL_SetRenderDrawColor(renderer_.get(), 0x0b, 0x0b, 0x10, 0xff);
  SDL_RenderClear(renderer_.get());
  draw_pictures();
  gui_->begin(scale_);
  if (state_.vram && show_.machine() != nullptr) {
    draw_vram_marks(show_.machine()->gpu(), picture_, scale_);
  } else {
    if (state_.split) draw_divider(state_, picture_);
    draw_captions(state_, picture_, scale_);
  }
  if (state_.help) draw_help(state_, area_, scale_);
  if (inspection_ && !state_.vram) {
    draw_inspect_panel(state_, *inspection_, picture_, left_.width(), left_.height(), area_, scale_);
  }
  if (meter_ && state_.cost && metered_scene_ == state_.scene) {
    draw_cost_panel(state_, meter_->table(), area_, scale_);
  }
  if (state_.panel) draw_knob_panel(state_, show_.scene_name(), area_, scale_);
  if (seconds_since(begin_) < message_until_ || message_is_error_) {
    draw_message(message_, message_is_error_, area_, scale_);
  }
  const Status status{show_.scene_name(), show_.stats(), 1 / std::max(frame_seconds_, 1e-4),
                      show_.different()};
  draw_status(state_, status, {0, area_.height, area_.width, status_height(scale_)}, scale_);
  gui_->end();
}

base::Result<void> Window::write_window(const std::filesystem::path& path) {
  int width = 0;
  int height = 0;
  SDL_GetRendererOutputSize(renderer_.get(), &width, &height);
  base::Picture picture(width, height);
  if (SDL_RenderReadPixels(renderer_.get(), nullptr, SDL_PIXELFORMAT_RGBA32, picture.pixels.data(),
                           width * 4) != 0) {
    return base::fail(path.string() + ": the window cannot be read back: " + SDL_GetError(),
                      base::Exit::failed);
  }
  return display::write_png(path, picture);
}

// Into the current folder, under a name that is not taken yet.
void Window::take_screenshot() {
  const auto stem = "otter-" + std::filesystem::path(show_.scene_name()).stem().string() + "-" +
                    std::to_string(state_.frame);
  std::filesystem::path path = stem + ".png";
  std::error_code ignored;
  for (int n = 2; std::filesystem::exists(path, ignored); ++n) path = stem + "-" + std::to_string(n) + ".png";
  const auto written = write_window(path);
  if (!written) return say(written.error().text, true);
  say("saved " + std::filesystem::absolute(path, ignored).string(), false);
}

// A fixed pace sleeps until its next frame is due. With vsync SDL has waited already, unless the driver does
// not: then 250 frames a second are enough.
void Window::wait_for_next() {
  using std::chrono::duration;
  const double period = pace_ == Pace::hz60 ? 1.0 / 60 : pace_ == Pace::hz50 ? 1.0 / 50 : 1.0 / 250;
  due_ += std::chrono::duration_cast<Clock::duration>(duration<double>(period));
  const double early = -seconds_since(due_);
  if (early > 0) SDL_Delay(static_cast<Uint32>(early * 1000));
  if (early < -0.1 || pace_ == Pace::vsync) due_ = Clock::now();  // late: do not hurry after it
}

base::Result<int> Window::run() {
  if (auto opened = open(); !opened) return tl::make_unexpected(opened.error());
  if (auto first = show_.update(state_); !first) return tl::make_unexpected(first.error());
  left_.show(renderer_.get(), show_.left());
  if (state_.compares()) right_.show(renderer_.get(), show_.right());
  last_ = seconds_since(begin_);
  due_ = Clock::now();
  for (int drawn = 0; !state_.quit; ++drawn) {
    take_events();
    if (is_minimised_) {
      SDL_WaitEventTimeout(nullptr, 100);
      last_ = seconds_since(begin_);
      if (!options_.frames) continue;
    }
    update();
    follow_state();
    draw();
    const bool is_last = options_.frames && drawn + 1 >= *options_.frames;
    if (is_last && !options_.screenshot.empty()) {
      if (auto written = write_window(options_.screenshot); !written)
        return tl::make_unexpected(written.error());
    }
    if (std::exchange(state_.screenshot, false)) take_screenshot();
    SDL_RenderPresent(renderer_.get());
    if (is_last) break;
    wait_for_next();
  }
  return 0;
}

}  // namespace

base::Result<int> run_window(const WindowOptions& options) { return Window(options).run(); }

}  // namespace app
