// The page: headline plot, one section per axis, pictures, and where everything was measured.

#include <algorithm>

#include "cost/report.h"
#include "cost/text.h"

namespace cost {
namespace {

constexpr std::string_view style = R"(
:root{--ink:#1d2330;--soft:#5c6675;--line:#dfe3ea;--panel:#f6f7fa;--up:#2f6fb3;--down:#c2541b;--front:#1f8a4c}
*{box-sizing:border-box}
body{font:15px/1.55 system-ui,-apple-system,"Segoe UI",sans-serif;color:var(--ink);background:#fff;max-width:1180px;margin:0 auto;padding:32px 24px 80px}
h1{font-size:30px;line-height:1.2;margin:0 0 4px}h2{font-size:23px;margin:52px 0 6px;border-top:2px solid var(--ink);padding-top:14px}
h3{font-size:18px;margin:34px 0 4px}p{margin:6px 0;max-width:78ch}.meta{color:var(--soft)}
.found{font-size:16px;border-left:4px solid var(--front);background:var(--panel);padding:10px 14px;margin:10px 0;max-width:none}
.pair{display:grid;grid-template-columns:minmax(0,560px) minmax(0,1fr);gap:22px;align-items:start}
svg{max-width:100%;height:auto}
table{border-collapse:collapse;font-size:13px;font-variant-numeric:tabular-nums;width:100%}
th,td{text-align:right;padding:3px 8px;border-bottom:1px solid var(--line);white-space:nowrap}
th:first-child,td:first-child{text-align:left}th{color:var(--soft);font-weight:600}
tr.console td{background:#eef3fb}tr.best td{background:#eaf6ee}caption{text-align:left;font-weight:600;padding:8px 0 4px}
.wide{overflow-x:auto}.pictures{display:flex;flex-wrap:wrap;gap:12px;margin:12px 0}
figure{margin:0;width:200px;font-size:12px}figure img{width:200px;display:block;image-rendering:pixelated;border:1px solid var(--line)}
figure img+img{margin-top:2px}figcaption{padding-top:3px;line-height:1.35}figcaption b{font-size:13px}
code{background:var(--panel);padding:1px 5px;border-radius:3px}
@media(max-width:800px){.pair{grid-template-columns:1fr}}
)";

std::string plot_head(const std::string& y_label) {
  return "set terminal svg size 560,380 dynamic noenhanced font 'sans-serif,12' background '#ffffff'\n"
         "set border 3 lc rgb '#5c6675'\nset tics nomirror\nset grid lc rgb '#dfe3ea' lw 1\nset key outside "
         "top center horizontal\n"
         "set logscale x\nset yrange [0:*]\nset xlabel 'frame time, ms (log)'\nset ylabel '" +
         y_label + "'\nset offsets graph 0.08, graph 0.16, graph 0.08, graph 0.04\n";
}

std::string quoted(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c != '"' && c != '\\') result += c;
  }
  return "\"" + result + "\"";
}

std::string points(const SceneResult& scene, const Axis& axis, Direction direction) {
  std::string data;
  for (const auto& row : scene.rows) {
    if (row.axis != &axis || row.direction != direction) continue;
    data +=
        number(row.ms) + " " + std::to_string(row.errors.of(axis.measure)) + " " + quoted(row.setting) + "\n";
  }
  return data;
}

std::string axis_plot(const SceneResult& scene, const Axis& axis) {
  std::string script = plot_head(info(axis.measure).name());
  script += "$up << EOD\n" + points(scene, axis, Direction::up) + "EOD\n";
  script += "$down << EOD\n" + points(scene, axis, Direction::down) + "EOD\n";
  script +=
      "plot $up using 1:2 with linespoints pt 7 ps 0.8 lw 1.5 lc rgb '#2f6fb3' title 'up from the console', "
      "$up using 1:2:3 with labels offset 0.6,0.6 left font ',10' tc rgb '#2f6fb3' notitle, "
      "$down using 1:2 with linespoints pt 5 ps 0.7 lw 1.5 lc rgb '#c2541b' title 'down from the most "
      "accurate', "
      "$down using 1:2:3 with labels offset 0.6,-0.6 left font ',10' tc rgb '#c2541b' notitle\n";
  return plotted(script);
}

/// Every combination, and the front of those that nothing beats in both.
std::string front_plot(const SceneResult& scene) {
  std::vector<const Row*> front;
  std::string all;
  for (const auto& row : scene.rows) {
    if (row.direction != Direction::cross) continue;
    all += number(row.ms) + " " + number(row.errors.colour_rms) + "\n";
    if (row.on_front) front.push_back(&row);
  }
  if (front.empty()) return {};
  std::ranges::sort(front, {}, &Row::ms);
  std::string line;
  int n = 0;
  for (const Row* row : front) {
    line += number(row->ms) + " " + number(row->errors.colour_rms) + " \"" + std::to_string(++n) + "\"\n";
  }
  std::string script = plot_head("difference from the 64-sample reference, rms of 255");
  script += "set terminal svg size 900,460 dynamic noenhanced font 'sans-serif,13' background '#ffffff'\n";
  script += "$all << EOD\n" + all + "EOD\n$front << EOD\n" + line + "EOD\n";
  script +=
      "plot $all using 1:2 with points pt 7 ps 0.7 lc rgb '#9aa4b2' title 'combinations', "
      "$front using 1:2 with linespoints pt 7 ps 1.1 lw 2 lc rgb '#1f8a4c' title 'Pareto front', "
      "$front using 1:2:3 with labels offset 0.8,0.8 font ',13' tc rgb '#1f8a4c' notitle\n";
  return plotted(script);
}

std::string table_of(const SceneResult& scene, const Axis& axis, Direction direction) {
  const auto mine = [&](const Row& row) { return row.axis == &axis && row.direction == direction; };
  double console_ms = 0;
  double best = 1e300;
  for (const auto& row : scene.rows) {
    if (!mine(row)) continue;
    if (row.is_console) console_ms = row.ms;
    best = std::min(best, row.errors.of(axis.measure));
  }
  std::string html = "<div class=wide><table><caption>";
  html += direction == Direction::up ? "Up from the console" : "Down from the most accurate";
  html +=
      "</"
      "caption><tr><th>setting<th>ms<th>spread<th>ratio<th>GTE<th>OT<th>walk<th>raster<th>filter<th>memory<"
      "th>" +
      escaped(info(axis.measure).name()) + "<th>PSNR<th>SSIM</tr>\n";
  for (const auto& row : scene.rows) {
    if (!mine(row)) continue;
    const bool is_best = row.errors.of(axis.measure) <= best * 1.05;
    html += std::string("<tr class=") +
            (row.is_console ? "console"
             : is_best      ? "best"
                            : "other") +
            "><td>" + escaped(row.setting) + (row.is_console ? " (console)" : "");
    html += "<td>" + number(row.ms) + "<td>" + number(row.spread) + "<td>" +
            (console_ms > 0 ? "x" + number(row.ms / console_ms) : "-");
    for (const double stage :
         {row.stages.gte, row.stages.ot, row.stages.walk, row.stages.raster, row.stages.filter}) {
      html += "<td>" + number(stage);
    }
    html += "<td>" + bytes(row.bytes) + "<td>" + number(row.errors.of(axis.measure)) + "<td>" +
            number(row.errors.psnr) + "<td>" + number(row.errors.ssim) + "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string picture(const display::Picture& p, std::string_view what) {
  return "<img alt=\"" + escaped(what) + "\" src=\"data:image/png;base64," + png_base64(p) + "\">";
}

std::string gallery(const SceneResult& scene, const Axis& axis, Direction direction) {
  std::string html = "<div class=pictures>\n";
  for (const auto& row : scene.rows) {
    if (row.axis != &axis || row.direction != direction) continue;
    html += "<figure>" + picture(row.picture, row.setting) + picture(row.difference, "difference, times 4") +
            "<figcaption><b>" + escaped(row.setting) + "</b> " + number(row.ms) + " ms, " +
            number(row.errors.of(axis.measure)) + "</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

/// Wrong-surface pixels of each setting, cause by cause.
std::string causes_table(const SceneResult& scene, const Axis& axis) {
  std::string html =
      "<div class=wide><table><caption>Wrong-surface pixels by cause</caption><tr><th>setting<th>all";
  for (const auto name : inspect::cause_names) html += "<th>" + std::string(name);
  html += "</tr>\n";
  for (const auto& row : scene.rows) {
    if (row.axis != &axis || row.direction != Direction::down) continue;
    html += "<tr><td>" + escaped(row.setting) + "<td>" + std::to_string(row.errors.wrong_pixels);
    for (const auto count : row.errors.causes) html += "<td>" + std::to_string(count);
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string front_list(const SceneResult& scene) {
  std::vector<const Row*> front;
  for (const auto& row : scene.rows) {
    if (row.on_front) front.push_back(&row);
  }
  if (front.empty()) return {};
  std::ranges::sort(front, {}, &Row::ms);
  std::string html =
      "<div class=wide><table><caption>Pareto front: no combination measured is both faster and nearer to "
      "the "
      "reference</caption><tr><th>combination<th>no.<th>ms<th>rms<th>PSNR<th>SSIM</tr>\n";
  int n = 0;
  for (const Row* row : front) {
    html += "<tr><td>" + escaped(row->setting) + "<td>" + std::to_string(++n) + "<td>" + number(row->ms) +
            "<td>" + number(row->errors.colour_rms) + "<td>" + number(row->errors.psnr) + "<td>" +
            number(row->errors.ssim) + "</tr>\n";
  }
  html += "</table></div>\n<div class=pictures>\n";
  n = 0;
  for (const Row* row : front) {
    html += "<figure>" + picture(row->picture, row->setting) +
            picture(row->difference, "difference, times 4") + "<figcaption><b>" + std::to_string(++n) +
            "</b> " + escaped(row->setting) + ", " + number(row->ms) + " ms</figcaption></figure>\n";
  }
  return html + "</div>\n";
}

void add_scene(Html& html, const SceneResult& scene) {
  html.page += "<h2>" + escaped(scene.scene) + "</h2>\n<p class=meta>Frame " + std::to_string(scene.frame) +
               ", " + std::to_string(scene.width) + " x " + std::to_string(scene.height) + ", medians of " +
               std::to_string(scene.rounds) + " interleaved rounds" +
               (scene.complete ? "." : "; stopped early: what was measured until then.") + "</p>\n";
  const auto show = [&html](const std::string& svg) {
    html.has_plots = html.has_plots && !svg.empty();
    return svg;
  };
  const bool has_cross =
      std::ranges::any_of(scene.rows, [](const Row& row) { return row.direction == Direction::cross; });
  if (has_cross) html.page += "<h3>All axes together</h3>\n" + show(front_plot(scene)) + front_list(scene);
  html.page += "<h3>Reference</h3><div class=pictures><figure>" + picture(scene.reference, "reference") +
               "<figcaption>z-buffer of 32 bits, float64 transform, 1/256-pixel positions, perspective, "
               "24-bit colour, "
               "fog per pixel, 64 samples</figcaption></figure></div>\n";
  for (const auto& axis : axes()) {
    if (std::ranges::none_of(scene.rows, [&](const Row& row) { return row.axis == &axis; })) continue;
    html.page += "<h3>" + std::string(axis.name) + "</h3>\n<p class=found>" + escaped(sentence(scene, axis)) +
                 "</p>\n<div class=pair><div>" + show(axis_plot(scene, axis)) + "</div><div>" +
                 gallery(scene, axis, Direction::down) + "</div></div>\n" +
                 table_of(scene, axis, Direction::up) + table_of(scene, axis, Direction::down);
    if (axis.measure == Measure::wrong_surface) html.page += causes_table(scene, axis);
  }
  if (!scene.skipped.empty()) {
    html.page += "<h3>Not drawn</h3><ul>\n";
    for (const auto& line : scene.skipped) html.page += "<li>" + escaped(line) + "</li>\n";
    html.page += "</ul>\n";
  }
}

}  // namespace

Html to_html(const Report& report) {
  Html html;
  html.page =
      "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n<meta name=viewport "
      "content=\"width=device-width,initial-scale=1\">\n<title>What accuracy costs</title>\n<style>" +
      std::string(style) + "</style></head><body>\n<h1>What accuracy costs</h1>\n<p class=meta>" +
      escaped(report.machine) + "; vector code for " + escaped(report.target) + "; <code>" +
      escaped(report.command) + "</code></p>\n" +
      "<p>Every approximation of the console is a knob. Each is measured twice: raised by itself from the "
      "console's settings, and lowered by itself from the most accurate ones, where nothing else hides its "
      "error. Pictures show the second; under each is its difference from the reference, times 4.</p>\n";
  for (const auto& scene : report.scenes) add_scene(html, scene);
  if (!html.has_plots) html.page += "<p class=meta>The plots need gnuplot, which could not be run.</p>\n";
  html.page += "</body></html>\n";
  return html;
}

}  // namespace cost
