#include "sdk/settings.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "app/commands/arguments.h"
#include "app/commands/without_depth.h"
#include "app/source.h"

namespace sdk {
namespace {

constexpr std::uint32_t usual_frames = 60;

void add_files(CLI::App& line, Settings& s) {
  const auto file = [&line](const char* name, std::string& where, const char* help) {
    line.add_option(name, where, help)->type_name("FILE");
  };
  file("-o,--output", s.output, "write the picture of the last frame as a PNG");
  file("--vram", s.vram, "write all of VRAM: FILE.png, or 1 MiB of little-endian halfwords");
  file("--record", s.record,
       "write everything sent to the GPU as a dump; packed if its name ends in .zst or .xz");
  file("--ram", s.ram, "write memory as the last list found it, for otter walk");
  file("--json", s.json, "write the report as JSON; - is standard output");
  file("--pad-log", s.pad_log, "write what the controllers did, for --pad");
}

void add_window(app::Arguments arguments, Settings::Window& window) {
  arguments.number("--scale", "1..16", window.scale, 1, 16,
                   "window: screen pixels for each pixel at first [3]");
  arguments.number("--frame", "N", window.frame, std::uint32_t{1}, std::uint32_t{1'000'000'000},
                   "window: begin with frame N [1]");
  arguments.flag("--paused", window.is_paused, "window: begin at rest");
  arguments.flag("--split", window.is_split, "window: begin with ordering table and z-buffer side by side");
  arguments.words("--panel", "NAME,...", window.panels,
                  "window: begin with these panels: knobs, inspect, cost, table, vram");
  arguments.text("--settings", "PATH|none", window.settings,
                 "window: what is remembered between runs [~/.config/otter/window.json]");
  arguments.number("--quit-after", "N", window.quit_after, 1, 1'000'000'000,
                   "window: quit when it was drawn N times");
  arguments.text("--screenshot", "FILE", window.screenshot,
                 "with --quit-after: write the window as it was last");
}

}  // namespace

bool Settings::needs_depth() const {
  const scene::Knobs usual;
  return annotate || served || !json.empty() || knobs.visibility == scene::Visibility::zbuffer ||
         knobs.position != usual.position || knobs.texture != usual.texture;
}

base::Result<Settings> parse_settings(int argc, const char* const* argv) {
  Settings s;
  const auto name = std::filesystem::path(argv[0]).filename().string();
  CLI::App line("A program of the console's SDK, drawn by Otter.", name);
  line.set_help_flag("-h,--help", "print this help");
  line.footer("Examples:\n  ./" + name + "\n  ./" + name +
              " --frames 120 -o frame.png --pad 30:UP+X,60:\n  ./" + name +
              " --frames 60 -o frame.png --visibility zbuffer --resolution 4\n");
  line.get_formatter()->column_width(34);
  line.add_option("--frames", s.frames,
                  "no window; end at the Nth vertical blank, from 1 [60 where a file is written]")
      ->type_name("N")
      ->check(CLI::Range(std::uint32_t{1}, std::uint32_t{1'000'000'000}).description(""));
  add_files(line, s);
  line.add_flag("--annotate", s.annotate,
                "the recording carries depths, so that it replays through the z-buffer, too");
  line.add_flag("--reversed", s.reversed,
                "send every list near to far: through a z-buffer the picture stays");
  std::array<std::string, 2> pads;
  line.add_option("--pad", pads[0], "what the first controller holds from a frame on, as 30:UP+X,60:")
      ->type_name("SCRIPT");
  line.add_option("--pad2", pads[1], "the same of the second controller, which is there only with it")
      ->type_name("SCRIPT");
  std::string shown;
  line.add_option("--shown", shown,
                  "the display area, or the buffer drawn into last [a window: drawn, a picture: display]")
      ->type_name("drawn|display")
      ->check(CLI::IsMember({"drawn", "display"}).description(""));
  add_window(app::Arguments(line), s.window);
  line.add_option("--serve", s.served, "")->group("");
  app::Arguments(line).knobs(s.knobs, app::recording_knobs, &s.window.named_knobs);
  try {
    line.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    std::exit(line.exit(help));
  } catch (const CLI::ParseError& error) {
    return base::fail(app::one_line(error) + " (see ./" + name + " --help)");
  }
  s.shown = app::shown_named(shown);
  for (std::size_t i = 0; i < pads.size(); ++i) {
    if (pads[i].empty()) continue;
    auto script = parse_pad_script(pads[i]);
    if (!script) return tl::make_unexpected(script.error());
    s.pads[i] = std::move(*script);
  }
  const auto& named = s.window.named_knobs;
  if (std::find(named.begin(), named.end(), "without-depth") == named.end())
    s.knobs.without_depth = app::foreign_without_depth;
  const auto visibility = s.knobs.visibility;
  if (visibility != scene::Visibility::ot && visibility != scene::Visibility::zbuffer) {
    return base::fail(
        "--visibility: a program's lists can be drawn by ot, in their own order, or by zbuffer");
  }
  if (auto checked = scene::check_knobs(s.knobs); !checked) return tl::make_unexpected(checked.error());
  const bool writes = !(s.output + s.vram + s.record + s.ram + s.json).empty();
  if (!s.frames && writes) s.frames = usual_frames;
  return s;
}

}  // namespace sdk
