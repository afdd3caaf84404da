#pragma once
// One trip of all instances of a world through projection, light and submission.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <vector>

#include "base/clock.h"
#include "scene/content.h"
#include "scene/plan.h"
#include "scene/submit.h"
#include "scene/view.h"

namespace scene {

/// True if the map keeps angles and scales evenly: normals can go through the light matrix as they are.
inline bool is_even(const glm::dmat3& m) {
  const double size = glm::dot(m[0], m[0]);
  const double tolerance = size * 1e-4;
  return std::abs(glm::dot(m[1], m[1]) - size) <= tolerance &&
         std::abs(glm::dot(m[2], m[2]) - size) <= tolerance && std::abs(glm::dot(m[0], m[1])) <= tolerance &&
         std::abs(glm::dot(m[0], m[2])) <= tolerance && std::abs(glm::dot(m[1], m[2])) <= tolerance;
}

/// Memory that passes use one after the other.
struct PassMemory {
  Projected projected;
  std::vector<gte::Colour> colours;
  Shader shader;
};

class Pass {
 public:
  /// All of them must outlive this.
  Pass(const World& world, const Content& content, const Plan& plan, PassMemory& memory)
      : world_(world), content_(content), plan_(plan), memory_(memory) {}

  /// Calls sink(const Primitive&) for everything that is to be drawn, lines too, in the order of the scene.
  template <class Sink>
  void run(FrameStats& stats, Sink& sink) {
    const Wanted& wanted = plan_.wanted;
    const View view = view_of(world_.camera, plan_.width, plan_.height, content_.units);
    const Clipper clipper(view.projection, plan_.transform == Transform::gte);
    Placement placement;
    placement.projection = view.projection;
    placement.transform = plan_.transform;
    if (wanted.fog) set_depth_cue(placement.registers, world_.depth_cue, view);
    std::optional<Halver> halver;
    if (plan_.halving) halver.emplace(*plan_.halving, view.projection, clipper);
    Submission submission;
    submission.halver = halver ? &*halver : nullptr;
    submission.placement = &placement;
    submission.projected = &memory_.projected;
    submission.materials = content_.materials;
    submission.clipper = &clipper;
    submission.key = plan_.key;
    submission.fraction_mask = plan_.fraction_mask;
    for (std::size_t i = 0; i < world_.instances.size(); ++i) {
      const auto& instance = world_.instances[i];
      if (instance.mesh >= content_.models.size()) continue;
      const Model& model = content_.models[instance.mesh];
      const double start = base::now_ms();
      placement.model = &model;
      if (!place(view, instance, placement)) {
        const auto faces = static_cast<std::uint32_t>(model.faces.size() + model.lines.size());
        stats.faces += faces;
        stats.dropped[static_cast<std::size_t>(Drop::unrepresentable)] += faces;
        continue;
      }
      project(placement, wanted, memory_.projected);
      stats.vertices += static_cast<std::uint32_t>(model.vertices.size());
      light(instance, model, placement);
      memory_.shader.shade(placement, memory_.projected, wanted.fog, memory_.colours);
      submission.colours = memory_.colours;
      submission.mirrored = glm::determinant(placement.exact.linear) * view_sign < 0;
      submission.instance = static_cast<std::uint32_t>(i);
      const double middle = base::now_ms();
      Submitter<Sink>(submission, stats, sink).submit();
      stats.gte_ms += middle - start;
      stats.ot_ms += base::now_ms() - middle;
    }
  }

 private:
  static constexpr double view_sign = 1;  // x right, y down, z in: the axes of view space keep orientation

  static bool place(const View& view, const Instance& instance, Placement& placement) {
    placement.exact = to_view(view, instance.model, glm::dvec3(0), 1);
    const Model& model = *placement.model;
    return set_transform(placement.registers, to_view(view, instance.model, model.centre, model.scale),
                         view.projection);
  }

  void light(const Instance& instance, const Model& model, Placement& placement) {
    if (model.colours.lit == 0) return;
    const glm::dmat3 linear{glm::dvec3(instance.model[0]), glm::dvec3(instance.model[1]),
                            glm::dvec3(instance.model[2])};
    if (is_even(linear) || !(std::abs(glm::determinant(linear)) > 0)) {
      memory_.shader.use_model_normals();
      const double size = std::sqrt(glm::dot(linear[0], linear[0]));
      set_lights(placement.registers, world_, size > 0 ? linear / size : glm::dmat3(1.0));
    } else {
      memory_.shader.use_world_normals(model, glm::transpose(glm::inverse(linear)));
      set_lights(placement.registers, world_, glm::dmat3(1.0));
    }
  }

  const World& world_;
  const Content& content_;
  const Plan& plan_;
  PassMemory& memory_;
};

}  // namespace scene
