#include "app/commands/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace app {

Progress::Progress(std::string what, std::size_t steps)
    : what_(std::move(what)), steps_(steps), is_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::step() {
  const std::chrono::duration<double> taken = Clock::now() - begin_;
  const auto done = static_cast<double>(done_ + 1);
  show(done_ + 1, taken.count() / done * (static_cast<double>(steps_) - done));
}

void Progress::show(std::size_t done, double seconds_left) {
  done_ = done;
  const auto now = Clock::now();
  using namespace std::chrono_literals;
  if (!is_terminal_ || now - begin_ < 2s || now - printed_ < 100ms || done_ >= steps_) return;
  printed_ = now;
  shown_ = true;
  std::fprintf(stderr, "\r\x1b[K%s: %zu of %zu, %.0f s left", what_.c_str(), done_, steps_, seconds_left);
  std::fflush(stderr);
}

}  // namespace app
