// The page: what was found, the headline plot, one section per axis, pictures, and where it was measured.

#include <algorithm>
#include <array>
#include <cmath>

#include "cost/finding.h"
#include "cost/metrics.h"
#include "cost/report.h"
#include "cost/report_plots.h"
#include "cost/report_style.h"
#include "cost/text.h"

namespace cost {
namespace {

using base::Picture;

std::string image(const Picture& p, std::string_view what) {
  return joined({"<img alt=\"", escaped(what), "\" width=", std::to_string(p.width), " height=",
                 std::to_string(p.height), " src=\"data:image/png;base64,", png_base64(p), "\">"});
}

std::string ms(double value) { return number(value) + " ms"; }

std::string ratio(double value, double console) {
  return console > 0 ? "&times;" + number(value / console) : std::string("-");
}

/// Rows of one sweep, in the order of the axis.
std::vector<const Row*> rows_of(const SceneResult& scene, const Axis* axis, Direction direction) {
  std::vector<const Row*> list;
  for (const auto& row : scene.rows) {
    if (row.axis == axis && row.direction == direction) list.push_back(&row);
  }
  return list;
}

double console_ratio(const std::vector<const Row*>& rows) {
  const auto found = std::ranges::find_if(rows, &Row::is_console);
  return found == rows.end() ? 0 : (*found)->ratio;
}

/// The part of the picture in which the settings of a sweep differ most; where they do not, in which they
/// differ most from the reference.
struct Detail {
  static constexpr int width = 80, height = 60;
  int x = 0, y = 0;
};

Detail detail_of(const std::vector<const Row*>& rows, const Picture& reference) {
  Detail best;
  double most = -1;
  const Picture& first = rows.front()->picture;
  for (int y = 0; y + Detail::height <= first.height; y += 10) {
    for (int x = 0; x + Detail::width <= first.width; x += 10) {
      const auto part = cropped(first, x, y, Detail::width, Detail::height);
      double sum = 1e-3 * rms(cropped(reference, x, y, Detail::width, Detail::height), part);
      for (const Row* row : rows)
        sum += rms(cropped(row->picture, x, y, Detail::width, Detail::height), part);
      if (sum > most) {
        most = sum;
        best = {x, y};
      }
    }
  }
  return best;
}

std::string figure(const Row& row, const Detail& detail, const std::string& caption) {
  const bool has_detail = row.picture.width >= Detail::width && row.picture.height >= Detail::height;
  return "<figure>" + image(row.picture, row.setting) + "<div class=two>" +
         image(row.difference, row.setting + ": distance from the reference") +
         (has_detail ? image(cropped(row.picture, detail.x, detail.y, Detail::width, Detail::height),
                             row.setting + ": detail")
                     : "") +
         "</div><figcaption>" + caption + "</figcaption></figure>\n";
}

/// A figure for every picture: settings that draw the same share one.
std::string gallery(const SceneResult& scene, const std::vector<const Row*>& rows, const Axis& axis) {
  if (rows.empty()) return {};
  const auto detail = detail_of(rows, scene.reference);
  std::vector<const Row*> left = rows;
  std::string html = "<div class=pictures>\n";
  while (!left.empty()) {
    const Row& shown = *left.front();
    std::string caption;
    std::erase_if(left, [&](const Row* row) {
      if (row->picture != shown.picture) return false;
      caption += joined({caption.empty() ? "" : "<br>", "<b>",
                         numbered(axis) ? setting_number(*row) + "&ensp;" : "", escaped(row->setting),
                         "</b> ", ms(row->ms), ", ", number(row->error()), " ", info(axis.measure).unit});
      return true;
    });
    html += figure(shown, detail, caption);
  }
  return html + "</div>\n";
}

/// Both sweeps side by side: what a setting costs the console, and what error it leaves alone.
std::string summary_table(const SceneResult& scene, const Axis& axis) {
  const auto up = rows_of(scene, &axis, Direction::up);
  const auto down = rows_of(scene, &axis, Direction::down);
  const std::string number_head = numbered(axis) ? "<th>no.<th class=name>setting" : "<th class=name>setting";
  const auto half = [&](const std::string& side) {
    return "<th class=\"gap " + side + "\">ms<th>ratio<th>error";
  };
  std::string html =
      joined({"<div class=wide><table><tr class=group><th colspan=", numbered(axis) ? "2" : "1",
              "><th colspan=3 class=\"gap up\">up from the console<th colspan=5 class=\"gap down\">"
              "down from the most accurate</tr><tr>",
              number_head, half("up"), half("down"), "<th>PSNR, dB<th>SSIM</tr>\n"});
  const auto half_row = [&](const Row* row, double console) {
    if (row == nullptr) return std::string("<td class=gap>-<td>-<td>-");
    return joined({"<td class=gap>", number(row->ms), "<td>", ratio(row->ratio, console), "<td",
                   row->is_best ? " class=best" : "", ">", number(row->error())});
  };
  for (std::size_t i = 0; i < axis.settings.size(); ++i) {
    const auto* above = scene.find(axis, Direction::up, axis.settings[i].name);
    const auto* below = scene.find(axis, Direction::down, axis.settings[i].name);
    if (above == nullptr && below == nullptr) continue;
    html += joined({"<tr", i == axis.console ? " class=console" : "", ">",
                    numbered(axis) ? "<td>" + std::to_string(i + 1) : "", "<td class=name>",
                    escaped(axis.settings[i].name), half_row(above, console_ratio(up)),
                    half_row(below, console_ratio(down))});
    html += below != nullptr ? "<td>" + number(below->errors.psnr) + "<td>" + number(below->errors.ssim)
                             : std::string("<td>-<td>-");
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

/// Every stage of every setting.
std::string stage_table(const std::vector<const Row*>& rows, std::string_view caption) {
  std::string html = joined(
      {"<div class=wide><table><caption>", caption,
       "</caption><tr class=group><th><th colspan=3>frame, ms<th colspan=5>of it, ms<th colspan=2>bytes<th "
       "colspan=3>vertices, pixels<th colspan=3>texels<th colspan=4>colour<th>edges</tr><tr><th "
       "class=name>setting<th>median<th>spread<th>ratio<th>GTE<th>OT<th>walk<th>raster<th>filter<th>"
       "touched<th>held<th>mean<th>p95<th>max<th>mean<th>p95<th>max<th>rms<th>4x4<th>PSNR<th>SSIM<th>rms"
       "</tr>\n"});
  const double console = console_ratio(rows);
  for (const Row* row : rows) {
    html +=
        joined({"<tr", row->is_console ? " class=console" : "", "><td class=name>", escaped(row->setting),
                "<td>", number(row->ms), "<td>", number(row->spread), "<td>", ratio(row->ratio, console)});
    const auto& s = row->stages;
    for (const double stage : {s.gte, s.ot, s.walk, s.raster, s.filter}) html += "<td>" + number(stage);
    html += "<td>" + bytes(row->touched.total()) + "<td>" + bytes(row->held_bytes);
    const Errors& e = row->errors;
    for (const double v :
         {e.geometric_px.mean, e.geometric_px.p95, e.geometric_px.greatest, e.texel.mean, e.texel.p95,
          e.texel.greatest, e.colour_rms, e.block_rms, e.psnr, e.ssim, e.edge_rms})
      html += "<td>" + number(v);
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

/// Wrong-surface pixels of each setting, cause by cause; causes that none of them has are left out.
std::string causes_table(const std::vector<const Row*>& rows) {
  std::vector<std::size_t> causes;
  for (std::size_t i = 0; i < inspect::cause_count; ++i) {
    if (std::ranges::any_of(rows, [i](const Row* row) { return row->errors.causes[i] != 0; }))
      causes.push_back(i);
  }
  if (causes.empty()) return {};
  std::string html =
      "<div class=wide><table><caption>Wrong-surface pixels by cause, down from the most accurate</caption>"
      "<tr><th class=name>setting<th>all";
  for (const auto cause : causes) html += "<th>" + std::string(inspect::cause_names[cause]);
  html += "<th>of pixels drawn</tr>\n";
  for (const Row* row : rows) {
    html += joined({"<tr", row->is_console ? " class=console" : "", "><td class=name>", escaped(row->setting),
                    "<td>", std::to_string(row->errors.wrong_pixels)});
    for (const auto cause : causes) html += "<td>" + std::to_string(row->errors.causes[cause]);
    html += "<td>" + std::to_string(row->errors.pixels_drawn) + "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string anchor(const SceneResult& scene, std::string_view part) {
  std::string id;
  for (const char c : scene.scene) id += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return joined({id, "-", part});
}

/// One line an axis: its price.
std::string findings_table(const SceneResult& scene) {
  std::string html =
      "<div class=wide><table><caption>What each accuracy costs, raised by itself</caption><tr><th "
      "class=name>axis<th class=name>the console<th class=name>more accurate<th>ms<th>ratio<th "
      "class=\"name gap\">error<th>the console's<th>left<th class=name></tr>\n";
  bool any = false;
  for (const auto& axis : axes()) {
    const auto found = finding(scene, axis);
    if (!found) continue;
    any = true;
    const auto& measure = info(axis.measure);
    html += joined({"<tr><td class=name><a href=\"#", anchor(scene, axis.name), "\">", axis.name,
                    "</a><td class=name>", escaped(found->console->setting), "<td class=name>"});
    html +=
        found->improves()
            ? joined({escaped(found->chosen->setting), "<td>", number(found->console->ms), " &rarr; ",
                      number(found->chosen->ms), "<td>", ratio(found->chosen->ratio, found->console->ratio)})
            : std::string("nothing better here<td>-<td>-");
    html += joined({"<td class=\"name gap\">", measure.noun, "<td>", number(found->error_from), "<td>",
                    number(found->error_to), "<td class=name>", measure.unit, "</tr>\n"});
  }
  return any ? html + "</table></div>\n" : std::string();
}

std::string hero(const SceneResult& scene) {
  const auto console = std::ranges::find_if(
      scene.rows, [](const Row& row) { return row.direction == Direction::up && row.is_console; });
  std::string html = "<div class=pictures>\n";
  if (console != scene.rows.end()) {
    html += "<figure class=large>" + image(console->picture, "as on the console") +
            "<figcaption><b>As on the console</b>, " + ms(console->ms) + " a frame, PSNR " +
            number(console->errors.psnr) + " dB</figcaption></figure>\n";
  }
  return html + "<figure class=large>" + image(scene.reference, "reference") +
         "<figcaption><b>The reference</b>: z-buffer of 32 bits, float64 transform, 1/256-pixel positions, "
         "perspective, bilinear texels, 24-bit colour, fog per pixel, 64 samples a "
         "pixel</figcaption></figure>"
         "</div>\n";
}

std::string combinations_section(const SceneResult& scene, bool& has_plots) {
  const auto front = front_of(scene.rows);
  if (front.empty()) return {};
  const auto plot = front_plot(scene);
  has_plots = has_plots && !plot.empty();
  std::string html = joined(
      {"<h3 id=\"", anchor(scene, "front"),
       "\">All axes together <small>no setting or combination measured is both faster and nearer to the "
       "reference picture than those on the Pareto front</small></h3>\n<div class=pair>",
       plot,
       "<div class=wide><table><tr><th>no.<th class=name>setting or combination<th>ms<th>error, rms of "
       "255<th>PSNR, "
       "dB<th>SSIM</tr>\n"});
  for (std::size_t i = 0; i < front.size(); ++i) {
    const Row& row = *front[i];
    html += joined({"<tr><td>", std::to_string(i + 1), "<td class=\"name text\">", escaped(row.label()),
                    "<td>", number(row.ms), "<td>", number(row.errors.colour_rms), "<td>",
                    number(row.errors.psnr), "<td>", number(row.errors.ssim), "</tr>\n"});
  }
  html += "</table></div></div>\n<div class=pictures>\n";
  const auto detail = detail_of(front, scene.reference);
  for (std::size_t i = 0; i < front.size(); ++i) {
    html += figure(*front[i], detail,
                   joined({"<b>", std::to_string(i + 1), "</b>&ensp;", escaped(front[i]->label()), ", ",
                           ms(front[i]->ms)}));
  }
  return html + "</div>\n";
}

std::string axis_section(const SceneResult& scene, const Axis& axis, bool& has_plots) {
  const auto up = rows_of(scene, &axis, Direction::up);
  const auto down = rows_of(scene, &axis, Direction::down);
  if (up.empty() && down.empty()) return {};
  const auto plot = axis_plot(scene, axis);
  has_plots = has_plots && !plot.empty();
  const auto found = sentence(scene, axis);
  return joined({"<h3 id=\"", anchor(scene, axis.name), "\">", axis.name, " <small>",
                 info(axis.measure).name(), axis.without_samples ? "; swept down at one sample a pixel" : "",
                 "</small></h3>\n", found.empty() ? "" : "<p class=found>" + escaped(found) + "</p>\n",
                 "<div class=pair>", plot, summary_table(scene, axis), "</div>\n",
                 axis.measure == Measure::wrong_surface ? causes_table(down) : "", gallery(scene, down, axis),
                 "<details><summary>Every stage and every error</summary>\n",
                 stage_table(up, "Up from the console"), stage_table(down, "Down from the most accurate"),
                 "</details>\n"});
}

void add_scene(Html& html, const SceneResult& scene) {
  html.page += joined({"<h2 id=\"", anchor(scene, "top"), "\">", escaped(scene.scene),
                       "</h2>\n<p class=meta>Frame ", std::to_string(scene.frame), ", ",
                       std::to_string(scene.width), " &times; ", std::to_string(scene.height),
                       ", medians of ", std::to_string(scene.rounds), " interleaved rounds",
                       scene.complete ? "." : "; stopped early: what was measured until then.", "</p>\n"});
  html.page += findings_table(scene) + hero(scene) + combinations_section(scene, html.has_plots);
  for (const auto& axis : axes()) html.page += axis_section(scene, axis, html.has_plots);
  if (scene.skipped.empty()) return;
  html.page += "<h3>Not drawn</h3><ul>\n";
  for (const auto& line : scene.skipped) html.page += "<li>" + escaped(line) + "</li>\n";
  html.page += "</ul>\n";
}

/// The colours of the heat maps, as a gradient.
std::string heat_scale() {
  std::string stops;
  for (int i = 0; i <= 16; ++i) {
    const auto c = heat(static_cast<int>(std::lround(255.0 * i * i / 256)));
    stops += joined({i == 0 ? "" : ",", "rgb(", std::to_string(c.r), " ", std::to_string(c.g), " ",
                     std::to_string(c.b), ")"});
  }
  return "0<span class=scale style=\"background:linear-gradient(90deg," + stops + ")\"></span>255";
}

std::string introduction(const Report& report) {
  std::string html = joined(
      {"<h1>What accuracy costs</h1>\n<p class=meta><code>", escaped(report.command),
       "</code></p>\n<p class=meta>", escaped(report.machine), " &middot; vector code for ",
       escaped(report.target), " &middot; ", escaped(report.compiler), "</p>\n",
       "<p>Every approximation of the console is a knob. Each is measured twice: <em>up</em>, raised by "
       "itself "
       "from the console's settings, tells what one improvement costs; <em>down</em>, lowered by itself from "
       "the "
       "most accurate settings, tells what error this one approximation leaves when nothing else hides it. "
       "In "
       "plots, filled marks are those that no other of the same sweep beats in both time and error; in "
       "tables "
       "they are green, and the console's own setting has a tinted row.</p>\n<p>Pictures show the downward "
       "sweep. "
       "Under each: its distance from the reference, ",
       heat_scale(),
       " of 255, square root scale; and the 80 &times; 60 pixels in which the settings differ most.</p>\n"});
  if (report.scenes.size() > 1) {
    html += "<p>";
    for (const auto& scene : report.scenes)
      html += joined({"<a href=\"#", anchor(scene, "top"), "\">", escaped(scene.scene), "</a> "});
    html += "</p>\n";
  }
  return html;
}

}  // namespace

Html to_html(const Report& report) {
  Html html;
  html.page =
      joined({"<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n<meta name=viewport "
              "content=\"width=device-width,initial-scale=1\">\n<title>What accuracy costs</title>\n<style>",
              page_style, "</style></head><body>\n", introduction(report)});
  for (const auto& scene : report.scenes) add_scene(html, scene);
  if (!html.has_plots) html.page += "<p class=meta>The plots need gnuplot, which could not be run.</p>\n";
  html.page += "</body></html>\n";
  return html;
}

}  // namespace cost
