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
  Stages stages;      ///< medians
  double ms = 0;      ///< median of the whole frame
  double cpu_ms = 0;  ///< the same of the process' time: others on the machine are not in it
  double spread = 0;  ///< distance between the quartiles of `ms`
  /// Times the console's frame, drawn just before each of its own: median of the quotients of process time.
  double ratio = 0;
  Touched touched;               ///< bytes read and written
  std::uint64_t held_bytes = 0;  ///< memory the frame needs
  Errors errors;
  base::Picture picture;     ///< at the console's resolution
  base::Picture difference;  ///< its distance from the reference, as a heat map
  bool is_console = false;   ///< the console's setting of its axis
  bool is_best = false;      ///< no other of its sweep is both faster and nearer by its axis' own error
  bool on_front = false;  ///< no other row of the report is both faster and nearer to the reference picture

  /// The error it competes by: its axis' own; of a combination, the distance from the reference picture.
  [[nodiscard]] double error() const { return errors.of(axis != nullptr ? axis->measure : Measure::colour); }
  [[nodiscard]] std::string_view axis_name() const { return axis != nullptr ? axis->name : "cross"; }
  /// What was set, for a list of rows of all kinds.
  [[nodiscard]] std::string label() const;
};

struct SceneResult {
  std::string scene;
  std::uint32_t frame = 0;
  int width = 0, height = 0, rounds = 0;  ///< rounds completed by every row
  std::vector<Row> rows;
  base::Picture reference;
  std::vector<std::string> skipped;  ///< settings that could not be drawn, and why
  bool complete = true;              ///< false: stopped early
  /// Of the console's frame, drawn again and again between the others: distance of the quartiles over the
  /// median of its time on the wall. Above `busy` other programs had a part in the figures.
  double noise = 0;
  static constexpr double busy = 0.1;

  [[nodiscard]] const Row* find(const Axis& axis, Direction direction, std::string_view setting) const;
};

/// Error: the reference itself cannot be drawn.
base::Result<SceneResult> sweep(Subject& subject, const SweepOptions& options);

/// Marks the rows that no other row beats in both time and error: within each axis and direction by its own
/// error (is_best), and of all rows by the distance from the reference picture (on_front).
void mark_front(std::vector<Row>& rows);
/// The front, fastest first; of rows with the same knobs one.
std::vector<const Row*> front_of(const std::vector<Row>& rows);

}  // namespace cost
