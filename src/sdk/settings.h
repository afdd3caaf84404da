#pragma once
// What the command line of a program that runs here asks for.

#include <cstdint>
#include <optional>
#include <string>

#include "scene/knobs.h"
#include "sdk/pads.h"

namespace sdk {

enum class Shown : std::uint8_t {
  display,  ///< what the display area shows: of a double-buffered program, the frame before
  drawn,    ///< the buffer that was being drawn
};

struct Settings {
  std::optional<std::uint32_t>
      frames;  ///< ends at the N-th vertical blank; nothing: a window, until it is closed
  std::string output, vram, record, ram, json, pad_log;  ///< files to write; empty: none
  bool annotate = false;                                 ///< the recording carries depths
  bool reversed = false;                                 ///< lists are sent near to far
  Shown shown = Shown::display;
  std::array<PadScript, 2> pads;
  scene::Knobs knobs;

  [[nodiscard]] bool is_headless() const { return frames.has_value(); }
  /// Whether anything needs the depth of vertices.
  [[nodiscard]] bool needs_depth() const;
};

/// Error: one line that names the option. With --help, prints it and ends the process with 0.
base::Result<Settings> parse_settings(int argc, const char* const* argv);

}  // namespace sdk
