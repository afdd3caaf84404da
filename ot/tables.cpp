#include "ot/tables.h"

#include <algorithm>

#include "ot/walker.h"

namespace ot {

std::vector<FoundTable> find_tables(std::span<const std::uint32_t> memory, std::uint32_t first,
                                    std::uint32_t nodes) {
  std::vector<FoundTable> tables;
  FoundTable run;
  std::uint32_t last = 0, step = 0;  // modulo 2^32
  const auto end_run = [&] {
    if (run.length >= least_table) tables.push_back(run);
  };
  send_nodes(memory, first, nodes, [&](std::uint32_t address, std::span<const std::uint32_t> payload) {
    if (!payload.empty()) return;
    const std::uint32_t moved = address - last;
    const bool is_next = moved == links::unit || moved == 0 - links::unit;
    if (run.length > 0 && is_next && (run.length == 1 || moved == step)) {
      step = moved;
      ++run.length;
      run.address = std::min(run.address, address);
    } else {
      end_run();
      run = {address, 1};
    }
    last = address;
  });
  end_run();
  return tables;
}

std::optional<std::uint32_t> bucket_of(std::span<const FoundTable> tables, std::uint32_t tag) {
  for (const FoundTable& table : tables) {
    if (tag >= table.address && tag - table.address < table.length * links::unit)
      return (tag - table.address) / links::unit;
  }
  return std::nullopt;
}

}  // namespace ot
