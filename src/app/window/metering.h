#pragma once
// The meter behind the cost panel: there while the panel is open, granted its share of each frame.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "app/subject.h"
#include "app/window/cost_meter.h"
#include "app/window/cost_table.h"
#include "app/window/window_state.h"

namespace app {

class Metering {
 public:
  /// `subject` may be nullptr. A meter that is no longer wanted goes when its last drawing is done: waiting
  /// for it would show.
  void update(const WindowState& state, Subject* subject);
  /// Whether the figures still change.
  [[nodiscard]] bool is_measuring() const { return is_measuring_; }
  /// The figures of a scene; nothing: it is not measured.
  [[nodiscard]] std::optional<CostTable> table(int scene) const;

 private:
  std::unique_ptr<CostMeter> meter_;
  std::pair<int, std::int64_t> measured_{-1, -1};  // scene, and of recordings the frame
  bool is_measuring_ = false;
};

}  // namespace app
