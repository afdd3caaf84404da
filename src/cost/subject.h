#pragma once
// One scene under measurement: draws its frame with any knobs, timed stage by stage.

#include <memory>
#include <span>
#include <vector>

#include "base/picture.h"
#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "gpu/trace.h"
#include "machine/machine.h"
#include "scene/frame.h"
#include "scene/knobs.h"
#include "scene/plan.h"

namespace cost {

/// Milliseconds of one frame.
struct Stages {
  double gte = 0;     ///< animate, transform, light
  double ot = 0;      ///< cull, clip, packets, insertion
  double walk = 0;    ///< the list followed, words sent nowhere
  double raster = 0;  ///< words decoded and drawn: draw time less walk
  double filter = 0;  ///< samples to pixels, filters after the frame, scan-out
  [[nodiscard]] double total() const { return gte + ot + walk + raster + filter; }
};

/// A frame and what is known about it.
struct Drawn {
  Stages stages;
  double cpu_ms = 0;  ///< of the process, for all stages: what others take of the machine is not in it
  scene::FrameStats stats;
  std::uint64_t held_bytes =
      0;  ///< memory the frame needs: lists in main RAM, frame, depth, samples, history
  std::uint64_t history_bytes = 0;  ///< of these, what temporal accumulation keeps
};

/// A frame with the writer and the texture coordinates of each pixel, one sample a pixel.
struct Traced {
  std::vector<std::uint32_t> writers;    ///< draw + 1 per pixel; 0: nobody
  std::vector<std::uint32_t> texcoords;  ///< as gpu::canvas::Canvas::texcoords
  std::vector<gpu::Primitive> draws;
};

class Subject {
 public:
  Subject(scene::Scene scene, std::uint32_t frame);
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  [[nodiscard]] const std::string& name() const { return scene_.name; }
  [[nodiscard]] std::uint32_t frame() const { return frame_; }

  /// Draws the frame as often as its knobs need to settle (`warm`: once at least), then once more, timed.
  base::Result<Drawn> draw(const scene::Knobs& knobs);
  /// What the last draw() shows, at the resolution of its knobs.
  [[nodiscard]] const base::Picture& picture() const { return machine_.picture(); }
  [[nodiscard]] const gpu::Gpu& gpu() const { return machine_.gpu(); }

  /// The frame drawn on the console's target with a history of every write, for inspection.
  base::Result<void> trace_console(scene::Knobs knobs, gpu::Trace& to);
  /// The same at the positions and with the texels that the knobs draw, one sample a pixel: what inspect
  /// judges.
  base::Result<void> trace_surfaces(scene::Knobs knobs, gpu::Trace& to);
  /// The frame drawn on a canvas of one sample that keeps who wrote what.
  base::Result<Traced> trace_canvas(scene::Knobs knobs);
  /// The words of the frame, list after list, as a walk sends them.
  base::Result<std::vector<std::uint32_t>> words(const scene::Knobs& knobs);
  /// Draws such words on the targets of `knobs`: milliseconds.
  base::Result<double> draw_words(const scene::Knobs& knobs, std::span<const std::uint32_t> words);
  [[nodiscard]] bool uses_canvas(const scene::Knobs& knobs) { return plan_of(knobs).canvas.has_value(); }
  /// What the knobs mean for the frame.
  [[nodiscard]] scene::Plan plan_of(const scene::Knobs& knobs) { return builder(knobs).plan_of(knobs); }
  /// The polygons as they would be drawn, before any is.
  std::vector<scene::ScreenPolygon> polygons(const scene::Knobs& knobs);

 private:
  scene::FrameBuilder& builder(const scene::Knobs& knobs) { return machine_.builder(knobs); }
  [[nodiscard]] double seconds() const { return frame_ / 60.0; }
  base::Result<void> trace(const scene::Knobs& knobs, gpu::Trace& to);

  scene::Scene scene_;
  std::uint32_t frame_;
  machine::Machine machine_{scene_};
  int buffer_y_ = 0;  // of the last words()
};

}  // namespace cost
