#include "app/target.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "gpu/kernels.h"
#include "gte/batch.h"

namespace app {

base::Result<void> choose_target() {
  const char* const wanted = std::getenv("OTTER_TARGET");
  if (wanted == nullptr) return {};
  const auto here = gpu::target_names();
  if (std::ranges::find(here, wanted) != here.end() && gte::use_batch_target(wanted)) {
    gpu::use_target(wanted);
    return {};
  }
  constexpr std::string_view words[] = {"scalar", "sse4", "avx2", "avx512"};
  std::string expected;
  for (const auto name : here) expected.append(expected.empty() ? "" : ", ").append(name);
  const bool is_known = std::ranges::find(words, wanted) != std::end(words);
  return base::fail("OTTER_TARGET=" + std::string(wanted) + ": " +
                    (is_known ? "not to be had on this processor" : "no such target") + "; expected one of " +
                    expected);
}

std::string_view target() { return gpu::target_name(); }

}  // namespace app
