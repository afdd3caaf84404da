#include "app/window/watching.h"

namespace app {

base::Result<Watching::Change> Watching::update(const WindowState& state, const Subject* subject) {
  if (!state.shows(Panel::inspect) || subject == nullptr) {
    const bool was_open = std::exchange(inspection_, nullptr) != nullptr;
    return was_open ? Change::picture : Change::none;
  }
  if (!inspection_ || scene_ != state.scene) {
    inspection_ = std::make_unique<Inspection>(*subject, state.knobs);
    scene_ = state.scene;
  }
  const auto drawn = inspection_->update(state);
  if (!drawn) return tl::make_unexpected(drawn.error());
  const std::pair asked(inspection_->unwatched().empty() ? state.map : Map::none, state.first_draws);
  const bool is_other = asked != std::exchange(shown_, asked);
  if (*drawn || is_other) return Change::frame;
  return asked.first == Map::none ? Change::picture : Change::none;  // a map takes a while
}

bool Watching::shows_map(const WindowState& state) const { return inspection_ && state.map != Map::none; }

std::optional<base::Picture> Watching::picture(const WindowState& state) const {
  if (!inspection_ || !inspection_->unwatched().empty()) return std::nullopt;
  if (state.map != Map::none) return inspection_->map(state.map);
  if (state.first_draws < 0) return std::nullopt;
  return inspection_->after(state.first_draws);
}

}  // namespace app
