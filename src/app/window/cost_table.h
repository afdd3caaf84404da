#pragma once
// What a frame costs with one knob changed: the numbers of the live cost panel. Pure: knows neither threads
// nor drawing.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cost/axes.h"
#include "scene/knobs.h"

namespace app {

/// Where the middle half of some measurements lies.
struct Spread {
  double low = 0, high = 0;
};

/// The median of the last measurements.
class RollingMedian {
 public:
  static constexpr std::size_t window = 9;
  void add(double value);
  [[nodiscard]] std::size_t count() const { return values_.size(); }
  /// Of an even count the mean of the two in the middle. Needs count() > 0.
  [[nodiscard]] double median() const;
  /// From the quarter of them that is lowest to the quarter that is highest, ends included.
  [[nodiscard]] Spread spread() const;

 private:
  [[nodiscard]] std::vector<double> sorted() const;
  std::vector<double> values_;  // at most `window`
  std::size_t oldest_ = 0;      // once it is full
};

/// The knobs on screen with one setting of one axis in place of theirs.
struct CostLine {
  const cost::Axis* axis = nullptr;
  const cost::Setting* setting = nullptr;
  scene::Knobs knobs;
  bool is_current = false;  ///< the axis is at this setting already
  std::string error;        ///< why it cannot be drawn; empty if it can
  RollingMedian ms;
};

/// One line a setting of every axis, in the order of cost::axes(), and the measurement due next.
class CostTable {
 public:
  /// Measurements stay while the knobs do: the scene may move on. Other knobs begin again.
  void follow(const scene::Knobs& now);

  [[nodiscard]] const scene::Knobs& current() const { return current_; }
  [[nodiscard]] std::span<const CostLine> lines() const { return lines_; }
  /// Milliseconds of the frame as it is; nothing before it was measured.
  [[nodiscard]] std::optional<double> current_ms() const;
  /// Of a line; the settings in use share one measurement.
  [[nodiscard]] std::optional<double> ms(const CostLine& line) const;
  /// How many times the frame's time a line takes; nothing until both are known.
  [[nodiscard]] std::optional<double> ratio(const CostLine& line) const;
  [[nodiscard]] std::optional<Spread> spread(const CostLine& line) const;
  /// 1: a line takes longer than the frame as it is, -1: less long, 0: their spreads touch, or one is not
  /// known from three measurements yet.
  [[nodiscard]] int against_current(const CostLine& line) const;
  /// Every line was measured as often as is remembered: more changes little while the picture stays.
  [[nodiscard]] bool is_settled() const;
  /// Settings that were measured, or found impossible, at least once; of how many.
  [[nodiscard]] std::size_t known() const;
  [[nodiscard]] std::size_t all() const;

  /// The knobs to measure next: every setting in turn, and between every `between` of them the frame as it
  /// is, so that a ratio compares times that were measured together.
  static constexpr int between = 6;
  const scene::Knobs& next();
  /// What next() named took so long, or cannot be drawn.
  void add(double ms);
  void fail(std::string why);

 private:
  [[nodiscard]] const RollingMedian& times(const CostLine& line) const;

  scene::Knobs current_;
  RollingMedian current_ms_;
  std::vector<CostLine> lines_;
  std::optional<std::size_t> due_;  // what next() named; nothing: the frame as it is
  std::size_t last_line_ = 0;
  int since_current_ = between;
};

/// "--visibility zbuffer --depth 24": a setting in the words of the command line.
std::string options_of(const cost::Setting& setting);

}  // namespace app
