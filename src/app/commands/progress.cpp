#include "app/commands/progress.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <utility>

namespace app {
namespace {

std::atomic<int> progresses = 0;  // that live

}  // namespace

Progress::Progress(std::string what, std::size_t steps)
    : what_(std::move(what)), steps_(steps), is_terminal_(isatty(STDERR_FILENO) == 1) {
  ++progresses;
}

Progress::~Progress() {
  --progresses;
  if (shown_) std::fputs("\r\x1b[K", stderr);
}

void Progress::step() { at(done_ + 1); }

void Progress::at(std::size_t done) {
  if (done == 0) return;
  const std::chrono::duration<double> taken = Clock::now() - begin_;
  const double left = static_cast<double>(steps_) - static_cast<double>(done);
  show(done, taken.count() / static_cast<double>(done) * left);
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

Busy::Busy(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { tell(); });
}

Busy::~Busy() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  ended_.notify_one();
  thread_.join();
}

void Busy::tell() {
  using namespace std::chrono_literals;
  bool shown = false;
  std::unique_lock lock(mutex_);
  for (int seconds = 1; !ended_.wait_for(lock, 1s, [this] { return is_over_; }); ++seconds) {
    if (seconds < 2 || progresses > 0) continue;
    shown = true;
    std::fprintf(stderr, "\r\x1b[K%s: %d s", what_.c_str(), seconds);
    std::fflush(stderr);
  }
  if (shown) std::fputs("\r\x1b[K", stderr);
}

}  // namespace app
