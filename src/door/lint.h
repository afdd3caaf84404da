#pragma once
// Lint of a list in somebody else's RAM, whose table is found in the list itself.

#include <cstdint>
#include <span>
#include <vector>

#include "inspect/lint.h"

namespace door {

/// `ram`: a power of two of words, up to 8 MiB. The longest table of the list is the one that buckets are
/// checked in.
std::vector<inspect::LintItem> lint(std::span<const std::uint32_t> ram, std::uint32_t head);

}  // namespace door
