// Any bytes as a texture file. The limit keeps one input from taking seconds; the
// header is judged before the pixels.

#include <cstddef>
#include <cstdint>

#include "load/pictures.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)load::decode_picture({reinterpret_cast<const char*>(data), size}, std::size_t{1} << 20);
  return 0;
}
