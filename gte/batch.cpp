#include "gte/batch.h"

#include <hwy/targets.h>

#include <cassert>
#include <string_view>
#include <vector>

#include "gte/batch_doors.h"
#include "gte/limits.h"

namespace gte {
namespace {

/// One way through the batch door. `name` is what people call the instruction set.
struct Target {
  const char* name;
  const ProjectDoors* project;
  const LightDoors* light;
};

const char* common_name(std::int64_t target) {
  switch (target) {
    case HWY_SSE4:
      return "SSE4";
    case HWY_AVX2:
      return "AVX2";
    case HWY_AVX3:
      return "AVX-512";
    default:
      return hwy::TargetName(target);
  }
}

/// Asks Highway for the kernels of each instruction set this processor has, fastest first. Its choice is
/// process-wide, so it is left as it was found: at "all".
std::vector<Target> find_targets() {
  std::vector<Target> found;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const ProjectDoors* project = chosen_project_doors();
    const LightDoors* light = chosen_light_doors();
    if (project != nullptr && light != nullptr) found.push_back({common_name(target), project, light});
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  found.push_back({"scalar", &plain_project_doors, &plain_light_doors});
  return found;
}

struct Dispatch {
  std::vector<Target> targets = find_targets();
  Target now = targets.front();
};

Dispatch& dispatch() {
  static Dispatch chosen;
  return chosen;
}

/// NCLIP, AVSZ3 and AVSZ4 of faces whose corners are anywhere: the time goes into finding them, so no SIMD.
template <std::size_t corners>
void measure(S3_12 scale, std::span<const ScreenXy> sxy, std::span<const std::uint16_t> sz,
             std::span<const std::uint32_t> indices, const FaceOut& out) {
  assert(sxy.size() == sz.size() && indices.size() % corners == 0);
  const bool wants_area = out.mac0 != nullptr || out.nclip_flag != nullptr;
  const bool wants_average = out.otz != nullptr || out.avsz_flag != nullptr;
  for (std::size_t face = 0; face < indices.size() / corners; ++face) {
    const std::uint32_t* corner = indices.data() + face * corners;
    for (std::size_t k = 0; k < corners; ++k) assert(corner[k] < sxy.size());
    if (wants_area) {
      Limits limits;
      const std::int32_t mac0 = limits.mac0(signed_area(sxy[corner[0]], sxy[corner[1]], sxy[corner[2]]));
      put(out.mac0, face, mac0);
      put(out.nclip_flag, face, limits.finish());
    }
    if (wants_average) {
      Limits limits;
      std::int64_t depth = 0;
      for (std::size_t k = 0; k < corners; ++k) depth += sz[corner[k]];
      limits.mac0(scale.raw * depth);
      put(out.otz, face, limits.depth(scale.raw * depth >> 12));
      put(out.avsz_flag, face, limits.finish());
    }
  }
}

}  // namespace

void project(const Registers& setup, std::span<const Vertex> in, const ProjectOut& out, Command c) {
  dispatch().now.project->project(setup, in, out, c);
}

void project_triangles(const Registers& setup, std::span<const Vertex> in, const TriangleOut& out,
                       Command c) {
  assert(in.size() % 3 == 0);
  dispatch().now.project->project_triangles(setup, in, out, c);
}

void measure_triangles(const Registers& setup, std::span<const ScreenXy> sxy,
                       std::span<const std::uint16_t> sz, std::span<const std::uint32_t> indices,
                       const FaceOut& out) {
  measure<3>(setup.zsf3, sxy, sz, indices, out);
}

void measure_quads(const Registers& setup, std::span<const ScreenXy> sxy, std::span<const std::uint16_t> sz,
                   std::span<const std::uint32_t> indices, const FaceOut& out) {
  measure<4>(setup.zsf4, sxy, sz, indices, out);
}

void light(const Registers& setup, Light kind, std::span<const Vertex> normals, std::span<const Colour> rgbc,
           std::span<const std::int16_t> ir0, const ColourOut& out, Command c) {
  assert(rgbc.empty() || rgbc.size() == normals.size());
  assert(ir0.empty() || ir0.size() == normals.size());
  dispatch().now.light->light(setup, kind, normals, rgbc, ir0, out, c);
}

void cue(const Registers& setup, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
         const ColourOut& out, Command c) {
  assert(ir0.empty() || ir0.size() == rgbc.size());
  dispatch().now.light->cue(setup, rgbc, ir0, out, c);
}

void cue_triples(const Registers& setup, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out, Command c) {
  assert(rgb.size() % 3 == 0 && (ir0.empty() || ir0.size() == rgb.size() / 3));
  dispatch().now.light->cue_triples(setup, rgb, ir0, out, c);
}

void multiply(const Registers& setup, Command c, std::span<const Vertex> in, const VectorOut& out) {
  dispatch().now.light->multiply(setup, c, in, out);
}

const char* batch_target() { return dispatch().now.name; }

std::vector<const char*> batch_targets() {
  std::vector<const char*> names;
  for (const Target& target : dispatch().targets) names.push_back(target.name);
  return names;
}

bool use_batch_target(std::string_view name) {
  for (const Target& target : dispatch().targets) {
    if (target.name == name) {
      dispatch().now = target;
      return true;
    }
  }
  return false;
}

}  // namespace gte
