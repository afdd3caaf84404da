#pragma once
// The window of `otter run`.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/subject.h"
#include "app/window/window_state.h"
#include "base/result.h"

namespace app {

/// A scene or a recording that the window can show.
struct WindowScene {
  std::string name;  ///< as on the command line
  std::function<base::Result<std::unique_ptr<Subject>>(const scene::Knobs&)> make;
  bool is_recording = false;
};

struct WindowOptions {
  std::vector<WindowScene> scenes;  ///< at least one
  WindowState first;                ///< what is shown at first
  int scale = 3;                    ///< screen pixels a picture pixel, until the user resizes the window
  std::optional<int> frames;        ///< quit after so many
  std::string screenshot;           ///< write the last frame of the window there; empty: do not
  /// Opens a file that is dropped on the window.
  std::function<base::Result<WindowScene>(const std::string&)> open{};
  std::optional<std::filesystem::path> settings;  ///< what is to be remembered goes there
};

/// Opens the window and returns when it is closed. Error: no display, or the first
/// scene cannot be read (exit 2).
base::Result<int> run_window(const WindowOptions& options);

}  // namespace app
