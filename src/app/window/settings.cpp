#include "app/window/settings.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/message.h"
#include "base/read_file.h"
#include "base/write_file.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::array side_names{"left", "right"};
constexpr std::size_t largest_file = 1 << 20;

class Reader {
 public:
  explicit Reader(const Json& json) : json_(json) {}

  ReadSettings read() {
    const auto knobs = part("knobs");
    for (auto entry = knobs.begin(); entry != knobs.end(); ++entry) knob(entry.key(), entry.value());
    const auto panels = part("panels");
    sides(panels);
    widths(panels);
    opened(panels);
    text();
    pace();
    return std::move(read_);
  }

 private:
  void ignore(std::string clause) { read_.ignored.push_back(std::move(clause)); }

  Json part(const char* name) {
    const auto found = json_.find(name);
    if (found == json_.end()) return Json::object();
    if (found->is_object()) return *found;
    ignore(std::string(name) + ": expected an object");
    return Json::object();
  }

  void knob(const std::string& name, const Json& value) {
    if (!value.is_string()) return ignore("knob " + name + ": expected a string");
    if (const auto set = scene::set_knob(read_.settings.knobs, name, value.get<std::string>()); !set) {
      ignore("knob " + name + ": " + set.error().text);
    }
  }

  void sides(const Json& panels) {
    for (std::size_t i = 0; i < panel_count; ++i) {
      const auto found = panels.find(std::string(panel_names[i]));
      if (found == panels.end()) continue;
      const auto side = std::find(side_names.begin(), side_names.end(),
                                  found->is_string() ? found->get<std::string>() : "");
      if (side == side_names.end()) {
        ignore("panel " + std::string(panel_names[i]) + ": expected left or right");
      } else {
        read_.settings.dock.side[i] = static_cast<Side>(side - side_names.begin());
      }
    }
  }

  void widths(const Json& panels) {
    const auto found = panels.find("widths");
    if (found == panels.end()) return;
    if (!found->is_array() || found->size() != side_count) return ignore("widths: expected two numbers");
    for (std::size_t i = 0; i < side_count; ++i) {
      const auto& width = (*found)[i];
      const double value = width.is_number() ? width.get<double>() : 0;
      if (!(value >= 50 && value <= 10'000)) {
        ignore("widths: expected two numbers of 50..10000");
        continue;
      }
      read_.settings.dock.width[i] = value;
    }
  }

  void opened(const Json& panels) {
    const auto found = panels.find("open");
    if (found == panels.end()) return;
    if (!found->is_array()) return ignore("open: expected an array of panels");
    for (const auto& name : *found) {
      const auto panel = panel_named(name.is_string() ? name.get<std::string>() : "");
      panel ? read_.settings.dock.raise(*panel) : ignore("open: " + name.dump() + ": no such panel");
    }
  }

  void text() {
    const auto found = json_.find("text");
    if (found == json_.end()) return;
    const double size = found->is_number() ? found->get<double>() : 0;
    if (!(size >= smallest_text && size <= largest_text)) return ignore("text: expected a number of 0.5..4");
    read_.settings.text_size = size;
  }

  void pace() {
    const auto found = json_.find("pace");
    if (found == json_.end()) return;
    const auto word = found->is_string() ? found->get<std::string>() : "";
    const auto name = std::find(pace_words.begin(), pace_words.end(), word);
    if (name == pace_words.end()) return ignore("pace: expected vsync, 60, 50 or slow");
    read_.settings.pace = static_cast<Pace>(name - pace_words.begin());
  }

  const Json& json_;
  ReadSettings read_;
};

}  // namespace

std::optional<fs::path> default_settings_file() {
  const auto set = [](const char* variable) {
    const char* value = std::getenv(variable);
    return std::string(value != nullptr ? value : "");
  };
  if (const auto folder = set("XDG_CONFIG_HOME"); fs::path(folder).is_absolute()) {
    return fs::path(folder) / "otter" / "window.json";
  }
  const auto home = set("HOME");
  if (home.empty()) return std::nullopt;
  return fs::path(home) / ".config" / "otter" / "window.json";
}

std::string to_text(const Settings& settings) {
  Json json{{"schema", "otter.window/1"}};
  auto& knobs = json["knobs"] = Json::object();
  static const scene::Knobs console;
  for (const auto& knob : scene::knob_table()) {
    const auto value = knob.get(settings.knobs);
    if (value != knob.get(console)) knobs[std::string(knob.name)] = value;
  }
  auto& panels = json["panels"] = Json::object();
  for (std::size_t i = 0; i < panel_count; ++i) {
    panels[std::string(panel_names[i])] = side_names[static_cast<std::size_t>(settings.dock.side[i])];
  }
  panels["widths"] = settings.dock.width;
  auto& open = panels["open"] = Json::array();
  for (const auto panel : settings.dock.open) open.push_back(panel_names[static_cast<std::size_t>(panel)]);
  json["text"] = settings.text_size;
  json["pace"] = pace_words[static_cast<std::size_t>(settings.pace)];
  return json.dump(2) + "\n";
}

base::Result<ReadSettings> parse_settings(const std::string& text) {
  const auto json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return base::fail("expected JSON");
  if (!json.is_object() || json.value("schema", Json()) != Json("otter.window/1")) {
    return base::fail("expected \"schema\": \"otter.window/1\"");
  }
  return Reader(json).read();
}

Settings read_settings(const fs::path& file) {
  std::error_code fault;
  if (fs::status(file, fault).type() == fs::file_type::not_found) return {};
  const auto say = [&file](const std::string& what) {
    base::warn("otter run", "--settings " + file.string() + ": " + what);
  };
  const auto text = base::read_regular_file(file, largest_file);
  if (!text) {
    base::warn("otter run", "--settings " + text.error().text);
    return {};
  }
  auto read = parse_settings(*text);
  if (!read) {
    say(read.error().text + "; as at first");
    return {};
  }
  if (!read->ignored.empty()) {
    const auto more = read->ignored.size() - 1;
    say(read->ignored.front() + (more != 0 ? ", and " + std::to_string(more) + " more" : "") + "; ignored");
  }
  return std::move(read->settings);
}

void write_settings(const fs::path& file, const Settings& settings) {
  std::error_code fault;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), fault);
  if (const auto written = base::write_file(file, to_text(settings)); !written) {
    base::warn("otter run", "--settings " + written.error().text);
  }
}

void overrule(scene::Knobs& remembered, const scene::Knobs& asked, const std::vector<std::string>& named) {
  for (const auto& knob : scene::knob_table()) {
    if (std::find(named.begin(), named.end(), knob.name) != named.end()) {
      knob.set(remembered, knob.get(asked));
    }
  }
}

std::optional<std::filesystem::path> settings_file(const std::string& asked, bool is_counted) {
  if (asked == "none") return std::nullopt;
  if (!asked.empty()) return asked;
  return is_counted ? std::nullopt : default_settings_file();
}

void begin_with(const Settings& remembered, const scene::Knobs& asked, const std::vector<std::string>& named,
                WindowState& first) {
  first.knobs = remembered.knobs;
  overrule(first.knobs, asked, named);
  if (!scene::check_knobs(first.knobs)) first.knobs = asked;
  first.dock = remembered.dock;
  first.text_size = remembered.text_size;
  first.pace = remembered.pace;
}

}  // namespace app
