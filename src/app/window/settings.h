#pragma once
// What the window remembers from one run to the next.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/window/dock.h"
#include "app/window/window_state.h"
#include "base/result.h"
#include "scene/knobs.h"

namespace app {

struct Settings {
  scene::Knobs knobs;
  Dock dock;
  double text_size = 1;
  Pace pace = Pace::vsync;
  bool operator==(const Settings&) const = default;
};

/// $XDG_CONFIG_HOME/otter/window.json, or ~/.config/otter/window.json; nothing without a home.
std::optional<std::filesystem::path> default_settings_file();

/// As JSON: {"schema":"otter.window/1","knobs":{...},"panels":{...},"text":1,"pace":"vsync"}.
std::string to_text(const Settings& settings);

struct ReadSettings {
  Settings settings;
  std::vector<std::string> ignored;  ///< clauses about what the text says and this program does not know
};
/// Error: no JSON, or of another schema. What is missing is as at first.
base::Result<ReadSettings> parse_settings(const std::string& text);

/// Of no file the settings are those at first. Whatever is wrong is one line on stderr, and the window opens.
Settings read_settings(const std::filesystem::path& file);
/// Makes the folder too. A line on stderr if it cannot be written.
void write_settings(const std::filesystem::path& file, const Settings& settings);

/// What --settings means: a file, "none", or nothing said: then the usual file, but of a run that is
/// `counted`, which is to give the same picture every time, none.
std::optional<std::filesystem::path> settings_file(const std::string& asked, bool is_counted);

/// The window as it was left, then what is asked for. Remembered knobs that do not go with those asked for
/// are left out.
void begin_with(const Settings& remembered, const scene::Knobs& asked, const std::vector<std::string>& named,
                WindowState& first);

/// Knobs that were named on the command line count more than remembered ones.
void overrule(scene::Knobs& remembered, const scene::Knobs& asked, const std::vector<std::string>& named);

}  // namespace app
