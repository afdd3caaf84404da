// A flat, untextured frame in list order: the least that can be asked for. The other program has asked for
// everything before - z-buffer, canvas, samples, trace, on this GPU and on another one - and turned it off
// again.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"
#if WITH_EXTRA
#include "cost/effects.h"
#endif

namespace {

/// Sixty flat triangles, turning.
scene::Scene shards() {
  scene::Scene s;
  s.name = "shards";
  s.world.units_per_world = 300;
  std::uint32_t state = 1;
  const auto next = [&state] {
    state = state * 1664525U + 1013904223U;
    return static_cast<float>(state >> 8) / 16777216.0F - 0.5F;
  };
  scene::Material material;
  material.double_sided = true;
  s.world.materials = {material};
  scene::Mesh mesh;
  for (std::uint32_t i = 0; i < 60; ++i) {
    scene::Face face;
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(next() * 16, next() * 12, -18 + next() * 8);
      face.vertex[k] = 3 * i + k;
    }
    face.colour.fill({static_cast<std::uint8_t>(50 + 3 * i), 160, 80});
    mesh.faces.push_back(face);
  }
  s.world.meshes.push_back(mesh);
  s.world.instances.push_back({0, glm::mat4(1.0F)});
  return s;
}

scene::Knobs plain() {
  scene::Knobs knobs;
  knobs.colour = scene::Colour::bits15;
  return knobs;
}

struct Console {
  scene::FrameBuilder builder{shards(), plain()};
  ot::MainRam ram{ot::RamSize::mib8};
  gpu::Gpu gpu;

  void draw(std::uint32_t number, const scene::Knobs& knobs = plain()) {
    if (!scene::render_frame(builder, scene::frame_time(number), knobs, ram, gpu)) std::abort();
  }
};

Console* console = nullptr;

#if WITH_EXTRA
scene::Knobs everything() {
  scene::Knobs knobs;
  for (const auto& [knob, value] : {std::pair{"visibility", "zbuffer"},
                                    {"position", "256"},
                                    {"texture", "perspective"},
                                    {"filter", "mipmap-linear"},
                                    {"colour", "24"},
                                    {"antialias", "msaa-4"},
                                    {"fog", "pixel"}}) {
    if (!scene::set_knob(knobs, knob, value)) std::abort();
  }
  return knobs;
}

void ask_for_everything(Console& here) {
  Console other;
  other.builder.upload(other.gpu);
  gpu::Trace trace;
  trace.keep_history = true;
  for (Console* each : {&here, &other}) {
    each->draw(28, everything());
    each->gpu.set_trace(&trace);
    each->draw(29);
    each->gpu.set_trace(nullptr);
  }
  if (!cost::find_effects(shards(), 0, everything(), 1)) std::abort();
}
#endif

}  // namespace

extern "C" [[gnu::noinline]] void measured() { console->draw(31); }

int main() {
  Console here;
  console = &here;
  here.builder.upload(here.gpu);
#if WITH_EXTRA
  ask_for_everything(here);
#endif
  here.draw(29);
  here.draw(30);  // what is set up on first use
  measured();
  std::printf("%u\n", here.gpu.vram().at(160, 360));
}
