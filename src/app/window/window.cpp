#include "app/window/window.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/live.h"
#include "app/window/cost_panel.h"
#include "app/window/imgui_layer.h"
#include "app/window/input.h"
#include "app/window/inspect_panel.h"
#include "app/window/knob_choices.h"
#include "app/window/knob_panel.h"
#include "app/window/layout.h"
#include "app/window/lens.h"
#include "app/window/live_follower.h"
#include "app/window/metering.h"
#include "app/window/overlay.h"
#include "app/window/pacing.h"
#include "app/window/pad_keys.h"
#include "app/window/panel_frame.h"
#include "app/window/saves.h"
#include "app/window/screen.h"
#include "app/window/sdl.h"
#include "app/window/selection.h"
#include "app/window/settings.h"
#include "app/window/show.h"
#include "app/window/status.h"
#include "app/window/table_panel.h"
#include "app/window/timeline_bar.h"
#include "app/window/vram_panel.h"
#include "app/window/vram_screen.h"
#include "app/window/vram_view.h"
#include "app/window/watching.h"
#include "display/png.h"

namespace app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Widgets need some frames until they stand where they belong.
constexpr int settling = 3;

// For pictures in a window on the first screen, its frame and status line taken off.
Rect screen_room() {
  SDL_Rect usable{};
  if (SDL_GetDisplayUsableBounds(0, &usable) != 0) return {0, 0, 1 << 15, 1 << 15};
  constexpr int title_bar = 40;  // of what is not there yet nobody knows the height
  return {0, 0, usable.w, usable.h - title_bar - status_height(1, 1)};
}

class Window {
 public:
  explicit Window(const WindowOptions& options)
      : options_(options), state_(options.first), scenes_(options.scenes), show_(scenes_) {}

  base::Result<int> run();

 private:
  base::Result<void> open();
  bool take_events();
  void renew_textures();
  void update();
  void show_vram();
  void follow_recording();
  void inspect();
  void look_closely();
  void resolve_click();
  void open_file(const std::string& path);
  void export_changes();
  [[nodiscard]] bool looks_closely() const;
  [[nodiscard]] VramMapping picture_mapping() const;
  void draw_marks();
  void draw();
  void draw_pictures();
  void draw_panels();
  void draw_menus();
  void follow_state();
  void lay_out_window();
  [[nodiscard]] base::Picture shown_picture() const;
  void save_picture();
  void record();
  void told_saved(const base::Result<void>& written, const std::filesystem::path& path);
  [[nodiscard]] bool is_at_rest() const;
  void wait_for_next();
  void say(std::string text, bool is_error);
  [[nodiscard]] bool is_inspecting() const { return state_.shows(Panel::inspect); }

  const WindowOptions& options_;
  WindowState state_;
  std::vector<WindowScene> scenes_;  // those of the options, and files that were dropped
  SdlSession sdl_;
  Owned<SDL_Window> window_;
  Owned<SDL_Renderer> renderer_;
  std::unique_ptr<ImGuiLayer> gui_;
  Input input_;
  Show show_;
  Watching watching_;
  Metering metering_;
  Lens lens_;
  Pulse pulse_;
  std::optional<std::int64_t> first_different_;

  Screen left_, right_;
  VramScreen vram_;
  Rect area_, picture_;  // above the status line; where the picture is
  DockLayout layout_;
  Rect bar_;  // of the frames of a recording
  bool is_indexing_ = true;
  LiveFollower follower_;
  int shown_scene_ = -1;
  std::optional<std::size_t> lens_shown_;
  std::vector<std::vector<StatusPiece>> status_;
  float scale_ = 1;  // of letters
  int redraws_ = 0;  // the window is drawn so many times more though nothing happens
  bool is_fullscreen_ = false, is_minimised_ = false;
  Pacing pacing_;
  std::string title_, message_;
  bool message_is_error_ = false;
  double message_until_ = 0;
  Clock::time_point begin_ = Clock::now();
  double last_ = 0, frame_seconds_ = 1.0 / 60;
};

base::Result<void> Window::open() {
  if (!sdl_.is_open()) return base::fail(sdl_.error() + "; `otter render` needs none");
  const auto failed = [] { return base::fail(std::string("no window could be opened: ") + SDL_GetError()); };
  const auto size =
      wanted_area_within(state_.knobs.width, state_.knobs.height, options_.scale, screen_room());
  Status first;
  first.scene =
      std::filesystem::path(scenes_[static_cast<std::size_t>(state_.scene)].name).filename().string();
  const int columns = (size.width - 20) / ImGuiLayer::designed_letter_width;
  const auto rows = status_rows(status_pieces(state_, first), columns).size();
  window_.reset(SDL_CreateWindow("Otter", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, size.width,
                                 size.height + status_height(1, rows),
                                 SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI));
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
  redraws_ = settling;
}

