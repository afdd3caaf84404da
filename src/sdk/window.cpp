#include "sdk/window.h"

#include <array>

#include "sdk/include/psxpad.h"

namespace sdk {
namespace {

struct Key {
  SDL_Scancode key;
  unsigned bit;
};
constexpr std::array keys{
    Key{SDL_SCANCODE_UP, PAD_UP},        Key{SDL_SCANCODE_DOWN, PAD_DOWN},
    Key{SDL_SCANCODE_LEFT, PAD_LEFT},    Key{SDL_SCANCODE_RIGHT, PAD_RIGHT},
    Key{SDL_SCANCODE_W, PAD_TRIANGLE},   Key{SDL_SCANCODE_A, PAD_SQUARE},
    Key{SDL_SCANCODE_S, PAD_CROSS},      Key{SDL_SCANCODE_D, PAD_CIRCLE},
    Key{SDL_SCANCODE_Q, PAD_L1},         Key{SDL_SCANCODE_E, PAD_R1},
    Key{SDL_SCANCODE_1, PAD_L2},         Key{SDL_SCANCODE_3, PAD_R2},
    Key{SDL_SCANCODE_RETURN, PAD_START}, Key{SDL_SCANCODE_BACKSPACE, PAD_SELECT},
};

struct ControllerButton {
  SDL_GameControllerButton button;
  unsigned bit;
};
constexpr std::array controller_buttons{
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_UP, PAD_UP},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_DOWN, PAD_DOWN},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_LEFT, PAD_LEFT},
    ControllerButton{SDL_CONTROLLER_BUTTON_DPAD_RIGHT, PAD_RIGHT},
    ControllerButton{SDL_CONTROLLER_BUTTON_A, PAD_CROSS},
    ControllerButton{SDL_CONTROLLER_BUTTON_B, PAD_CIRCLE},
    ControllerButton{SDL_CONTROLLER_BUTTON_X, PAD_SQUARE},
    ControllerButton{SDL_CONTROLLER_BUTTON_Y, PAD_TRIANGLE},
    ControllerButton{SDL_CONTROLLER_BUTTON_LEFTSHOULDER, PAD_L1},
    ControllerButton{SDL_CONTROLLER_BUTTON_RIGHTSHOULDER, PAD_R1},
    ControllerButton{SDL_CONTROLLER_BUTTON_LEFTSTICK, PAD_L3},
    ControllerButton{SDL_CONTROLLER_BUTTON_RIGHTSTICK, PAD_R3},
    ControllerButton{SDL_CONTROLLER_BUTTON_START, PAD_START},
    ControllerButton{SDL_CONTROLLER_BUTTON_BACK, PAD_SELECT},
};
constexpr std::array stick_axes{SDL_CONTROLLER_AXIS_RIGHTX, SDL_CONTROLLER_AXIS_RIGHTY,
                                SDL_CONTROLLER_AXIS_LEFTX, SDL_CONTROLLER_AXIS_LEFTY};

}  // namespace

base::Result<std::unique_ptr<Window>> Window::open(const std::string& title) {
  std::unique_ptr<Window> w(new Window);
  w->session_ = std::make_unique<app::SdlSession>();
  if (!w->session_->is_open())
    return base::fail("no window: " + w->session_->error() + " (--frames N runs without)");
  w->window_.reset(SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, 960, 720,
                                    SDL_WINDOW_RESIZABLE));
  if (w->window_) w->renderer_.reset(SDL_CreateRenderer(w->window_.get(), -1, SDL_RENDERER_PRESENTVSYNC));
  if (w->window_ && !w->renderer_) w->renderer_.reset(SDL_CreateRenderer(w->window_.get(), -1, 0));
  if (!w->renderer_) return base::fail(std::string("no window: ") + SDL_GetError());
  return w;
}

void Window::set_title(const std::string& title) { SDL_SetWindowTitle(window_.get(), title.c_str()); }

void Window::show(const base::Picture& picture) {
  SDL_SetRenderDrawColor(renderer_.get(), 0, 0, 0, 255);
  SDL_RenderClear(renderer_.get());
  if (picture.width > 0 && picture.height > 0) {
    if (!texture_ || width_ != picture.width || height_ != picture.height) {
      texture_.reset(SDL_CreateTexture(renderer_.get(), SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STREAMING,
                                       picture.width, picture.height));
      width_ = picture.width;
      height_ = picture.height;
    }
    SDL_UpdateTexture(texture_.get(), nullptr, picture.pixels.data(), 4 * picture.width);
    // A television's 4:3, whatever the mode's width.
    int w = 0, h = 0;
    SDL_GetRendererOutputSize(renderer_.get(), &w, &h);
    const int shown_w = std::min(w, h * 4 / 3), shown_h = std::min(h, w * 3 / 4);
    const SDL_Rect to{(w - shown_w) / 2, (h - shown_h) / 2, shown_w, shown_h};
    SDL_RenderCopy(renderer_.get(), texture_.get(), nullptr, &to);
  }
  SDL_RenderPresent(renderer_.get());
}

PadState Window::held() const {
  PadState pad;
  const auto hold = [&pad](unsigned bit) { pad.buttons = static_cast<std::uint16_t>(pad.buttons | bit); };
  const auto* state = SDL_GetKeyboardState(nullptr);
  for (const auto& key : keys) {
    if (state[key.key] != 0) hold(key.bit);
  }
  for (const auto& controller : controllers_) {
    auto* c = controller.get();
    for (const auto& button : controller_buttons) {
      if (SDL_GameControllerGetButton(c, button.button) != 0) hold(button.bit);
    }
    constexpr int half_way = 16384;
    if (SDL_GameControllerGetAxis(c, SDL_CONTROLLER_AXIS_TRIGGERLEFT) > half_way) hold(PAD_L2);
    if (SDL_GameControllerGetAxis(c, SDL_CONTROLLER_AXIS_TRIGGERRIGHT) > half_way) hold(PAD_R2);
    pad.is_analog = true;
    for (std::size_t i = 0; i < stick_axes.size(); ++i) {
      pad.sticks[i] = static_cast<std::uint8_t>((SDL_GameControllerGetAxis(c, stick_axes[i]) + 32768) >> 8);
    }
  }
  return pad;
}

Window::Events Window::poll() {
  Events events;
  SDL_Event event;
  while (SDL_PollEvent(&event) != 0) {
    if (event.type == SDL_QUIT) events.closed = true;
    if (event.type == SDL_CONTROLLERDEVICEADDED) {
      controllers_.emplace_back(SDL_GameControllerOpen(event.cdevice.which));
    }
    if (event.type == SDL_CONTROLLERDEVICEREMOVED) {
      std::erase_if(controllers_,
                    [](const auto& c) { return SDL_GameControllerGetAttached(c.get()) == SDL_FALSE; });
    }
    if (event.type != SDL_KEYDOWN || event.key.repeat != 0) continue;
    switch (event.key.keysym.sym) {
      case SDLK_ESCAPE:
        events.closed = true;
        break;
      case SDLK_SPACE:
        events.pause = true;
        break;
      case SDLK_n:
        events.step = true;
        break;
      case SDLK_b:
        events.back = true;
        break;
      case SDLK_TAB:
        events.zbuffer = true;
        break;
      case SDLK_F8:
        events.record = true;
        break;
      default:
        break;
    }
  }
  events.pad = held();
  return events;
}

}  // namespace sdk
