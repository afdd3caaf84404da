// The plots of the page: scripts for gnuplot. Labels are placed here, where it is known what they would
// cover.

#include "cost/report_plots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cost/report.h"
#include "cost/text.h"

namespace cost {
namespace {

struct Size {
  double width, height;
};

struct Box {
  double x0, y0, x1, y1;
  [[nodiscard]] double shared_area(const Box& o) const {
    const double w = std::min(x1, o.x1) - std::max(x0, o.x0);
    const double h = std::min(y1, o.y1) - std::max(y0, o.y0);
    return w > 0 && h > 0 ? w * h : 0;
  }
};

/// One axis of a plot: data to pixels.
struct Scale {
  double low = 0, high = 1, from = 0, to = 1;  ///< data low..high lies at pixels from..to
  bool is_log = false;
  [[nodiscard]] double at(double value) const {
    const auto f = [this](double v) { return is_log ? std::log(v) : v; };
    return from + (f(value) - f(low)) / (f(high) - f(low)) * (to - from);
  }
};

struct Dot {
  double x, y;
  std::string label;
  std::string colour;
  bool on_front;
};

/// Labels beside their dots, where they cover no dot and no other label; each greedily takes the best of a
/// few places round its dot.
class Labels {
 public:
  Labels(Scale x, Scale y, Size size) : x_(x), y_(y), size_(size) {}

  void avoid(const Dot& dot) { taken_.push_back(around(dot, 5)); }

  /// gnuplot commands.
  std::string place(const Dot& dot) {
    constexpr double height = 13;
    const double width = 4 + 6.6 * static_cast<double>(dot.label.size());
    const double px = x_.at(dot.x);
    const double py = y_.at(dot.y);
    Box best{};
    double least = 1e300;
    for (const double far : {4.0, 12.0, 22.0, 34.0}) {
      for (int direction = 0; direction < 12; ++direction) {
        const double angle = direction * 3.14159265358979 / 6;
        const double cx = px + std::cos(angle) * (far + 3 + width / 2);
        const double cy = py + std::sin(angle) * (far + 3 + height / 2);
        const Box box{cx - width / 2, cy - height / 2, cx + width / 2, cy + height / 2};
        double price = far;
        for (const Box& other : taken_) price += 10 * box.shared_area(other);
        price += 1e3 * outside(box);
        if (price < least) {
          least = price;
          best = box;
        }
      }
    }
    taken_.push_back(best);
    return joined({"set label \"", dot.label, "\" at screen ",
                   number_of((best.x0 + best.x1) / 2 / size_.width), ", screen ",
                   number_of((best.y0 + best.y1) / 2 / size_.height), " center font ',11' tc rgb '",
                   dot.colour, "'\n"});
  }

 private:
  static std::string number_of(double v) { return std::to_string(v); }
  [[nodiscard]] Box around(const Dot& dot, double radius) const {
    const double px = x_.at(dot.x);
    const double py = y_.at(dot.y);
    return {px - radius, py - radius, px + radius, py + radius};
  }
  [[nodiscard]] double outside(const Box& b) const {
    return std::max(0.0, x_.from - b.x0) + std::max(0.0, b.x1 - x_.to - 14) + std::max(0.0, y_.from - b.y0) +
           std::max(0.0, b.y1 - y_.to - 8);
  }