// True: something happened.
bool Window::take_events() {
  SDL_Event event;
  bool is_any = false;
  while (SDL_PollEvent(&event) != 0) {
    is_any = true;
    ImGuiLayer::take(event);
    if (event.type == SDL_WINDOWEVENT) {
      if (event.window.event == SDL_WINDOWEVENT_MINIMIZED) is_minimised_ = true;
      if (event.window.event == SDL_WINDOWEVENT_RESTORED || event.window.event == SDL_WINDOWEVENT_EXPOSED) {
        is_minimised_ = false;
      }
    }
    if (event.type == SDL_DROPFILE && event.drop.file != nullptr) {
      open_file(event.drop.file);
      SDL_free(event.drop.file);
    }
    if (event.type == SDL_RENDER_DEVICE_RESET || event.type == SDL_RENDER_TARGETS_RESET) renew_textures();
    input_.take(event, seconds_since(begin_), picture_, state_);
  }
  return is_any;
}

// As a scene of its own, behind the others, and shown.
void Window::open_file(const std::string& path) {
  if (!options_.open) return;
  auto opened = options_.open(path);
  if (!opened) return say(opened.error().text, true);
  scenes_.push_back(std::move(*opened));
  state_.scenes = static_cast<int>(scenes_.size());
  handle(state_, {KeyAction::select_scene, state_.scenes - 1});
}

// The graphics driver has lost what it was given; a scene at rest would not bring it again.
void Window::renew_textures() {
  gui_->renew_font();
  left_ = {};
  right_ = {};
  vram_.forget();
  left_.show(renderer_.get(), shown_picture());
  if (state_.compares()) right_.show(renderer_.get(), show_.right());
  watching_.show_anew();
}

// Lets time pass, moves the camera, draws the scene if anything has changed.
void Window::update() {
  const double now = seconds_since(begin_);
  const double passed = now - std::exchange(last_, now);
  frame_seconds_ += (passed - frame_seconds_) * 0.05;
  let_pass(state_, passed);
  input_.move_camera(now, std::min(passed, 0.1), show_.machine(), state_);
  follow_recording();
  if (auto* subject = show_.machine(); subject != nullptr && subject->wants_pad()) {
    subject->hold(held_pad(ImGui::GetIO().WantTextInput));
  }
  const auto updated = show_.update(state_);
  if (!updated) {
    if (message_ != updated.error().text) say(updated.error().text, true);
    return;
  }
  if (*updated) {
    vram_.forget();
    if (shown_scene_ != state_.scene) {
      shown_scene_ = state_.scene;
      is_indexing_ = true;
      first_different_.reset();
    }
    redraws_ = settling;
    left_.show(renderer_.get(), show_.left());
    if (state_.compares()) right_.show(renderer_.get(), show_.right());
    if (message_is_error_) message_.clear();
  }
  follow_recording();
  if (show_.machine() != nullptr && show_.machine()->is_behind()) return;  // it has another frame
  look_closely();
  state_.clicked.reset();  // a click that nobody wanted
  inspect();
  metering_.update(state_, show_.machine());
  show_vram();
}

void Window::show_vram() {
  if (!state_.shows(Panel::vram) || show_.machine() == nullptr) return vram_.forget();
  const bool is_lens = looks_closely() && lens_.view() != nullptr;
  const bool is_new = vram_.update(renderer_.get(), state_.vram,
                                   [&] { return is_lens ? lens_.vram(state_) : show_.machine()->vram(); });
  if (is_new) redraws_ = settling;
}

// A recording has so many frames, more of which become known while it is shown.
void Window::follow_recording() {
  auto* subject = show_.machine();
  if (subject == nullptr || show_.scene() != state_.scene) return;
  if (auto* live = subject->live()) {
    const auto error = follower_.follow(*live, state_);
    if (!error.empty() && message_ != error) say(error, true);
    return;
  }
  const auto last = subject->last_frame();
  state_.recorded.last = last.value_or(0);
  state_.recorded.is_growing = subject->is_growing();
  state_.recorded.has_ended = subject->has_ended();
  state_.recorded.wants_pad = subject->wants_pad();
  if (!last || subject->is_behind()) return;  // how far it comes is not known yet
  state_.frame = std::clamp<std::int64_t>(state_.frame, 1, state_.recorded.furthest());
  constexpr double indexing_ms_per_frame = 8;
  if (is_indexing_) is_indexing_ = subject->index_some(indexing_ms_per_frame);
  if (show_.different().value_or(0) != 0) {
    first_different_ = std::min(first_different_.value_or(state_.frame), state_.frame);
  }
}

