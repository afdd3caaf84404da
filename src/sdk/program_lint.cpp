#include "sdk/program_lint.h"

#include <algorithm>

#include "ot/gp0.h"
#include "sdk/call_site.h"

namespace sdk {
namespace {

/// How far beside a table a word is still taken for a missed entry of it.
constexpr std::uint32_t margin_bytes = 256;

std::string entries(std::int64_t entry, std::uint32_t address, std::uint32_t length) {
  return "entry " + std::to_string(entry) + " of the table at " + hex(address) + ", which has " +
         std::to_string(length);
}

}  // namespace

void ProgramLint::note(std::string_view kind, CallSite site, std::string text) {
  const auto [at, is_new] = index_.try_emplace({std::string(kind), site}, findings_.size());
  if (is_new) findings_.push_back({std::string(kind), site, std::move(text), frame, 0});
  ++findings_[at->second].times;
}

std::string to_text(const Finding& finding) {
  auto text = finding.text + " (frame " + std::to_string(finding.frame);
  if (finding.times > 1) text += ", " + std::to_string(finding.times) + " times";
  return text + ")";
}

std::optional<std::size_t> ProgramLint::table_of(std::uint32_t entry) const {
  const auto holds = [entry](const Table& t) { return entry >= t.address && entry < t.end(); };
  if (last_table_ < tables_.size() && holds(tables_[last_table_])) return last_table_;
  const auto at = std::find_if(tables_.begin(), tables_.end(), holds);
  if (at == tables_.end()) return std::nullopt;
  return last_table_ = static_cast<std::size_t>(at - tables_.begin());
}

std::optional<ProgramLint::Entry> ProgramLint::entry(std::uint32_t address) const {
  const auto at = table_of(address);
  if (!at) return std::nullopt;
  const auto& table = tables_[*at];
  return Entry{table.address, table.length, (address - table.address) / 4};
}

CallSite ProgramLint::site_of(std::uint32_t packet) const {
  const auto at = sites_.find(packet);
  return at == sites_.end() ? nullptr : at->second;
}

void ProgramLint::clear_table(std::uint32_t address, std::uint32_t length, CallSite site) {
  // A table of another size at the same place is another table.
  const auto end = address + 4 * length;
  const auto overlaps = [&](const Table& t) {
    return t.address < end && address < t.end() && (t.address != address || t.length != length);
  };
  for (auto& table : tables_) {
    if (overlaps(table)) table = {table.address, 0, table.clears + 1, 0, 0, false, {}};
  }
  auto at = std::find_if(tables_.begin(), tables_.end(),
                         [&](const Table& t) { return t.address == address && t.length == length; });
  if (at == tables_.end()) at = tables_.insert(at, Table{address, length, 0, 0, 0, false, {}});
  if (at->is_being_drawn) {
    note("written-while-drawn", site,
         "the table at " + hex(address) + " is cleared after DrawOTag, with no DrawSync between");
  }
  if (at->linked > at->drawn) {
    note("cleared-late", site,
         "the table at " + hex(address) + " is cleared with " + std::to_string(at->linked - at->drawn) +
             " packets that were not drawn");
  }
  *at = {address, length, at->clears + 1, 0, 0, false, {}};
}

void ProgramLint::check_range(std::uint32_t entry, CallSite site) {
  for (const auto& t : tables_) {
    if (t.length == 0) continue;
    const bool is_behind = entry >= t.end() && entry < t.end() + margin_bytes;
    const bool is_before = entry < t.address && entry + margin_bytes >= t.address;
    // A packet may be a list of its own to which others are put.
    if (!(is_behind || is_before) || (entry != t.end() && places_.contains(entry))) continue;
    const auto number = (static_cast<std::int64_t>(entry) - t.address) / 4;
    note("bucket-range", site, entries(number, t.address, t.length));
    return;
  }
}

void ProgramLint::check_overrun(std::uint32_t begin, std::uint32_t end, CallSite site) {
  for (const auto& t : tables_) {
    if (begin < t.end() && t.address < end && t.length != 0) {
      note("overrun", site, "the packet at " + hex(begin) + " lies over the table at " + hex(t.address));
    }
  }
  // The environment that begins last before the packet's end.
  const auto at = environments_.lower_bound(end);
  if (at != environments_.begin() && std::prev(at)->second > begin) {
    note("overrun", site,
         "the packet at " + hex(begin) + " lies over the environment at " + hex(std::prev(at)->first));
  }
}

void ProgramLint::check_place(std::uint32_t packet, std::size_t table, CallSite site) {
  const auto at = places_.find(packet);
  if (at == places_.end()) return;
  const Table& other = tables_[at->second.table];
  if (at->second.clears != other.clears) return;
  if (at->second.table == table) {
    note("linked-twice", site, "the packet at " + hex(packet) + " is already in the table");
  } else if (other.is_being_drawn || other.linked > other.drawn) {
    note("two-tables", site,
         "the packet at " + hex(packet) + " still hangs in the table at " + hex(other.address));
  }
}

void ProgramLint::link(std::uint32_t entry, std::uint32_t first, std::uint32_t last, std::uint32_t bytes,
                       CallSite site) {
  if (entry == first || entry == last) {
    note("linked-to-itself", site, "the packet at " + hex(entry) + " is put behind itself");
  }
  if (flag_pending_) {
    note("flag-ignored", site, "a vertex overflowed (FLAG bit 31) and nobody looked");
    flag_pending_ = false;
  }
  const auto table = table_of(entry);
  // A table that is put into another one as it is.
  if (const auto nested = table_of(first); nested && nested == table_of(last) && nested != table) {
    if (table) tables_[*table].nested.push_back(*nested);
    return;
  }
  sites_[first] = site;
  check_overrun(last, last + bytes, site);
  if (!table) return check_range(entry, site);
  check_place(first, *table, site);
  auto& t = tables_[*table];
  if (t.is_being_drawn) {
    note("written-while-drawn", site,
         "a packet is put into the table at " + hex(t.address) + " after DrawOTag, with no DrawSync between");
  }
  places_[first] = {*table, t.clears};
  ++t.linked;
}

void ProgramLint::draw(std::uint32_t head, CallSite site) {
  draw_site_ = site;
  const auto table = table_of(head);
  if (!table) return;
  auto& t = tables_[*table];
  if (t.drawn != 0 && t.linked > t.drawn) {
    note("not-cleared", site,
         "the table at " + hex(t.address) + " is drawn with " + std::to_string(t.drawn) +
             " packets that were drawn before");
  }
  mark_drawn(*table, 0);
}

void ProgramLint::mark_drawn(std::size_t table, int depth) {
  constexpr int deepest = 16;  // tables in tables: a loop of them ends, too
  auto& t = tables_[table];
  t.drawn = t.linked;
  t.is_being_drawn = true;
  if (depth == deepest) return;
  for (const auto nested : t.nested) mark_drawn(nested, depth + 1);
}

void ProgramLint::sync() {
  for (auto& t : tables_) t.is_being_drawn = false;
}

void ProgramLint::environment(std::uint32_t address, std::uint32_t bytes) {
  environments_[address] = address + bytes;
}

void ProgramLint::textured(std::uint32_t page, std::uint32_t largest_u) {
  namespace draw_mode = ot::gp0::draw_mode;
  constexpr std::uint32_t width = 1024, second_megabyte = 1u << 11;
  const auto format = draw_mode::Format::get(page);
  const std::uint32_t texels_per_pixel = format == 0 ? 4 : format == 1 ? 2 : 1;
  const std::uint32_t right = draw_mode::PageX64::get(page) * 64 + largest_u / texels_per_pixel;
  if ((page & second_megabyte) != 0) {
    note("texture-page", draw_site_, "a texture page in the second megabyte of VRAM, which is not there");
  } else if (right >= width) {
    note("texture-page", draw_site_,
         "texels up to column " + std::to_string(right) +
             " of VRAM, which has 1024: they come from its left edge");
  }
}

}  // namespace sdk
