#pragma once
// Runs a scene over the settings of the axes, interleaved, and keeps medians.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cost/axes.h"
#include "cost/errors.h"
#include "cost/subject.h"
#include "cost/touched.h"

namespace cost {

struct SweepOptions {
  std::vector<const Axis*> axes;  ///< empty: all
  bool quick = false;             ///< fewer settings
  int rounds = 9;
  scene::Knobs given;          ///< picture size, table length, near and far
  std::function<bool()> stop;  ///< asked between frames; true ends the sweep with what it has
  /// Called after every frame drawn, of `all`; the time left is judged by what each setting took so far.
  std::function<void(std::size_t done, std::size_t all, double seconds_left)> progress;
};

enum class Direction : std::uint8_t {
  up,     ///< one axis raised from the console's settings
  down,   ///< one axis lowered from the most accurate settings
  cross,  ///< a combination across axes
};
inline constexpr std::string_view direction_names[] = {"up", "down", "cross"};

/// One setting, measured.
struct Row {
  const Axis* axis = nullptr;  ///< nullptr: a combination
  Direction direction = Direction::up;
  std::string setting;
  scene::Knobs knobs;
  Stages stages;                 ///< medians
  double ms = 0;                 ///< median of the whole frame
  double spread = 0;             ///< distance between the quartiles of the whole frame
  Touched touched;               ///< bytes read and written
  std::uint64_t held_bytes = 0;  ///< memory the frame needs
  Errors errors;
  base::Picture picture;     ///< at the console's resolution
  base::Picture difference;  ///< its distance from the reference, as a heat map
  bool is_console = false;   ///< the console's setting of its axis
  bool on_front = false;     ///< no other of its sweep is both faster and nearer to the truth

  /// The error it competes by: its axis' own; of a combination, the distance from the reference picture.
  [[nodiscard]] double error() const { return errors.of(axis != nullptr ? axis->measure : Measure::colour); }
  [[nodiscard]] std::string_view axis_name() const { return axis != nullptr ? axis->name : "cross"; }
};

struct SceneResult {
  std::string scene;
  std::uint32_t frame = 0;
  int width = 0, height = 0, rounds = 0;  ///< rounds completed by every row
  std::vector<Row> rows;
  base::Picture reference;
  std::vector<std::string> skipped;  ///< settings that could not be drawn, and why
  bool complete = true;              ///< false: stopped early

  [[nodiscard]] const Row* find(const Axis& axis, Direction direction, std::string_view setting) const;
};

/// Error: the reference itself cannot be drawn.
base::Result<SceneResult> sweep(Subject& subject, const SweepOptions& options);

/// Marks the rows that no other row of the same axis and direction beats in both time and error.
void mark_front(std::vector<Row>& rows);

}  // namespace cost
