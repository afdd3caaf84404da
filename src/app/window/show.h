#pragma once
// What is drawn before it is on the screen: one or two machines, their pictures, and what differs.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "app/subject.h"
#include "app/window/window.h"

namespace app {

class Show {
 public:
  explicit Show(const std::vector<WindowScene>& scenes) : scenes_(scenes) {}

  /// Draws what `state` asks for, if anything it depends on has changed. False: nothing has changed.
  /// On an error the pictures stay as they are.
  base::Result<bool> update(const WindowState& state);

  /// With differences on, the pixels that differ are marked in both.
  [[nodiscard]] const base::Picture& left() const { return left_; }
  [[nodiscard]] const base::Picture& right() const { return right_; }
  [[nodiscard]] const scene::FrameStats& stats() const { return stats_; }
  [[nodiscard]] std::optional<std::uint64_t> different() const { return different_; }
  /// The machine whose picture is left(); nullptr before the first update.
  [[nodiscard]] Subject* machine() const { return shown_.get(); }
  /// What loading the scene had to say, once per scene.
  [[nodiscard]] const std::string& scene_name() const { return name_; }
  /// Index of what machine() is; -1: nothing yet.
  [[nodiscard]] int scene() const { return scene_; }

 private:
  struct Asked {  // everything a picture depends on
    int scene = -1;
    std::int64_t frame = 0;
    scene::Knobs knobs, other;
    CameraOffset camera;
    bool compares = false, differences = false;
    bool operator==(const Asked&) const = default;
  };

  base::Result<void> change_scene(const WindowState& state);

  const std::vector<WindowScene>& scenes_;
  Asked drawn_;
  int scene_ = -1;
  std::string name_;
  std::unique_ptr<Subject> shown_, other_;  // the other one only while two pictures are compared
  base::Picture left_, right_;
  scene::FrameStats stats_;
  std::optional<std::uint64_t> different_;
};

}  // namespace app