bool Window::looks_closely() const {
  const auto& lens = state_.lens;
  if (is_inspecting() && state_.paused && (lens.selected || state_.clicked)) return true;
  return state_.shows(Panel::table) || state_.shows(Panel::vram) || lens.shown || !lens.edits.is_empty() ||
         lens.step;
}

// Takes the frame apart, as far as anybody looks.
void Window::look_closely() {
  auto* subject = show_.machine();
  if (subject == nullptr || show_.scene() != state_.scene) return;
  if (!looks_closely()) return;
  const auto updated = lens_.update(state_, *subject);
  if (!updated) return say(updated.error().text, true);
  if (state_.lens.step) take_step(state_, lens_, *std::exchange(state_.lens.step, std::nullopt));
  resolve_click();
  if (state_.lens.filter.only_wrong && lens_.view() != nullptr) lens_.report();
  const bool is_changed = *updated || state_.lens.shown != lens_shown_;
  lens_shown_ = state_.lens.shown;
  if (!is_changed) return;
  redraws_ = settling;
  if (*updated) vram_.forget_accesses();
  if (watching_.inspection() == nullptr) left_.show(renderer_.get(), shown_picture());
  vram_.forget();
}

// A click on the picture, or on VRAM, selects the command that is seen there.
void Window::resolve_click() {
  if (!state_.clicked || lens_.view() == nullptr) return;
  const auto at = *std::exchange(state_.clicked, std::nullopt);
  if (const auto pixel = picture_mapping().pixel_at(at.x, at.y)) pick(state_.lens, *lens_.view(), *pixel);
}

// What of VRAM the picture shows.
VramMapping Window::picture_mapping() const {
  if (state_.shows(Panel::vram)) return vram_mapping(state_.vram, picture_);
  const auto& area = lens_.area();
  return {picture_, double(area.x), double(area.y), double(std::max(area.width, 1)),
          double(std::max(area.height, 1))};
}

void Window::draw_marks() {
  auto* view = lens_.view();
  if (view == nullptr || !looks_closely()) return;
  const auto mapping = picture_mapping();
  const double pulse = pulse_.of(state_.lens.selected, seconds_since(begin_));
  if (pulse != 0) redraws_ = std::max(redraws_, 2);
  if (state_.lens.selected) {
    if (const auto row = view->row_of_item(*state_.lens.selected)) {
      draw_selection(*view, view->rows()[*row], mapping, picture_, pulse);
      if (state_.shows(Panel::vram)) draw_sources(*view, view->rows()[*row], mapping, picture_);
    }
  }
  if (state_.lens.pinned) draw_pin(*state_.lens.pinned, mapping, picture_);
}

void Window::export_changes() {
  const auto path = std::filesystem::path(free_name(show_.scene_name(), state_.frame, "-changed", ".psxgpu"));
  told_saved(save_changes(*lens_.view(), path), path);
}

// What the inspector asks for stands in place of the left picture.
void Window::inspect() {
  const auto watched = watching_.update(state_, show_.machine());
  if (!watched) return say(watched.error().text, true);
  if (*watched == Watching::Change::none || show_.left().pixels.empty()) return;
  if (*watched == Watching::Change::frame) redraws_ = settling;
  left_.show(renderer_.get(), shown_picture());
}

// What stands at the left, or alone, a pixel for each of the console's.
base::Picture Window::shown_picture() const {
  if (!watching_.shows_map(state_) && looks_closely()) {
    if (auto picture = lens_.picture(state_)) return *std::move(picture);
  }
  if (auto picture = watching_.picture(state_)) return *std::move(picture);
  return show_.left();
}

void Window::follow_state() {
  if (state_.fullscreen != is_fullscreen_) {
    is_fullscreen_ = state_.fullscreen;
    SDL_SetWindowFullscreen(window_.get(), is_fullscreen_ ? SDL_WINDOW_FULLSCREEN_DESKTOP : 0);
  }
  pacing_.follow(state_.pace, renderer_.get());
  auto title = window_title(state_, show_.scene_name());
  if (title != title_) SDL_SetWindowTitle(window_.get(), title.c_str());
  title_ = std::move(title);

  lay_out_window();
}

