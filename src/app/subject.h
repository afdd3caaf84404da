#pragma once
// What the window shows: a scene that moves, or a recording. Frames of it can be asked for in any order.

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/camera.h"
#include "app/window/pad_keys.h"
#include "base/picture.h"
#include "base/result.h"
#include "debug/clip.h"
#include "display/scanout.h"
#include "gpu/gpu.h"
#include "scene/frame.h"
#include "scene/knobs.h"

namespace app {

class Live;

class Subject {
 public:
  Subject() = default;
  virtual ~Subject() = default;
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  /// Draws the frame. A subject without cameras leaves `camera` aside. Error: knobs that cannot be met, a
  /// frame that does not fit into RAM, a polygon without depth.
  virtual base::Result<scene::FrameStats> draw(std::int64_t frame, const scene::Knobs& knobs,
                                               const CameraOffset& camera) = 0;
  /// From the next draw() on every pixel written is noted in `trace`, until nullptr ends it.
  virtual void watch(gpu::Trace* trace) = 0;

  /// What draw() left: the picture, VRAM (1024 x 512), and the GPU.
  [[nodiscard]] virtual const base::Picture& picture() const = 0;
  [[nodiscard]] virtual std::vector<std::uint16_t> vram() const = 0;
  [[nodiscard]] virtual const gpu::Gpu& gpu() const = 0;
  /// Where in VRAM the picture lies.
  [[nodiscard]] virtual display::Area area() const { return display::area_of(gpu().display()); }
  /// The frame as it is sent, to be looked at command by command and to be changed. With depths, where the
  /// subject has any.
  virtual base::Result<debug::Clip> clip(std::int64_t frame, const scene::Knobs& knobs,
                                         const CameraOffset& camera) = 0;

  /// A second one of the same, to be drawn beside this, on this thread.
  [[nodiscard]] virtual std::unique_ptr<Subject> another(const scene::Knobs& knobs) const = 0;
  /// One that a thread of its own may draw: of a recording, frame `frame` alone.
  [[nodiscard]] virtual std::unique_ptr<Subject> apart(std::int64_t frame, const scene::Knobs& knobs) = 0;

  [[nodiscard]] virtual bool is_recording() const { return false; }
  /// A program that runs now; nullptr: it is something else.
  [[nodiscard]] virtual Live* live() { return nullptr; }
  /// Number of its last frame so far, from 1; nothing: it goes on for ever, from 0.
  [[nodiscard]] virtual std::optional<std::int64_t> last_frame() const { return std::nullopt; }
  /// New frames are made behind the last one while it is played: a program that runs. Frames before it can be
  /// gone back to.
  [[nodiscard]] virtual bool is_growing() const { return false; }
  /// It makes no frames any more.
  [[nodiscard]] virtual bool has_ended() const { return false; }
  /// draw() was not done in the time it has: the same frame is to be asked for again.
  [[nodiscard]] virtual bool is_behind() const { return false; }
  /// What the user holds, for frames to come; asked for only where wants_pad().
  [[nodiscard]] virtual bool wants_pad() const { return false; }
  virtual void hold(const PadHeld& /*pad*/) {}
  /// Begins or ends a recording of what it sends, into the file `path`. What was done, for the user. Error:
  /// it cannot be recorded, or not be written.
  virtual base::Result<std::string> record(const std::string& /*path*/) {
    return base::fail("F8: nothing here can be recorded; otter record writes a scene as a dump");
  }
  /// Finds out more of what is to come, for about so long. False: everything is known.
  virtual bool index_some(double /*milliseconds*/) { return false; }
  [[nodiscard]] virtual double progress() const { return 1; }

  /// Moves `camera` by `step` in the axes of the picture last drawn (see app::fly).
  virtual void fly(CameraOffset& /*camera*/, glm::vec3 /*step*/) const {}
  /// Where `camera` was in the frame last drawn; nothing without cameras.
  [[nodiscard]] virtual std::optional<CameraPlace> place(const CameraOffset& /*camera*/) const {
    return std::nullopt;
  }

  /// The rows of scene::knob_table() whose settings draw the frame with more samples than VRAM has pixels:
  /// then nothing is noted.
  [[nodiscard]] virtual std::vector<const scene::KnobInfo*> unwatched_knobs(const scene::Knobs& /*knobs*/) {
    return {};
  }
  /// Why a knob does nothing here; empty: it does what it says.
  [[nodiscard]] virtual std::string why_idle(const scene::KnobInfo& /*knob*/) const { return {}; }
  /// Lines for the user, once.
  [[nodiscard]] virtual std::vector<std::string> report() const { return {}; }
  /// Why the frame last drawn shows nothing, or why it is the last one; empty: there is nothing to say.
  [[nodiscard]] virtual std::string why_empty() const = 0;
};

}  // namespace app
