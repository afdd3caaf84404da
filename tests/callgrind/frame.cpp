// A frame of the crates, from meshes to pixels.

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "demos/demos.h"
#include "gpu/gpu.h"
#include "ot/main_ram.h"
#include "scene/pipeline.h"
#if WITH_EXTRA
#include "inspect/report.h"
#endif

namespace {

struct Console {
  scene::Knobs knobs;
  scene::FrameBuilder builder{demos::make(*demos::find("crates")), knobs};
  ot::MainRam ram{ot::RamSize::mib8};
  gpu::Gpu gpu;

  void draw(std::uint32_t number) {
    if (!scene::render_frame(builder, scene::frame_time(number), knobs, ram, gpu)) std::abort();
  }
};

Console* console = nullptr;

}  // namespace

extern "C" [[gnu::noinline]] void measured() { console->draw(31); }

int main([[maybe_unused]] int count, char** /*arguments*/) {
  Console here;
  console = &here;
  here.builder.upload(here.gpu);
  here.draw(30);  // what is set up on first use
#if WITH_EXTRA
  if (count > 1) {  // linked and used, though not now
    gpu::Trace trace;
    trace.keep_history = true;
    here.gpu.set_trace(&trace);
    here.draw(30);
    here.gpu.set_trace(nullptr);
    std::fputs(inspect::to_text(inspect::inspect(trace, {})).c_str(), stdout);
  }
#endif
  measured();
  std::printf("%u\n", here.gpu.vram().at(160, 360));
}
