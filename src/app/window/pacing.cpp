#include "app/window/pacing.h"

namespace app {

void Pacing::follow(Pace pace, SDL_Renderer* renderer) {
  if (pace == pace_) return;
  pace_ = pace;
  SDL_RenderSetVSync(renderer, pace_ == Pace::vsync ? 1 : 0);
  start_anew();
}

void Pacing::wait() {
  using std::chrono::duration;
  const double period = pace_ == Pace::hz60 ? 1.0 / 60 : pace_ == Pace::hz50 ? 1.0 / 50 : 1.0 / 250;
  due_ += std::chrono::duration_cast<Clock::duration>(duration<double>(period));
  const double early = duration<double>(due_ - Clock::now()).count();
  if (early > 0) SDL_Delay(static_cast<Uint32>(early * 1000));
  if (early < -0.1 || pace_ == Pace::vsync) start_anew();  // late: do not hurry after it
}

}  // namespace app
