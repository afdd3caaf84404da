#pragma once
// Ordering tables in a list of which nobody said where its tables are: an emulator's, or a saved RAM image's.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ot/links.h"

namespace ot {

/// A run of empty tags in list order, each one word below (as OTC clears a table) or above the one before.
struct FoundTable {
  std::uint32_t address = 0;  ///< the lowest entry, as it is linked
  std::uint32_t length = 0;   ///< entries
  bool operator==(const FoundTable&) const = default;
};

/// Fewer empty tags in a row are taken for stray ones.
inline constexpr std::uint32_t least_table = 4;

/// The tables among the first `nodes` tags of a list, which are good (validate()), in list order. Packets
/// between two entries do not matter. An entry that a packet was written over ends its table.
std::vector<FoundTable> find_tables(std::span<const std::uint32_t> memory, std::uint32_t first,
                                    std::uint32_t nodes);

/// Number of the entry at `tag`, from 0 at the lowest address, in the table that it belongs to.
std::optional<std::uint32_t> bucket_of(std::span<const FoundTable> tables, std::uint32_t tag);

}  // namespace ot