// Letters, status line, columns of panels, and in what they leave the picture.
void Window::lay_out_window() {
  int width = 0;
  int height = 0;
  int points = 0;
  SDL_GetRendererOutputSize(renderer_.get(), &width, &height);
  SDL_GetWindowSize(window_.get(), &points, nullptr);
  const double pixels_per_point = static_cast<double>(width) / std::max(points, 1);
  scale_ = static_cast<float>(letter_scale(dots_per_inch(window_.get()), pixels_per_point, state_.text_size));
  gui_->set_scale(scale_);
  const Status status{std::filesystem::path(show_.scene_name()).filename().string(), show_.stats(),
                      1 / std::max(frame_seconds_, 1e-4), show_.different()};
  const auto columns = static_cast<int>((static_cast<float>(width) - 20) / ImGuiLayer::letter_width());
  status_ = status_rows(status_pieces(state_, status), columns);
  area_ = {0, 0, width, std::max(height - status_height(scale_, status_.size()), 1)};
  layout_ = lay_out(state_.dock, area_, double{scale_});
  bar_ = layout_.picture;
  bar_.height = std::min(timeline_height(state_, scale_), bar_.height / 2);
  layout_.picture.height -= bar_.height;
  bar_.y += layout_.picture.height;
  if (state_.shows(Panel::vram)) {
    picture_ = place_vram(layout_.picture);
  } else {
    picture_ = left_.is_empty() ? layout_.picture : place(left_.width(), left_.height(), layout_.picture);
  }
}

void Window::draw_pictures() {
  if (state_.shows(Panel::vram)) {
    vram_.draw(renderer_.get(), state_.vram, picture_);
  } else if (state_.split) {
    left_.draw(renderer_.get(), picture_, 0, state_.divider);
    right_.draw(renderer_.get(), picture_, state_.divider, 1);
  } else {
    left_.draw(renderer_.get(), picture_);
  }
}

// Each where it is docked.
void Window::draw_panels() {
  const auto* machine = show_.machine();
  if (machine == nullptr) return;
  const bool is_moved = state_.camera != CameraOffset{};
  const auto command = render_command(show_.scene_name(), state_.frame, state_.knobs,
                                      is_moved ? std::optional(machine->place(state_.camera)) : std::nullopt);
  for (const auto& docked : layout_.panels) {
    switch (docked.panel) {
      case Panel::knobs:
        draw_knob_panel(state_, *machine, command, docked, scale_);
        break;
      case Panel::inspect:
        if (auto* watched = watching_.inspection()) draw_inspect_panel(state_, *watched, docked, scale_);
        break;
      case Panel::cost:
        if (const auto table = metering_.table(state_.scene)) {
          draw_cost_panel(state_, *table, docked, scale_);
        }
        break;
      case Panel::table:
        if (draw_table_panel(state_, lens_, docked, scale_).exports) export_changes();
        break;
      case Panel::vram:
        if (draw_vram_panel(state_, lens_.view(), vram_.accesses(lens_.view()), docked, scale_)) {
          state_.save_picture = true;
        }
        break;
    }
  }
  draw_edges(state_, layout_, area_, scale_);
}

