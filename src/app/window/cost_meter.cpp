#include "app/window/cost_meter.h"

#include <time.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <utility>

#include "app/viewer.h"

namespace app {
namespace {

// A window that was hidden for a minute has not saved up a minute of measuring.
constexpr double most_credit_ms = 50;

// Processor time of this thread alone: the window and other programs that share the machine do not count.
double ms_of_this_thread() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

CostMeter::CostMeter(scene::Scene scene)
    : CostMeter(std::make_unique<Viewer>(std::move(scene), scene::Knobs{})) {}

CostMeter::CostMeter(std::unique_ptr<Subject> machine)
    : thread_([this, own = std::shared_ptr<Subject>(std::move(machine))](const std::stop_token& stop) {
        run(stop, *own);
      }) {}

void CostMeter::follow(std::int64_t frame, const scene::Knobs& knobs, const CameraOffset& camera,
                       double grant_ms) {
  {
    const std::lock_guard lock(mutex_);
    table_.follow(knobs);
    frame_ = frame;
    camera_ = camera;
    credit_ms_ = std::min(credit_ms_ + grant_ms, most_credit_ms);
  }
  granted_.notify_one();
}

CostTable CostMeter::table() const {
  const std::lock_guard lock(mutex_);
  return table_;
}

bool CostMeter::has_ended() const {
  const std::lock_guard lock(mutex_);
  return has_ended_;
}

void CostMeter::run(const std::stop_token& stop, Subject& machine) {
  std::unique_lock lock(mutex_);
  while (granted_.wait(lock, stop, [this] { return credit_ms_ > 0; }) && !stop.stop_requested()) {
    const Job job{frame_, table_.next(), table_.current(), camera_};
    lock.unlock();
    const double begin = ms_of_this_thread();
    auto ms = measured(machine, job);
    const double spent = ms_of_this_thread() - begin;
    lock.lock();
    credit_ms_ -= spent;
    if (table_.current() != job.screen) continue;  // the knobs have changed meanwhile
    ms ? table_.add(*ms) : table_.fail(std::move(ms.error().text));
  }
  has_ended_ = true;
}

// The frame after the one before it: that allocates what the knobs call for, and temporal accumulation goes
// on from it.
base::Result<double> CostMeter::measured(Subject& machine, const Job& job) {
  try {
    if (auto before = machine.draw(job.frame - 1, job.knobs, job.camera); !before) {
      return tl::make_unexpected(before.error());
    }
    const double begin = ms_of_this_thread();
    if (auto drawn = machine.draw(job.frame, job.knobs, job.camera); !drawn) {
      return tl::make_unexpected(drawn.error());
    }
    return ms_of_this_thread() - begin;
  } catch (const std::exception& error) {  // memory: 64 samples of 8 times the resolution are gigabytes
    return base::fail(error.what());
  }
}

}  // namespace app
