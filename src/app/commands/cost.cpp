// otter cost: what every setting of accuracy costs in time, and what error it leaves.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/commands/recorded.h"
#include "app/source.h"
#include "base/message.h"
#include "base/write_file.h"
#include "cost/report.h"
#include "gte/batch.h"

namespace app {
namespace {

struct CostOptions {
  std::vector<std::string> scenes;
  std::vector<std::string> axes;
  bool quick = false;
  int rounds = 9;
  std::optional<std::uint64_t> frame;
  SourceOptions source_options;
  std::string size = "320x240", json, csv, html;
};

base::Result<std::vector<const cost::Axis*>> chosen_axes(const std::vector<std::string>& names) {
  std::vector<const cost::Axis*> list;
  for (const auto& name : names) {
    const auto* axis = cost::find_axis(name);
    if (axis == nullptr) {
      std::string known;
      for (const auto& a : cost::axes()) known.append(known.empty() ? "" : ", ").append(a.name);
      return base::fail("--axes " + name + ": expected some of " + known);
    }
    if (std::ranges::find(list, axis) == list.end()) list.push_back(axis);
  }
  return list;
}

std::string command_line(const CostOptions& o) {
  std::string text = "otter cost";
  for (const auto& scene : o.scenes) text += " " + scene;
  for (std::size_t i = 0; i < o.axes.size(); ++i) text += (i == 0 ? " --axes " : ",") + o.axes[i];
  if (o.quick) text += " --quick";
  if (o.rounds != 9) text += " --rounds " + std::to_string(o.rounds);
  if (o.size != "320x240") text += " --size " + o.size;
  return text;
}

/// To a file, or to stdout where the name is "-".
base::Result<void> write(const std::string& name, const std::string& text) {
  if (name.empty()) return {};
  if (name != "-") return base::write_file(name, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return {};
  return base::fail("standard output: cannot be written", base::Exit::failed);
}

base::Result<void> write_all(const CostOptions& o, const cost::Report& report) {
  const bool stdout_taken = o.json == "-" || o.csv == "-" || o.html == "-";
  if (auto done = write(stdout_taken ? "" : "-", cost::to_text(report)); !done) return done;
  if (!o.json.empty()) {
    if (auto done = write(o.json, cost::to_json(report)); !done) return done;
  }
  if (!o.csv.empty()) {
    if (auto done = write(o.csv, cost::to_csv(report)); !done) return done;
  }
  if (o.html.empty()) return {};
  const auto html = cost::to_html(report);
  auto done = write(o.html, html.page);
  if (done && !html.has_plots) base::warn("otter", "gnuplot cannot be run: " + o.html + " has no plots");
  return done;
}

/// What can be known before minutes are spent: the folder is there, and only one report goes to stdout.
base::Result<void> check_outputs(const CostOptions& o) {
  namespace fs = std::filesystem;
  const std::array names{&o.json, &o.csv, &o.html};
  if (std::ranges::count(names, "-", [](const std::string* name) { return *name; }) > 1) {
    return base::fail("more than one of --json, --csv and --html is -: expected one on standard output");
  }
  for (const std::string* name : names) {
    std::error_code ignored;
    const fs::path path(*name);
    if (name->empty() || *name == "-" || fs::is_other(path, ignored)) continue;
    const auto folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const int error = fs::is_directory(path, ignored)            ? EISDIR
                      : access(folder.c_str(), W_OK | X_OK) != 0 ? errno
                                                                 : 0;
    if (error != 0)
      return base::fail(*name + ": cannot be written: " + std::strerror(error), base::Exit::failed);
  }
  return {};
}

base::Result<cost::SceneResult> sweep_source(Source& source, const CostOptions& o,
                                             const cost::SweepOptions& sweep) {
  if (!source.is_recording()) {
    cost::Subject subject(std::move(*source.scene), static_cast<std::uint32_t>(o.frame.value_or(30)));
    return cost::sweep(subject, sweep);
  }
  const std::uint64_t frame = o.frame.value_or(1);
  const auto timeline = open_at_frame(source, {}, frame);
  if (!timeline) return tl::make_unexpected(timeline.error());
  return cost::sweep(recorded_frame(**timeline, source.name, frame), sweep);
}

base::Result<int> run_cost(CostOptions& o) {
  if (o.scenes.empty()) o.scenes = {"crates", "corridor"};
  cost::SweepOptions sweep;
  auto axes = chosen_axes(o.axes);
  if (!axes) return tl::make_unexpected(axes.error());
  sweep.axes = *axes;
  sweep.quick = o.quick;
  sweep.rounds = o.rounds;
  if (auto set = scene::set_knob(sweep.given, "size", o.size); !set) return tl::make_unexpected(set.error());
  if (auto checked = check_outputs(o); !checked) return tl::make_unexpected(checked.error());
  std::vector<Source> sources;
  for (const auto& name : o.scenes) {
    auto opened = open_source(name, o.source_options);
    if (!opened) return tl::make_unexpected(opened.error());
    sources.push_back(std::move(*opened));
  }
  const Interrupt interrupt;
  sweep.stop = [&] { return interrupt.was_asked(); };
  cost::Report report{.command = command_line(o),
                      .machine = cost::machine_name(),
                      .target = gte::batch_target(),
                      .scenes = {}};
  std::optional<base::Error> failed;  // what was measured before is reported all the same
  for (auto& source : sources) {
    if (interrupt.was_asked()) break;
    std::unique_ptr<Progress> progress;
    sweep.progress = [&, name = source.name](std::size_t done, std::size_t all, double seconds_left) {
      if (!progress) progress = std::make_unique<Progress>("cost " + name, all);
      progress->show(done, seconds_left);
    };
    auto result = sweep_source(source, o, sweep);
    if (!result) {
      failed = result.error();
      break;
    }
    report.scenes.push_back(std::move(*result));
  }
  if (!report.scenes.empty()) {
    if (auto written = write_all(o, report); !written) return tl::make_unexpected(written.error());
  }
  if (failed) return tl::make_unexpected(*failed);
  if (!interrupt.was_asked()) return 0;
  std::size_t settings = 0;
  for (const auto& scene : report.scenes) settings += scene.rows.size();
  return base::fail("interrupted: the report holds " + std::to_string(settings) + " settings of " +
                        std::to_string(report.scenes.size()) + " of " + std::to_string(o.scenes.size()) +
                        " scenes",
                    base::Exit::interrupted);
}

}  // namespace

Action add_cost(Arguments arguments) {
  const auto options = std::make_shared<CostOptions>();
  arguments.positionals("scene", "SCENE|FILE", options->scenes,
                        "scenes, scene files, GPU dumps, or a RAM image with --head [crates corridor]");
  arguments.words("--axes", "A,B", options->axes, "measure these axes alone, and no combinations");
  arguments.flag("--quick", options->quick, "fewer settings: under a minute");
  arguments.number("--rounds", "N", options->rounds, 1, 1000, "how often every setting is timed [9]");
  arguments.number("--frame", "N", options->frame, std::uint64_t{0}, std::uint64_t{1'000'000'000},
                   "of a scene the state after N/60 s [30], of a recording from 1 [1]");
  add_source_options(arguments, options->source_options);
  arguments.text("--size", "WxH", options->size, "display mode [320x240]");
  arguments.text("--json", "FILE", options->json, "write all numbers as JSON; - is standard output");
  arguments.text("--csv", "FILE", options->csv, "write one line a setting");
  arguments.text("--html", "FILE", options->html, "write one page with plots and pictures");
  return [options] { return run_cost(*options); };
}

}  // namespace app
