#include "cost/finding.h"

#include <algorithm>
#include <vector>

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

std::optional<Finding> finding(const SceneResult& result, const Axis& axis) {
  const auto up = rows_of(result, axis, Direction::up);
  const auto down = rows_of(result, axis, Direction::down);
  const auto is_console = [](const Row* row) { return row->is_console; };
  const auto up_console = std::ranges::find_if(up, is_console);
  const auto down_console = std::ranges::find_if(down, is_console);
  if (up_console == up.end() || down_console == down.end()) return std::nullopt;
  const auto error = [&](const Row* row) { return row->errors.of(axis.measure); };
  const double from = error(*down_console);
  const double least = error(*std::ranges::min_element(down, {}, error));
  Finding found{*up_console, *up_console, from, from};
  if (from <= least * as_good || from - least < 1e-9) return found;
  for (const Row* row : up) {
    const auto* lowered = result.find(axis, Direction::down, row->setting);
    if (lowered == nullptr || error(lowered) > least * as_good + 1e-12) continue;
    if (found.improves() && row->ms >= found.chosen->ms) continue;
    found.chosen = row;
    found.error_to = error(lowered);
  }
  return found;
}

std::string sentence(const SceneResult& result, const Axis& axis) {
  const auto found = finding(result, axis);
  if (!found) return {};
  const MeasureInfo& measure = info(axis.measure);
  const auto amount = [&](double value) { return joined({number(value), " ", measure.unit}); };
  if (!found->improves()) {
    return joined({axis.question, ": nothing improves on the console's ", found->console->setting,
                   " here; the ", measure.noun, " is ", amount(found->error_from), "."});
  }
  return joined({axis.question, ": ", found->chosen->setting, " takes ", number(found->ratio()),
                 " times the console's frame (", number(found->console->ms), " to ",
                 number(found->chosen->ms), " ms); the ", measure.noun, " falls from ",
                 number(found->error_from), " (", found->console->setting, ") to ", amount(found->error_to),
                 "."});
}

}  // namespace cost
