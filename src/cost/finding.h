#pragma once
// What a sweep found for one axis: the price of the improvement, and what it is worth.

#include <optional>
#include <string>

#include "cost/sweep.h"

namespace cost {

/// The cheapest setting, in the console's company, of those whose error is as good as the best; beside the
/// console's own. Rows are the result's.
struct Finding {
  const Row* console = nullptr;  ///< swept up
  const Row* chosen = nullptr;   ///< swept up; the console's own where nothing improves on it
  double error_from = 0;         ///< of the console's setting, swept down
  double error_to = 0;           ///< of the chosen one, swept down

  [[nodiscard]] bool improves() const { return chosen != console; }
  [[nodiscard]] double ratio() const { return console->ratio > 0 ? chosen->ratio / console->ratio : 0; }
};

/// Nothing if the axis was not measured, or not its console's setting.
std::optional<Finding> finding(const SceneResult& result, const Axis& axis);

/// The same in a sentence. Empty if there is none.
std::string sentence(const SceneResult& result, const Axis& axis);

}  // namespace cost
