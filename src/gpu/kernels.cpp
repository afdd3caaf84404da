// Which of the dispatch targets draws.

#include "gpu/kernels.h"

#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "gpu/kernel_targets.h"

namespace gpu {

namespace {

/// `table` and `operations` are one step away: small rectangles are drawn in the time of a few loads.
struct Target {
  Target(std::string_view its_name, const TargetKernels* its_kernels)
      : table(its_kernels != nullptr ? &its_kernels->table : nullptr),
        operations(its_kernels != nullptr ? &its_kernels->operations : nullptr),
        name(its_name),
        kernels(its_kernels) {}

  const KernelTable* table;
  const Operations* operations;
  std::string_view name;
  const TargetKernels* kernels;
};

/// Best first.
const std::array<Target, 4>& targets() {
  static const std::array<Target, 4> all{Target{"avx512", avx512_kernels()}, Target{"avx2", avx2_kernels()},
                                         Target{"sse4", sse4_kernels()}, Target{"scalar", scalar_kernels()}};
  return all;
}

bool is_supported(const Target& target) {
  if (target.kernels == nullptr) return false;
  return target.kernels == scalar_kernels() || (hwy::SupportedTargets() & target.kernels->id) != 0;
}

/// Read for every primitive, set when first asked for. Two threads that ask at once find the same one, and
/// what it points to is constant, so a relaxed load, which costs what a plain one does, is enough.
std::atomic<const Target*> chosen = nullptr;

const Target& best_target() {
  const Target* best = std::find_if(targets().begin(), targets().end(), is_supported);
  chosen.store(best, std::memory_order_relaxed);
  return *best;
}

const Target& target() {
  if (const Target* known = chosen.load(std::memory_order_relaxed)) return *known;
  return best_target();
}

}  // namespace

const KernelTable& kernels() { return *target().table; }
const Operations& operations() { return *target().operations; }
std::string_view target_name() { return target().name; }

std::vector<std::string_view> target_names() {
  std::vector<std::string_view> names;
  for (const Target& candidate : targets()) {
    if (is_supported(candidate)) names.push_back(candidate.name);
  }
  return names;
}

bool use_target(std::string_view name) {
  for (const Target& candidate : targets()) {
    if (!is_supported(candidate) || name != candidate.name) continue;
    chosen.store(&candidate, std::memory_order_relaxed);
    return true;
  }
  return false;
}

}  // namespace gpu
