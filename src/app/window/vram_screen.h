#pragma once
// VRAM as a texture, with what of it the frame reads and writes: both made anew only when they are others.

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "app/window/screen.h"
#include "app/window/window_state.h"
#include "base/picture.h"
#include "debug/accesses.h"
#include "debug/frame_view.h"

namespace app {

class VramScreen {
 public:
  /// VRAM is another one from now on.
  void forget() { screen_ = {}; }
  void forget_accesses() { has_accesses_ = false; }
  /// Asks for `pixels` (1024 x 512) where they or the way they are read have changed. True: the texture is
  /// new.
  bool update(SDL_Renderer* renderer, const VramState& state,
              const std::function<std::vector<std::uint16_t>()>& pixels);
  /// Draws the part that `state` zooms to.
  void draw(SDL_Renderer* renderer, const VramState& state, Rect place) const;

  /// Empty before the first update.
  [[nodiscard]] std::span<const std::uint16_t> pixels() const { return pixels_; }
  [[nodiscard]] base::Picture picture(const VramState& state) const;
  /// Of the frame taken apart; `view` may be nullptr, then those of the last one.
  const std::vector<debug::Access>& accesses(debug::FrameView* view);

 private:
  Screen screen_;
  std::pair<display::VramFormat, display::Palette> asked_;  // what it shows, and of what
  std::vector<std::uint16_t> pixels_;
  std::vector<debug::Access> accesses_;
  bool has_accesses_ = false;
};

}  // namespace app
