#pragma once
// What the command line of a program that runs here asks for.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/tape.h"
#include "app/window/window_state.h"
#include "scene/knobs.h"
#include "sdk/pads.h"

namespace sdk {

struct Settings {
  std::optional<std::uint32_t>
      frames;  ///< ends at the N-th vertical blank; nothing: a window, until it is closed
  std::string output, vram, record, ram, json, pad_log;  ///< files to write; empty: none
  bool annotate = false;                                 ///< the recording carries depths
  bool reversed = false;                                 ///< lists are sent near to far
  /// Of a program with two buffers the display shows the frame before. Without a word a picture is of the
  /// display, and a window of what is drawn.
  app::Shown shown = app::Shown::either;
  struct Window {  ///< how it opens
    int scale = 3;
    std::uint32_t frame = 1;
    bool is_paused = false, is_split = false;
    std::vector<std::string> panels, named_knobs;
    std::string settings;    ///< where things are remembered; "none": nowhere; empty: the usual place
    std::string screenshot;  ///< with `quit_after`: the window's last frame
    std::optional<int> quit_after;
  } window;
  std::array<PadScript, 2> pads;
  std::optional<int> served;  ///< this process runs the program for a window, which listens at the socket
  scene::Knobs knobs;

  [[nodiscard]] bool is_headless() const { return frames.has_value() || served.has_value(); }
  /// Whether anything needs the depth of vertices.
  [[nodiscard]] bool needs_depth() const;
};

/// Error: one line that names the option. With --help, prints it and ends the process with 0.
base::Result<Settings> parse_settings(int argc, const char* const* argv);

}  // namespace sdk
