// JSON, CSV and the table on the terminal.

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "cost/finding.h"
#include "cost/report.h"
#include "cost/text.h"

namespace cost {
namespace {

using Json = nlohmann::ordered_json;

Json distance(const Distance& d) { return {{"mean", d.mean}, {"p95", d.p95}, {"max", d.greatest}}; }

Json errors(const Errors& e) {
  Json causes = Json::object();
  for (std::size_t i = 0; i < inspect::cause_count; ++i)
    causes[std::string(inspect::cause_names[i])] = e.causes[i];
  return {{"pixels_drawn", e.pixels_drawn},
          {"wrong_pixels", e.wrong_pixels},
          {"causes", causes},
          {"geometric_px", distance(e.geometric_px)},
          {"texel", distance(e.texel)},
          {"colour_rms", e.colour_rms},
          {"block_rms", e.block_rms},
          {"psnr", e.psnr},
          {"ssim", e.ssim},
          {"edge_rms", e.edge_rms}};
}

Json setting(const SceneResult& scene, const Row& row) {
  Json knobs = Json::object();
  for (const auto& knob : scene::knob_table()) knobs[std::string(knob.name)] = knob.get(row.knobs);
  return {{"scene", scene.scene},
          {"axis", row.axis_name()},
          {"direction", direction_names[static_cast<std::size_t>(row.direction)]},
          {"setting", row.setting},
          {"ms", row.ms},
          {"cpu_ms", row.cpu_ms},
          {"spread_ms", row.spread},
          {"ratio", row.ratio},
          {"stages",
           {{"gte", row.stages.gte},
            {"ot", row.stages.ot},
            {"walk", row.stages.walk},
            {"raster", row.stages.raster},
            {"filter", row.stages.filter}}},
          {"bytes", row.touched.total()},
          {"bytes_by",
           {{"list", row.touched.list},
            {"colour", row.touched.colour},
            {"depth", row.touched.depth},
            {"texels", row.touched.texels},
            {"filter", row.touched.filter}}},
          {"held_bytes", row.held_bytes},
          {"errors", errors(row.errors)},
          {"console", row.is_console},
          {"pareto", row.on_front},
          {"knobs", knobs}};
}

std::string padded(std::string text, std::size_t width, bool right = true) {
  if (text.size() >= width) return text;
  const std::string space(width - text.size(), ' ');
  return right ? space + text : text + space;
}

/// One axis in one direction: a line a setting.
void add_rows(std::string& text, const SceneResult& scene, const Axis& axis, Direction direction) {
  const Row* console = nullptr;
  for (const auto& row : scene.rows) {
    if (row.axis == &axis && row.direction == direction && row.is_console) console = &row;
  }
  for (const auto& row : scene.rows) {
    if (row.axis != &axis || row.direction != direction) continue;
    const double ratio = console != nullptr && console->ratio > 0 ? row.ratio / console->ratio : 0;
    text += "  " + padded(row.setting, 18, false) + padded(number(row.ms), 9) +
            padded(number(row.cpu_ms), 9) + padded(number(row.spread), 9) +
            padded(ratio > 0 ? joined({"x", number(ratio)}) : "-", 9) +
            padded(bytes(row.touched.total()), 10) + padded(number(row.errors.of(axis.measure)), 10) +
            padded(number(row.errors.psnr), 8) + padded(number(row.errors.ssim), 9) +
            (row.is_console ? "  console" : "") + "\n";
  }
}

}  // namespace

std::string machine_name() {
  std::string name = "unknown processor";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    name = line.substr(line.find(':') + 2);
    break;
  }
  return name + ", " + std::to_string(std::max(1U, std::thread::hardware_concurrency())) + " cores";
}

