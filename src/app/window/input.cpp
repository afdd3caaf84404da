#include "app/window/input.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "app/viewer.h"

namespace app {
namespace {

constexpr double radians_per_second = 1.5;
constexpr double distances_per_second = 0.8;

bool may_repeat(KeyAction action) {
  return action == KeyAction::next_frame || action == KeyAction::previous_frame;
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
      if (!gui.WantTextInput) take_key(event.key, now, state);
      break;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) held_.release_all();
      break;
    case SDL_MOUSEBUTTONDOWN:
      if (!gui.WantCaptureMouse) take_press(event.button, picture, state);
      break;
    case SDL_MOUSEBUTTONUP:
      drag_ = Drag::none;
      break;
    case SDL_MOUSEMOTION:
      take_drag(event.motion, picture, state);
      break;
    case SDL_MOUSEWHEEL:
      if (!gui.WantCaptureMouse) zoom(state.camera, static_cast<double>(event.wheel.preciseY));
      break;
    case SDL_CONTROLLERDEVICEADDED:
      controllers_.emplace_back(SDL_GameControllerOpen(event.cdevice.which));
      break;
    case SDL_CONTROLLERDEVICEREMOVED:
      std::erase_if(controllers_,
                    [](const auto& c) { return SDL_GameControllerGetAttached(c.get()) == SDL_FALSE; });
      break;
    case SDL_CONTROLLERBUTTONDOWN: {
      const auto button = static_cast<SDL_GameControllerButton>(event.cbutton.button);
      const char* name = SDL_GameControllerGetStringForButton(button);
      if (const auto asked = asked_by_button(name != nullptr ? name : "")) handle(state, *asked);
      break;
    }
    default:
      break;
  }
}

void Input::take_key(const SDL_KeyboardEvent& key, double now, WindowState& state) {
  const std::string name = SDL_GetKeyName(key.keysym.sym);
  if (key.type == SDL_KEYUP) {
    const auto asked = asked_by_key(name);
    if (held_.release(name, now) && asked) handle(state, *asked);
    return;
  }
  constexpr auto others =
      KMOD_CTRL | KMOD_ALT | KMOD_GUI;  // the window manager's, but for the usual full screen
  if ((key.keysym.mod & others) != 0) {
    if ((key.keysym.mod & KMOD_ALT) != 0 && name == "Return" && key.repeat == 0)
      handle(state, {KeyAction::fullscreen});
    return;
  }
  if (held_.press(name, now)) return;
  const auto asked = asked_by_key(name);
  if (asked && (key.repeat == 0 || may_repeat(asked->action))) handle(state, *asked);
}

void Input::take_press(const SDL_MouseButtonEvent& button, Rect picture, const WindowState& state) {
  if (button.button == SDL_BUTTON_RIGHT) drag_ = Drag::look;
  if (button.button != SDL_BUTTON_LEFT) return;
  const int divider = picture.x + static_cast<int>(state.divider * picture.width);
  const bool on_divider = state.split && !state.vram && std::abs(button.x - divider) <= 8;
  drag_ = on_divider ? Drag::divider : Drag::orbit;
}

void Input::take_drag(const SDL_MouseMotionEvent& motion, Rect picture, WindowState& state) {
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
      orbit(state.camera, -4 * x, -4 * y);
      break;
    case Drag::look:
      look(state.camera, -2 * x, -2 * y);
      break;
  }
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

void Input::move_camera(double now, double passed, const Viewer* machine, WindowState& state) const {
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
