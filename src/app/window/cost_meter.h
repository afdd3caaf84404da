#pragma once
// Measures the scene on screen again and again, with one knob changed at a time, for as long as it lives: on
// a machine and a thread of its own, so that a setting that takes a second does not hold up the window.
//
// Times are processor times of that thread. Not measured: the window itself (uploading, scaling and showing
// the picture). The first frame with other knobs is not counted: it allocates what the later ones use.

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>

#include "app/subject.h"
#include "app/window/camera.h"
#include "app/window/cost_table.h"
#include "scene/world.h"

namespace app {

class CostMeter {
 public:
  explicit CostMeter(scene::Scene scene);
  /// `machine` may be drawn by a thread of its own.
  explicit CostMeter(std::unique_ptr<Subject> machine);

  /// What is on screen now, and so many milliseconds of measuring more: without calls the meter rests.
  void follow(std::int64_t frame, const scene::Knobs& knobs, const CameraOffset& camera, double grant_ms);
  /// The measurements so far.
  [[nodiscard]] CostTable table() const;

  /// Ends after the frame being drawn; until has_ended() the destructor would wait for that.
  void stop() { thread_.request_stop(); }
  [[nodiscard]] bool has_ended() const;

 private:
  struct Job {
    std::int64_t frame = 0;
    scene::Knobs knobs, screen;  // to be measured; on screen when it was chosen
    CameraOffset camera;
  };
  void run(const std::stop_token& stop, Subject& machine);
  static base::Result<double> measured(Subject& machine, const Job& job);

  mutable std::mutex mutex_;  // guards all but the thread
  std::condition_variable_any granted_;
  CostTable table_;
  std::int64_t frame_ = 0;
  CameraOffset camera_;
  double credit_ms_ = 0;
  bool has_ended_ = false;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace app
