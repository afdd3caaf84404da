#include "app/window/input.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "app/subject.h"
#include "app/window/pad_keys.h"
#include "app/window/program_keys.h"
#include "app/window/vram_view.h"

namespace app {
namespace {

constexpr double radians_per_second = 1.5;
constexpr double distances_per_second = 0.8;

bool may_repeat(KeyAction action) {
  return action == KeyAction::next_frame || action == KeyAction::previous_frame;
}

// What Ctrl makes of a key: + and = share one on most keyboards, and the keypad has its own.
std::string control_name(std::string name) {
  if (name.starts_with("Keypad ")) name.erase(0, 7);
  return "Ctrl " + (name == "=" ? "+" : name);
}

// -1..1, with the middle that a stick never quite returns to cut out.
double axis(SDL_GameController* controller, SDL_GameControllerAxis which) {
  const double value = SDL_GameControllerGetAxis(controller, which) / 32767.0;
  constexpr double dead = 0.18;
  const double size = std::abs(value);
  return size < dead ? 0 : std::copysign((size - dead) / (1 - dead), value);
}

}  // namespace

void Input::take(const SDL_Event& event, double now, Rect picture, WindowState& state) {
  const auto& gui = ImGui::GetIO();
  switch (event.type) {
    case SDL_QUIT:
      state.quit = true;
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      if (!gui.WantTextInput || event.key.keysym.sym == SDLK_TAB) take_key(event.key, now, state);
      break;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) {
        held_.release_all();
        release_program_keys(state);
      }
      break;
    case SDL_MOUSEBUTTONDOWN:
      if (!gui.WantCaptureMouse) take_press(event.button, picture, state);
      break;
    case SDL_MOUSEBUTTONUP:
      if (event.button.button == SDL_BUTTON_LEFT && drag_ == Drag::orbit && !has_moved_) {
        state.clicked = Point{event.button.x, event.button.y};
      }
      drag_ = Drag::none;
      break;
    case SDL_MOUSEMOTION:
      take_drag(event.motion, picture, state);
      break;
    case SDL_MOUSEWHEEL:
      if (!gui.WantCaptureMouse) take_wheel(event.wheel, picture, state);
      break;
    case SDL_CONTROLLERDEVICEADDED:
      controllers_.emplace_back(SDL_GameControllerOpen(event.cdevice.which));
      break;
    case SDL_CONTROLLERDEVICEREMOVED:
      std::erase_if(controllers_,
                    [](const auto& c) { return SDL_GameControllerGetAttached(c.get()) == SDL_FALSE; });
      break;
    case SDL_CONTROLLERBUTTONDOWN: {
      if (state.recorded.wants_pad) break;
      const auto button = static_cast<SDL_GameControllerButton>(event.cbutton.button);
      const char* name = SDL_GameControllerGetStringForButton(button);
      if (const auto asked = asked_by_button(name != nullptr ? name : "")) handle(state, *asked);
      break;
    }
    default:
      break;
  }
}

// True: it is for the program that runs, not for this window.
bool Input::take_program_key(const SDL_KeyboardEvent& key, WindowState& state) {
  const auto keysym = x11_keysym(key.keysym.sym);
  if (keysym == 0) return false;
  const auto held = std::find(program_held_.begin(), program_held_.end(), keysym);
  if (key.type == SDL_KEYUP) {
    if (held == program_held_.end()) return false;
    program_held_.erase(held);
    state.live.keys.push_back({keysym, false});
    return true;
  }
  const std::string name = SDL_GetKeyName(key.keysym.sym);
  const bool is_with_control = (key.keysym.mod & KMOD_CTRL) != 0;
  const bool is_own = is_function_key(name) || name == "Insert";
  const bool is_programs = is_with_control           ? is_function_key(name) || name == "Escape"
                           : state.live.program_keys ? !is_own
                                                     : !is_own && !asked_by_key(name);
  if (!is_programs) return false;
  if (held != program_held_.end()) return true;  // repeats
  program_held_.push_back(keysym);
  state.live.keys.push_back({keysym, true});
  return true;
}

void Input::release_program_keys(WindowState& state) {
  for (const auto keysym : program_held_) state.live.keys.push_back({keysym, false});
  program_held_.clear();
}