std::string compiler_name() {
#ifdef __clang__
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

std::string to_json(const Report& report) {
  Json settings = Json::array();
  Json scenes = Json::array();
  for (const auto& scene : report.scenes) {
    Json sentences = Json::object();
    for (const auto& axis : axes()) {
      if (auto s = sentence(scene, axis); !s.empty()) sentences[std::string(axis.name)] = s;
    }
    scenes.push_back({{"scene", scene.scene},
                      {"frame", scene.frame},
                      {"rounds", scene.rounds},
                      {"complete", scene.complete},
                      {"noise", scene.noise},
                      {"skipped", scene.skipped},
                      {"sentences", sentences}});
    for (const auto& row : scene.rows) settings.push_back(setting(scene, row));
  }
  Json json{{"schema", "otter.cost/1"}, {"scene", ""}, {"frame", 0}, {"width", 0}, {"height", 0}};
  if (!report.scenes.empty()) {
    json["scene"] = report.scenes[0].scene;
    json["frame"] = report.scenes[0].frame;
    json["width"] = report.scenes[0].width;
    json["height"] = report.scenes[0].height;
  }
  json["machine"] = report.machine;
  json["target"] = report.target;
  json["compiler"] = report.compiler;
  json["command"] = report.command;
  json["scenes"] = scenes;
  json["settings"] = settings;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_csv(const Report& report) {
  std::string csv =
      "scene,axis,direction,setting,ms,spread_ms,gte_ms,ot_ms,walk_ms,raster_ms,filter_ms,bytes,held_bytes,"
      "pixels_drawn,"
      "wrong_pixels,geometric_mean_px,geometric_p95_px,geometric_max_px,texel_mean,texel_p95,texel_max,"
      "colour_rms,"
      "block_rms,psnr,ssim,edge_rms,console,pareto,cpu_ms,ratio\r\n";
  const auto quoted = [](std::string_view text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
  };
  for (const auto& scene : report.scenes) {
    for (const auto& row : scene.rows) {
      const Errors& e = row.errors;
      csv += joined({quoted(scene.scene), ",", row.axis_name(), ",",
                     direction_names[static_cast<std::size_t>(row.direction)], ",", quoted(row.setting)});
      for (const double v : {row.ms, row.spread, row.stages.gte, row.stages.ot, row.stages.walk,
                             row.stages.raster, row.stages.filter}) {
        csv += joined({",", number(v)});
      }
      csv += joined({",", std::to_string(row.touched.total()), ",", std::to_string(row.held_bytes), ",",
                     std::to_string(e.pixels_drawn), ",", std::to_string(e.wrong_pixels)});
      for (const double v :
           {e.geometric_px.mean, e.geometric_px.p95, e.geometric_px.greatest, e.texel.mean, e.texel.p95,
            e.texel.greatest, e.colour_rms, e.block_rms, e.psnr, e.ssim, e.edge_rms}) {
        csv += joined({",", number(v)});
      }
      csv += row.is_console ? ",1" : ",0";
      csv += row.on_front ? ",1" : ",0";
      csv += joined({",", number(row.cpu_ms), ",", number(row.ratio), "\r\n"});
    }
  }
  return csv;
}

std::string to_text(const Report& report) {
  std::string text = "What accuracy costs on " + report.machine + " (" + report.target + ")\n";
  for (const auto& scene : report.scenes) {
    text += "\n" + scene.scene + ", frame " + std::to_string(scene.frame) + ", " +
            std::to_string(scene.width) + "x" + std::to_string(scene.height) + ", medians of " +
            std::to_string(scene.rounds) + " rounds" + (scene.complete ? "" : " (stopped early)") + "\n";
    for (const auto& axis : axes()) {
      if (std::ranges::none_of(scene.rows, [&](const Row& row) { return row.axis == &axis; })) continue;
      for (const auto direction : {Direction::up, Direction::down}) {
        if (std::ranges::none_of(scene.rows, [&](const Row& row) {
              return row.axis == &axis && row.direction == direction && !row.setting.empty();
            }))
          continue;
        text += "\n " + std::string(axis.name) +
                (direction == Direction::up ? ", up from the console" : ", down from the most accurate") +
                "\n  " + padded("setting", 18, false) + padded("ms", 9) + padded("cpu", 9) +
                padded("spread", 9) + padded("ratio", 9) + padded("touched", 10) + padded("error", 10) +
                padded("PSNR", 8) + padded("SSIM", 9) + "   error: " + info(axis.measure).name() + "\n";
        add_rows(text, scene, axis, direction);
      }
      if (const auto told = sentence(scene, axis); !told.empty()) text += "  " + told + "\n";
    }
    const auto front = front_of(scene.rows);
    if (!front.empty()) {
      text += joined({"\n Pareto front: of the ", std::to_string(scene.rows.size()),
                      " rows measured none is both faster and nearer to the reference picture\n"});
    }
    for (const Row* row : front) {
      text += "  " + padded(number(row->ms), 9) + " ms" + padded(number(row->errors.psnr), 8) + " dB   " +
              row->label() + "\n";
    }
    if (scene.noise > SceneResult::busy) {
      text +=
          joined({" warning: the machine was busy: the console's frame spread by ", number(100 * scene.noise),
                  " % (10 % is quiet); cpu and ratios are less touched by it\n"});
    }
    for (const auto& line : scene.skipped) text += " skipped: " + line + "\n";
  }
  return text;
}

}  // namespace cost
