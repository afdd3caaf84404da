// Whole frames at 320x240: each demo, and a solid of 70,000 faces, with the time of each stage. Times on the
// wall wander on a busy machine; process time wanders less.

#include <benchmark/benchmark.h>

#include <string>

#include "demos/demos.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/angle.h"
#include "scene/pipeline.h"

namespace {

// A torus of 264 x 265 quads, lit: 69,960 faces that share their vertices.
scene::Scene torus() {
  constexpr int around = 265, across = 264;
  scene::Scene s;
  auto& w = s.world;
  scene::Mesh mesh;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double a = static_cast<double>(i) / around;
      const double b = static_cast<double>(k) / across;
      const double out = scene::cos_turns(b);
      const auto at = [&](double radius, double height) {
        return glm::vec3(static_cast<float>(radius * scene::cos_turns(a)), static_cast<float>(height),
                         static_cast<float>(radius * scene::sin_turns(a)));
      };
      mesh.positions.push_back(at(1.2 + 0.5 * out, 0.5 * scene::sin_turns(b)));
      mesh.normals.push_back(at(out, scene::sin_turns(b)));
    }
  }
  const auto at = [](int i, int k) { return static_cast<std::uint32_t>(i % around * across + k % across); };
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      scene::Face face;
      face.vertex = {at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)};
      face.colour.fill({160, 130, 100});
      mesh.faces.push_back(face);
    }
  }
  w.meshes.push_back(std::move(mesh));
  w.instances.resize(1);
  w.materials[0].lit = true;
  w.lights = {{{-0.4F, -0.8F, -0.5F}, {1, 1, 1}}};
  w.ambient = glm::vec3(0.2F);
  w.camera.position = {0, 1.8F, 4.2F};
  w.camera.orientation = scene::looking(w.camera.position, {0, 0, 0});
  s.animate = [](scene::World& world, double t) {
    world.instances[0].model = scene::rotation_x(t / 20) * scene::rotation_y(t / 10);
  };
  return s;
}

void frames(benchmark::State& state, const scene::Scene& scene, const scene::Knobs& knobs) {
  scene::FrameBuilder builder(scene, knobs);
  gpu::Gpu gpu;
  ot::MainRam ram(ot::RamSize::mib8);
  builder.upload(gpu);
  scene::FrameStats sum;
  std::uint32_t number = 0;
  while (state.KeepRunning()) {
    const auto stats = scene::render_frame(builder, scene::frame_time(number++ % 600), knobs, ram, gpu);
    if (!stats) return state.SkipWithError(stats.error().text.c_str());
    sum.gte_ms += stats->gte_ms;
    sum.ot_ms += stats->ot_ms;
    sum.raster_ms += stats->raster_ms;
    sum.primitives = stats->primitives;
    sum.faces = stats->faces;
  }
  const auto n = static_cast<double>(state.iterations());
  state.counters["gte_ms"] = sum.gte_ms / n;
  state.counters["ot_ms"] = sum.ot_ms / n;
  state.counters["raster_ms"] = sum.raster_ms / n;
  state.counters["faces"] = sum.faces;
  state.counters["drawn"] = sum.primitives;
}

void add(const std::string& name, const scene::Scene& scene) {
  for (const auto visibility : {scene::Visibility::ot, scene::Visibility::zbuffer}) {
    scene::Knobs knobs;
    knobs.visibility = visibility;
    const std::string full = name + (visibility == scene::Visibility::ot ? "/ot" : "/zbuffer");
    benchmark::RegisterBenchmark(full.c_str(),
                                 [scene, knobs](benchmark::State& state) { frames(state, scene, knobs); })
        ->Unit(benchmark::kMillisecond)
        ->MinTime(0.3);
  }
}

}  // namespace

int main(int count, char** arguments) {
  for (const auto& entry : demos::all()) add(std::string(entry.name), demos::make(entry));
  add("torus of 69,960 faces", torus());
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
