#include "door/x11_keys.h"

#include <X11/Xlib.h>
#include <dlfcn.h>

namespace door {

namespace {

/// Xlib's functions by name.
template <class Function>
Function* xlib(const char* name) {
  static void* const library = dlopen("libX11.so.6", RTLD_NOW);
  return library != nullptr ? reinterpret_cast<Function*>(dlsym(library, name)) : nullptr;
}

Display* key_display() {
  static Display* const display = [] {
    auto* const open = xlib<decltype(XOpenDisplay)>("XOpenDisplay");
    return open != nullptr ? open(nullptr) : nullptr;
  }();
  return display;
}

}  // namespace

unsigned long open_key_display() { return reinterpret_cast<unsigned long>(key_display()); }

void put_key(Key key) {
  Display* const display = key_display();
  auto* const keycode = xlib<decltype(XKeysymToKeycode)>("XKeysymToKeycode");
  auto* const put_back = xlib<decltype(XPutBackEvent)>("XPutBackEvent");
  if (display == nullptr || keycode == nullptr || put_back == nullptr) return;
  XEvent event{};
  event.xkey.type = key.is_down ? KeyPress : KeyRelease;
  event.xkey.display = display;
  event.xkey.keycode = keycode(display, key.keysym);
  event.xkey.same_screen = True;
  if (event.xkey.keycode != 0) put_back(display, &event);
}

}  // namespace door
