#include "gte/batch.h"

#include <hwy/targets.h>

#include <atomic>
#include <cassert>
#include <string_view>
#include <utility>
#include <vector>

#include "gte/batch_doors.h"
#include "gte/limits.h"

namespace gte {
namespace {

/// One way through the batch door.
struct Target {
  const char* name;
  const ProjectDoors* project;
  const LightDoors* light;
};

/// What this processor has, fastest first.
std::vector<Target> find_targets() {
  std::vector<Target> found;
#if HWY_ARCH_X86
  const std::int64_t supported = hwy::SupportedTargets();
  for (const auto& [name, id] : {std::pair{"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4}}) {
    const ProjectDoors* project = project_doors(id);
    const LightDoors* light = light_doors(id);
    if ((supported & id) != 0 && project != nullptr && light != nullptr) {
      found.push_back({name, project, light});
    }
  }
#endif
  found.push_back({"scalar", &plain_project_doors, &plain_light_doors});
  return found;
}

const std::vector<Target>& targets() {
  static const std::vector<Target> found = find_targets();
  return found;
}

/// What it points to is constant: threads that ask at once find the same.
std::atomic<const Target*> chosen = nullptr;

const Target& now() {
  if (const Target* known = chosen.load(std::memory_order_relaxed)) return *known;
  const Target* best = targets().data();
  chosen.store(best, std::memory_order_relaxed);
  return *best;
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
      const DepthAverage average = depth_average(scale, depth);
      limits.mac0(average.mac0);
      put(out.otz, face, limits.depth(average.otz));
      put(out.avsz_flag, face, limits.finish());
    }
  }
}

}  // namespace

void project(const Registers& setup, std::span<const Vertex> in, const ProjectOut& out, Command c) {
  now().project->project(setup, in, out, c);
}

void project_triangles(const Registers& setup, std::span<const Vertex> in, const TriangleOut& out,
                       Command c) {
  assert(in.size() % 3 == 0);
  now().project->project_triangles(setup, in, out, c);
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
  now().light->light(setup, kind, normals, rgbc, ir0, out, c);
}

void cue(const Registers& setup, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
         const ColourOut& out, Command c) {
  assert(ir0.empty() || ir0.size() == rgbc.size());
  now().light->cue(setup, rgbc, ir0, out, c);
}

void cue_triples(const Registers& setup, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out, Command c) {
  assert(rgb.size() % 3 == 0 && (ir0.empty() || ir0.size() == rgb.size() / 3));
  now().light->cue_triples(setup, rgb, ir0, out, c);
}

void multiply(const Registers& setup, Command c, std::span<const Vertex> in, const VectorOut& out) {
  now().light->multiply(setup, c, in, out);
}

const char* batch_target() { return now().name; }

std::vector<const char*> batch_targets() {
  std::vector<const char*> names;
  for (const Target& target : targets()) names.push_back(target.name);
  return names;
}

bool use_batch_target(std::string_view name) {
  for (const Target& target : targets()) {
    if (target.name == name) {
      chosen.store(&target, std::memory_order_relaxed);
      return true;
    }
  }
  return false;
}

}  // namespace gte
