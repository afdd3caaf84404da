// Any bytes as an X3D scene; what loads is moved to three points in time.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "load/load.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto loaded = load::parse_x3d({reinterpret_cast<const char*>(data), size}, {"fuzz.x3d", "/nonexistent"});
  if (!loaded || !loaded->scene.animate) return 0;
  for (const double seconds : {0.0, 0.5, 1e9}) loaded->scene.animate(loaded->scene.world, seconds);
  return 0;
}