// Which of ImGui's menus is open only it knows, inside of a frame.
void Window::draw_menus() {
  if (std::exchange(state_.close_menu, false)) ImGui::ClosePopupToLevel(0, true);
  state_.menu = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void Window::draw() {
  SDL_SetRenderDrawColor(renderer_.get(), 0x0b, 0x0b, 0x10, 0xff);
  SDL_RenderClear(renderer_.get());
  draw_pictures();
  ImGuiLayer::begin();
  const bool shows_vram = state_.shows(Panel::vram);
  if (shows_vram && show_.machine() != nullptr) {
    if (!vram_.pixels().empty()) {
      draw_vram_marks(show_.machine()->gpu(), vram_.pixels(), picture_mapping(), state_.vram.grid, scale_);
    }
  } else {
    if (state_.split) draw_divider(state_, picture_);
    draw_captions(state_, picture_, scale_);
    if (show_.machine() != nullptr) draw_reason(show_.machine()->why_empty(), picture_);
  }
  draw_marks();
  draw_panels();
  if (show_.machine() != nullptr && state_.recorded.last != 0) {
    const auto* view = looks_closely() ? lens_.view() : nullptr;
    draw_timeline(state_,
                  {show_.machine()->progress(), first_different_, view != nullptr ? view->rows().size() : 0},
                  bar_, scale_);
  }
  auto* watched = watching_.inspection();
  if (watched != nullptr && !shows_vram && state_.paused && watched->unwatched().empty()) {
    draw_history(*watched, picture_, left_.width(), left_.height());
  }
  if (state_.help) draw_help(state_, area_, scale_);
  draw_menus();
  if (seconds_since(begin_) < message_until_ || message_is_error_) {
    draw_message(message_, message_is_error_, layout_.picture, scale_);
  }
  draw_status(status_, {0, area_.height, area_.width, status_height(scale_, status_.size())}, scale_);
  gui_->end();
}

// Begins or ends it.
void Window::record() {
  auto* subject = show_.machine();
  if (subject == nullptr) return;
  if (auto* live = subject->live()) {
    if (live->link() != nullptr) live->link()->ask(door::LiveAsk::record);
    return;
  }
  const auto path = free_name(show_.scene_name(), state_.frame, "", ".psxgpu");
  const auto done = subject->record(std::filesystem::absolute(path).string());
  say(done ? *done : done.error().text, !done);
}

void Window::told_saved(const base::Result<void>& written, const std::filesystem::path& path) {
  if (!written) return say(written.error().text, true);
  std::error_code ignored;
  say("saved " + std::filesystem::absolute(path, ignored).string(), false);
}

// Pixel for pixel, without a word on it.
void Window::save_picture() {
  const auto* machine = show_.machine();
  if (machine == nullptr) return;
  const bool is_vram = state_.shows(Panel::vram);
  const auto path = free_name(show_.scene_name(), state_.frame, is_vram ? "-vram" : "");
  const auto picture = is_vram && !vram_.pixels().empty() ? vram_.picture(state_.vram) : shown_picture();
  told_saved(display::write_png(path, picture), path);
}

// At rest nothing changes on the screen until something happens outside.
bool Window::is_at_rest() const {
  const bool is_behind = show_.machine() != nullptr && show_.machine()->is_behind();
  const bool is_busy = metering_.is_measuring() || is_behind || input_.is_moving() ||
                       (is_indexing_ && state_.recorded.last != 0);
  return state_.paused && redraws_ == 0 && !is_busy && !options_.frames;
}

// At rest for an event, or until what is on screen changes by itself.
void Window::wait_for_next() {
  if (!is_at_rest()) return pacing_.wait();
  const double message = message_is_error_ ? 0 : message_until_ - seconds_since(begin_);
  constexpr int long_ms = 1000;
  const bool is_typing = ImGui::GetIO().WantTextInput;  // its cursor blinks
  SDL_WaitEventTimeout(nullptr, message > 0 ? static_cast<int>(message * 1000) + 1
                                : is_typing ? long_ms / 5
                                            : long_ms);
  if (message > 0 || is_typing) redraws_ = 1;
  pacing_.start_anew();
}

base::Result<int> Window::run() {
  if (auto opened = open(); !opened) return tl::make_unexpected(opened.error());
  if (auto first = show_.update(state_); !first) return tl::make_unexpected(first.error());
  left_.show(renderer_.get(), show_.left());
  if (state_.compares()) right_.show(renderer_.get(), show_.right());
  last_ = seconds_since(begin_);
  pacing_.start_anew();
  redraws_ = settling;
  for (int drawn = 0; !state_.quit; ++drawn) {
    if (take_events()) redraws_ = settling;
    if (is_minimised_) {
      SDL_WaitEventTimeout(nullptr, 100);
      last_ = seconds_since(begin_);
      if (!options_.frames) continue;
    }
    update();
    follow_state();
    if (is_at_rest()) {
      wait_for_next();
      continue;
    }
    draw();
    if (redraws_ > 0) --redraws_;
    const bool is_last = options_.frames && drawn + 1 >= *options_.frames;
    if (is_last && !options_.screenshot.empty()) {
      if (auto written = save_window(renderer_.get(), options_.screenshot); !written)
        return tl::make_unexpected(written.error());
    }
    if (std::exchange(state_.save_window, false)) {
      const auto path = free_name(show_.scene_name(), state_.frame, "-window");
      told_saved(save_window(renderer_.get(), path), path);
    }
    if (std::exchange(state_.save_picture, false)) save_picture();
    if (std::exchange(state_.record, false)) record();
    SDL_RenderPresent(renderer_.get());
    if (is_last) break;
    wait_for_next();
  }
  if (options_.settings) {
    write_settings(*options_.settings, {state_.knobs, state_.dock, state_.text_size, state_.pace});
  }
  return 0;
}

}  // namespace

base::Result<int> run_window(const WindowOptions& options) { return Window(options).run(); }

}  // namespace app
