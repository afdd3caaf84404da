// Any bytes as a register vector file.

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string_view>

#include "gte/check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::ostringstream out;
  (void)gte::check_csv({reinterpret_cast<const char*>(data), size}, out);
  return 0;
}
