#pragma once
// The inspection behind the inspector panel: there while the panel is open.

#include <memory>
#include <optional>
#include <utility>

#include "app/subject.h"
#include "app/window/inspection.h"
#include "app/window/window_state.h"
#include "base/picture.h"
#include "base/result.h"

namespace app {

class Watching {
 public:
  enum class Change : std::uint8_t { none, picture, frame };

  /// Watches the frame of `state` while its inspector is open. `subject` may be nullptr. What is to be shown
  /// changed: nothing, only the picture, or what the panel says too.
  base::Result<Change> update(const WindowState& state, const Subject* subject);
  /// The next update() changes the picture.
  void show_anew() { shown_ = {Map::none, -1}; }

  /// nullptr: the inspector is closed.
  [[nodiscard]] Inspection* inspection() const { return inspection_.get(); }
  [[nodiscard]] bool shows_map(const WindowState& state) const;
  /// A map, or the picture after some draws; nothing: the subject's own is asked for.
  [[nodiscard]] std::optional<base::Picture> picture(const WindowState& state) const;

 private:
  std::unique_ptr<Inspection> inspection_;
  int scene_ = -1;
  std::pair<Map, int> shown_{Map::none, -1};  // the map, and after how many draws
};

}  // namespace app
