#include "app/window/pad_keys.h"

#include <algorithm>
#include <string>

namespace app {
namespace {

struct ControllerButton {
  SDL_GameControllerButton button;
  std::uint16_t bit;
};
constexpr std::array controller_buttons{
    ControllerButton{SDL_CONTROLLER_BUTTON_BACK, 1 << 0},
    ControllerButton{SDL_CONTROLLER_BUTTON_LEFTSTICK, 1 << 1},
    ControllerButton{SDL_CONTROLLER_BUTTON_RIGHTSTICK, 1 << 2},
    ControllerButton{SDL_CONTROLLER_BUTTON_START, 1 << 3},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_UP, 1 << 4},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_RIGHT, 1 << 5},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_DOWN, 1 << 6},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_LEFT, 1 << 7},
    ControllerButton{SDL_CONTROLLER_BUTTON_LEFTSHOULDER, 1 << 10},
    ControllerButton{SDL_CONTROLLER_BUTTON_RIGHTSHOULDER, 1 << 11},
    ControllerButton{SDL_CONTROLLER_BUTTON_Y, 1 << 12},
    ControllerButton{SDL_CONTROLLER_BUTTON_B, 1 << 13},
    ControllerButton{SDL_CONTROLLER_BUTTON_A, 1 << 14},
    ControllerButton{SDL_CONTROLLER_BUTTON_X, static_cast<std::uint16_t>(1 << 15)},
};
constexpr std::array stick_axes{SDL_CONTROLLER_AXIS_RIGHTX, SDL_CONTROLLER_AXIS_RIGHTY,
                                SDL_CONTROLLER_AXIS_LEFTX, SDL_CONTROLLER_AXIS_LEFTY};
constexpr std::uint16_t l2 = 1 << 8, r2 = 1 << 9;

// Opened by app::Input.
SDL_GameController* first_controller() {
  for (int i = 0; i < SDL_NumJoysticks(); ++i) {
    if (SDL_IsGameController(i) == SDL_FALSE) continue;
    if (auto* found = SDL_GameControllerFromInstanceID(SDL_JoystickGetDeviceInstanceID(i))) return found;
  }
  return nullptr;
}

void add_controller(PadHeld& pad) {
  auto* controller = first_controller();
  if (controller == nullptr) return;
  for (const auto& [button, bit] : controller_buttons) {
    if (SDL_GameControllerGetButton(controller, button) != 0) pad.buttons |= bit;
  }
  constexpr int half = 16384;
  if (SDL_GameControllerGetAxis(controller, SDL_CONTROLLER_AXIS_TRIGGERLEFT) > half) pad.buttons |= l2;
  if (SDL_GameControllerGetAxis(controller, SDL_CONTROLLER_AXIS_TRIGGERRIGHT) > half) pad.buttons |= r2;
  pad.is_analog = true;
  for (std::size_t i = 0; i < stick_axes.size(); ++i) {
    const int value = SDL_GameControllerGetAxis(controller, stick_axes[i]);
    pad.sticks[i] = static_cast<std::uint8_t>((value + 32768) >> 8);
  }
}

}  // namespace

bool is_pad_key(std::string_view key) {
  return std::ranges::any_of(pad_keys, [key](const PadKey& row) { return row.key == key; });
}

PadHeld held_pad(bool is_typing) {
  PadHeld pad;
  int count = 0;
  const Uint8* keys = SDL_GetKeyboardState(&count);
  for (const auto& row : pad_keys) {
    const auto code = SDL_GetScancodeFromKey(SDL_GetKeyFromName(std::string(row.key).c_str()));
    if (!is_typing && code < count && keys[code] != 0) pad.buttons |= row.button;
  }
  add_controller(pad);
  return pad;
}

}  // namespace app
