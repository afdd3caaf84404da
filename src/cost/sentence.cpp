// What was found for one axis, said in a sentence that its numbers make.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cost/sweep.h"
#include "cost/text.h"

namespace cost {
namespace {

/// Errors nearer than this to the best one count as equal to it.
constexpr double as_good = 1.05;

std::vector<const Row*> rows_of(const SceneResult& result, const Axis& axis, Direction direction) {
  std::vector<const Row*> list;
  for (const auto& row : result.rows) {
    if (row.axis == &axis && row.direction == direction) list.push_back(&row);
  }
  return list;
}

}  // namespace

std::string sentence(const SceneResult& result, const Axis& axis) {
  const auto up = rows_of(result, axis, Direction::up);
  const auto down = rows_of(result, axis, Direction::down);
  const auto is_console = [](const Row* row) { return row->is_console; };
  const auto up_console = std::ranges::find_if(up, is_console);
  const auto down_console = std::ranges::find_if(down, is_console);
  if (up_console == up.end() || down_console == down.end()) return {};
  const auto error = [&](const Row* row) { return row->errors.of(axis.measure); };
  const Row* best = *std::ranges::min_element(down, {}, error);
  const MeasureInfo& measure = info(axis.measure);
  const double from = error(*down_console);
  const double least = error(best);
  const auto amount = [&](double value) { return joined({number(value), " ", measure.unit}); };
  if (from <= least * as_good || from - least < 1e-9) {
    return joined({axis.question, ": nothing improves on the console's ", (*down_console)->setting,
                   " here; the ", measure.noun, " is ", amount(from), "."});
  }
  // The cheapest, in the console's company, of those whose error is as good as the best.
  const Row* chosen = nullptr;
  for (const Row* row : up) {
    const auto* lowered = result.find(axis, Direction::down, row->setting);
    if (lowered == nullptr || error(lowered) > least * as_good + 1e-12) continue;
    if (chosen == nullptr || row->ms < chosen->ms) chosen = row;
  }
  if (chosen == nullptr) chosen = result.find(axis, Direction::up, best->setting);
  if (chosen == nullptr) return {};
  const auto* lowered = result.find(axis, Direction::down, chosen->setting);
  return joined({axis.question, ": ", chosen->setting, " takes ", number(chosen->ms / (*up_console)->ms),
                 " times the console's frame (", number((*up_console)->ms), " to ", number(chosen->ms),
                 " ms); the ", measure.noun, " falls from ", number(from), " (", (*down_console)->setting,
                 ") to ", amount(lowered != nullptr ? error(lowered) : least), "."});
}

}  // namespace cost
