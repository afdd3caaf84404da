#include "app/window/vram_screen.h"

#include "display/scanout.h"

namespace app {

bool VramScreen::update(SDL_Renderer* renderer, const VramState& state,
                        const std::function<std::vector<std::uint16_t>()>& pixels) {
  const std::pair asked(state.format, state.palette);
  if (!screen_.is_empty() && asked == asked_) return false;
  asked_ = asked;
  pixels_ = pixels();
  screen_.show(renderer, picture(state));
  return true;
}

void VramScreen::draw(SDL_Renderer* renderer, const VramState& state, Rect place) const {
  screen_.draw_part(renderer, place, state.x / display::vram_width, state.y / display::vram_height,
                    1 / state.zoom, 1 / state.zoom);
}

base::Picture VramScreen::picture(const VramState& state) const {
  return display::vram_picture(pixels_, state.format, state.palette);
}

const std::vector<debug::Access>& VramScreen::accesses(debug::FrameView* view) {
  if (view != nullptr && !std::exchange(has_accesses_, true)) accesses_ = debug::accesses_of(*view);
  return accesses_;
}

}  // namespace app