  Scale x_, y_;
  Size size_;
  std::vector<Box> taken_;
};

/// 1, 2, 5, 10 ... inside the range, as gnuplot wants its tics.
std::string tics(const Scale& scale) {
  std::string list;
  if (!(scale.low > 0) || scale.high < scale.low) return "()";  // no dots
  const int first = static_cast<int>(std::floor(std::log10(scale.low)));
  const int last = static_cast<int>(std::floor(std::log10(scale.high)));
  for (int exponent = first; exponent <= last; ++exponent) {
    const double decade = std::pow(10, exponent);
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double v = decade * digit;
      if (v < scale.low * 0.999 || v > scale.high * 1.001) continue;
      list += (list.empty() ? "\"" : ", \"") + short_number(v) + "\" " + std::to_string(v);
    }
  }
  return "(" + list + ")";
}

Scale time_scale(const std::vector<Dot>& dots, Size size) {
  Scale s{1e300, 0, 74, size.width - 26, true};
  for (const Dot& d : dots) {
    s.low = std::min(s.low, d.x);
    s.high = std::max(s.high, d.x);
  }
  s.low /= 1.4;
  s.high *= 1.5;
  return s;
}

/// Logarithmic where errors span two decades and none is 0: then small ones matter as well.
Scale error_scale(const std::vector<Dot>& dots, Size size) {
  Scale s{1e300, 0, 54, size.height - 40, false};
  for (const Dot& d : dots) {
    s.low = std::min(s.low, d.y);
    s.high = std::max(s.high, d.y);
  }
  s.is_log = s.low > 0 && s.high > 100 * s.low;
  if (s.is_log) {
    s.low /= 1.6;
    s.high *= 1.6;
  } else {
    s.high = s.high > 0 ? s.high * 1.12 : 1;
    s.low = -0.06 * s.high;
  }
  return s;
}

std::string head(Size size, const Scale& x, const Scale& y, const std::string& y_label) {
  const auto n = [](double v) { return std::to_string(v); };
  std::string s = "set terminal svg size " + n(std::round(size.width)) + "," + n(std::round(size.height)) +
                  " dynamic noenhanced font 'sans-serif,12'\n";
  s += "set lmargin at screen " + n(x.from / size.width) + "\nset rmargin at screen " + n(x.to / size.width) +
       "\nset bmargin at screen " + n(y.from / size.height) + "\nset tmargin at screen " +
       n(y.to / size.height) + "\n";
  s += joined({"set border 3 lc rgb '",
               theme::soft,
               "'\nset tics nomirror textcolor rgb '",
               theme::soft,
               "'\nset grid xtics ytics lt 1 lw 1 lc rgb '",
               theme::line,
               "'\nset key at screen 0.5, screen ",
               n((size.height - 14) / size.height),
               " center horizontal reverse Left maxrows 1 width -6 samplen 1 textcolor rgb '",
               theme::ink,
               "'\nset xlabel 'frame time, ms (logarithmic)' offset 0,0.3 textcolor rgb '",
               theme::ink,
               "'\nset ylabel '",
               y_label,
               y.is_log ? " (logarithmic)" : "",
               "' offset 0.5,0 textcolor rgb '",
               theme::ink,
               "'\nset logscale x\nset xrange [",
               n(x.low),
               ":",
               n(x.high),
               "]\nset xtics ",
               tics(x),
               "\n"});
  if (y.is_log) {
    s += "set logscale y\nset yrange [" + n(y.low) + ":" + n(y.high) + "]\nset format y '%g'\n";
  } else {
    s += "set yrange [" + n(y.low) + ":" + n(y.high) + "]\nset format y '%g'\n";
  }
  return s;
}

/// The lines of a data block.
std::string data(std::string_view name, const std::vector<Dot>& dots, bool front_only) {
  std::string text = joined({"$", name, " << EOD\n"});
  for (const Dot& d : dots) {
    if (!front_only || d.on_front) text += std::to_string(d.x) + " " + std::to_string(d.y) + "\n";
  }
  return text + "EOD\n";
}

std::vector<Dot> dots_of(const SceneResult& scene, const Axis* axis, Direction direction,
                         std::string_view colour) {
  std::vector<Dot> dots;
  for (const auto& row : scene.rows) {
    if (row.axis != axis || row.direction != direction) continue;
    const auto label = numbered(*axis) ? setting_number(row) : row.setting;
    dots.push_back({row.ms, row.error(), label, std::string(colour), row.is_best});
  }
  return dots;
}

}  // namespace

std::string setting_number(const Row& row) {
  const auto& settings = row.axis->settings;
  return std::to_string(std::ranges::find(settings, row.setting, &Setting::name) - settings.begin() + 1);
}

bool numbered(const Axis& axis) { return axis.settings.size() > 8; }

std::string axis_plot(const SceneResult& scene, const Axis& axis) {
  constexpr Size size{580, 420};
  const auto up = dots_of(scene, &axis, Direction::up, theme::up);
  const auto down = dots_of(scene, &axis, Direction::down, theme::down);
  std::vector<Dot> all = up;
  all.insert(all.end(), down.begin(), down.end());
  if (all.empty()) return {};
  const Scale x = time_scale(all, size);
  const Scale y = error_scale(all, size);
  std::string script = head(size, x, y, info(axis.measure).name());
  Labels labels(x, y, size);
  for (const Dot& d : all) labels.avoid(d);
  for (const Dot& d : all) script += labels.place(d);
  for (const auto& [name, dots] : {std::pair{"up", &up}, {"down", &down}}) {
    script += data(name, *dots, false) + data(std::string(name) + "_front", *dots, true);
  }
  const auto series = [](std::string_view name, int open, int filled, std::string_view colour,
                         std::string_view title) {
    return joined({"$", name, " using 1:2 with points pt ", std::to_string(open), " ps 0.9 lw 1.5 lc rgb '",
                   colour, "' notitle, $", name, "_front using 1:2 with points pt ", std::to_string(filled),
                   " ps 1 lc rgb '", colour, "' title '", title, "'"});
  };
  script += "plot " + series("up", 6, 7, theme::up, "up from the console") + ", " +
            series("down", 4, 5, theme::down, "down from the most accurate") + "\n";
  return plotted(script);
}

/// Every row, and the front of those that nothing beats in both.
std::string front_plot(const SceneResult& scene) {
  constexpr Size size{640, 460};
  const auto dot = [](const Row& row) {
    return Dot{row.ms, row.errors.colour_rms, {}, std::string(theme::front), row.on_front};
  };
  std::vector<Dot> all, front;
  std::ranges::transform(scene.rows, std::back_inserter(all), dot);
  for (const Row* row : front_of(scene.rows)) front.push_back(dot(*row));
  if (front.empty()) return {};
  std::ranges::sort(front, {}, &Dot::x);
  for (std::size_t i = 0; i < front.size(); ++i) front[i].label = std::to_string(i + 1);
  const Scale x = time_scale(all, size);
  const Scale y = error_scale(all, size);
  std::string script = head(size, x, y, "distance from the reference, rms of 255");
  Labels labels(x, y, size);
  for (const Dot& d : all) labels.avoid(d);
  for (const Dot& d : front) script += labels.place(d);
  script += data("all", all, false) + data("front", front, false);
  script += joined({"plot $all using 1:2 with points pt 6 ps 0.7 lw 1.3 lc rgb '", theme::soft,
                    "' title 'setting or combination', $front using 1:2 with steps lw 1.5 lc rgb '",
                    theme::front, "' notitle, $front using 1:2 with points pt 7 ps 1.1 lc rgb '",
                    theme::front, "' title 'on the Pareto front'\n"});
  return plotted(script);
}

}  // namespace cost