void Input::take_key(const SDL_KeyboardEvent& key, double now, WindowState& state) {
  if (state.live.is_live && take_program_key(key, state)) return;
  const std::string name = SDL_GetKeyName(key.keysym.sym);
  if (key.type == SDL_KEYUP) {
    const auto asked = asked_by_key(name);
    if (held_.release(name, now) && asked) handle(state, *asked);
    return;
  }
  const auto held = key.keysym.mod;
  if ((held & (KMOD_ALT | KMOD_GUI)) != 0) {  // the window manager's, but for the usual full screen
    if ((held & KMOD_ALT) != 0 && name == "Return" && key.repeat == 0) handle(state, {KeyAction::fullscreen});
    return;
  }
  if ((held & KMOD_CTRL) != 0) {
    if (const auto asked = asked_by_key(control_name(name))) handle(state, *asked);
    return;
  }
  if (state.recorded.wants_pad && is_pad_key(name)) return;
  const auto shifted = (held & KMOD_SHIFT) != 0 ? asked_by_key("Shift " + name) : std::nullopt;
  if (!shifted && held_.press(name, now)) return;
  const auto asked = shifted ? shifted : asked_by_key(name);
  if (asked && (key.repeat == 0 || may_repeat(asked->action))) handle(state, *asked);
}

void Input::take_press(const SDL_MouseButtonEvent& button, Rect picture, const WindowState& state) {
  pressed_ = {button.x, button.y};
  has_moved_ = false;
  if (button.button == SDL_BUTTON_RIGHT) drag_ = Drag::look;
  if (button.button != SDL_BUTTON_LEFT) return;
  const int divider = picture.x + static_cast<int>(state.divider * picture.width);
  const bool on_divider = state.split && !state.shows(Panel::vram) && std::abs(button.x - divider) <= 8;
  drag_ = on_divider ? Drag::divider : Drag::orbit;
}

void Input::take_drag(const SDL_MouseMotionEvent& motion, Rect picture, WindowState& state) {
  constexpr int still = 3;  // pixels that a click may move
  has_moved_ =
      has_moved_ || std::abs(motion.x - pressed_.x) > still || std::abs(motion.y - pressed_.y) > still;
  if (!has_moved_) return;
  const double across = std::max(picture.width, 1);
  const double x = motion.xrel / across;
  const double y = motion.yrel / across;
  switch (drag_) {
    case Drag::none:
      break;
    case Drag::divider:
      state.divider = std::clamp((motion.x - picture.x) / across, 0.02, 0.98);
      break;
    case Drag::orbit:
      if (state.shows(Panel::vram))
        return pan_vram(state.vram, -x, -motion.yrel / std::max<double>(picture.height, 1));
      orbit(state.camera, -4 * x, -4 * y);
      break;
    case Drag::look:
      look(state.camera, -2 * x, -2 * y);
      break;
  }
}

void Input::take_wheel(const SDL_MouseWheelEvent& wheel, Rect picture, WindowState& state) {
  const auto steps = static_cast<double>(wheel.preciseY);
  if (!state.shows(Panel::vram)) return zoom(state.camera, steps);
  zoom_vram(state.vram, steps, (wheel.mouseX - picture.x) / std::max<double>(picture.width, 1),
            (wheel.mouseY - picture.y) / std::max<double>(picture.height, 1));
}

Motion Input::controller_motion() const {
  Motion sum;
  for (const auto& owned : controllers_) {
    auto* controller = owned.get();
    if (controller == nullptr) continue;
    sum.orbit_x += axis(controller, SDL_CONTROLLER_AXIS_LEFTX);
    sum.orbit_y -= axis(controller, SDL_CONTROLLER_AXIS_LEFTY);
    sum.look_x += axis(controller, SDL_CONTROLLER_AXIS_RIGHTX);
    sum.look_y -= axis(controller, SDL_CONTROLLER_AXIS_RIGHTY);
    sum.fly.z += static_cast<float>(axis(controller, SDL_CONTROLLER_AXIS_TRIGGERLEFT) -
                                    axis(controller, SDL_CONTROLLER_AXIS_TRIGGERRIGHT));
  }
  return sum;
}

bool Input::is_moving() const { return held_.any() || controller_motion().any(); }

void Input::move_camera(double now, double passed, const Subject* machine, WindowState& state) const {
  if (state.recorded.wants_pad) return;  // the sticks are the program's
  const double turn = radians_per_second * passed;
  for (const Motion& motion : {held_.motion(now), controller_motion()}) {
    if (!motion.any()) continue;
    orbit(state.camera, motion.orbit_x * turn, -motion.orbit_y * turn);
    look(state.camera, -motion.look_x * turn, motion.look_y * turn);
    if (machine != nullptr) {
      machine->fly(state.camera, motion.fly * static_cast<float>(distances_per_second * passed));
    }
  }
}

}  // namespace app
