#include "door/lint.h"

#include <algorithm>
#include <optional>

#include "ot/main_ram.h"
#include "ot/tables.h"
#include "ot/walker.h"

namespace door {

std::vector<inspect::LintItem> lint(std::span<const std::uint32_t> ram, std::uint32_t head) {
  ot::MainRam copy(ram.size_bytes() > static_cast<std::size_t>(ot::RamSize::mib2) ? ot::RamSize::mib8
                                                                                  : ot::RamSize::mib2);
  // A smaller RAM is mirrored into the larger one, as the bus does.
  const auto words = copy.words();
  for (std::size_t at = 0; at < words.size(); at += ram.size())
    std::ranges::copy(ram, words.begin() + static_cast<std::ptrdiff_t>(at));
  const auto tables = ot::find_tables(words, head, ot::validate(copy, head).nodes);
  const auto longest = std::ranges::max_element(tables, {}, &ot::FoundTable::length);
  std::optional<inspect::TableRange> table;
  if (longest != tables.end()) table = inspect::TableRange{longest->address, longest->length};
  return inspect::lint_list(copy, head, table);
}

}  // namespace door
