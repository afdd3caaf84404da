#include "app/commands/shown.h"

#include "display/scanout.h"

namespace app {

base::Result<base::Picture> shown_picture(const gpu::Gpu& gpu, const std::string& output) {
  const display::Area area = display::area_of(gpu.display());
  if (area.width > 0 && area.height > 0) return display::scan_out(gpu.vram().pixels(), area);
  return base::fail(
      output + ": the dump leaves an empty display area (" + std::to_string(area.width) + " x " +
          std::to_string(area.height) +
          " pixels), expected GP1(06h) and GP1(07h) with a range; otter replay --vram has the rest",
      base::Exit::failed);
}

}  // namespace app
