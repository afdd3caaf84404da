// One flat, untextured quad without fog, drawn. The other program asks for perspective, filters, fog per
// pixel and a depth format, none of which the quad is about.

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

scene::Scene quad() {
  scene::Scene s;
  s.world.units_per_world = 300;
  scene::Mesh mesh;
  mesh.positions = {{-2, 1, -6}, {-2, -1, -6}, {2, -1, -5}, {2, 1, -5}};
  scene::Face face;
  face.vertex = {0, 1, 2, 3};
  face.colour.fill({200, 100, 50});
  mesh.faces.push_back(face);
  s.world.meshes.push_back(mesh);
  s.world.instances.push_back({0, glm::mat4(1.0F)});
  return s;
}

scene::Knobs asked() {
  scene::Knobs knobs;
#if WITH_EXTRA
  for (const auto& [knob, value] : {std::pair{"texture", "perspective"},
                                    {"filter", "mipmap-linear"},
                                    {"fog", "pixel"},
                                    {"subdivide", "error-1"},
                                    {"depth", "float"},
                                    {"depth-mapping", "linear"}}) {
    if (!scene::set_knob(knobs, knob, value)) std::abort();
  }
  cost::Subject subject(quad(), 0);
  if (cost::knobs_not_needed(subject, knobs).size() != 6) std::abort();
#endif
  return knobs;
}

struct Console {
  scene::Knobs knobs = asked();
  scene::FrameBuilder builder{quad(), knobs};
  ot::MainRam ram{ot::RamSize::mib8};
  gpu::Gpu gpu;
  scene::Frame frame;
};

Console* console = nullptr;

}  // namespace

extern "C" [[gnu::noinline]] void measured() {
  if (!scene::draw_frame(console->builder, console->frame, console->ram, console->gpu)) std::abort();
}

int main() {
  Console here;
  console = &here;
  here.builder.upload(here.gpu);
  if (!scene::render_frame(here.builder, 0, here.knobs, here.ram, here.gpu)) std::abort();  // on first use
  auto frame = here.builder.build(0, here.knobs, here.ram);
  if (!frame) std::abort();
  here.frame = *frame;
  measured();
  std::printf("%u\n", here.gpu.vram().at(160, 120));
}
