#include "inspect/lint.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "gpu/columns.h"
#include "gpu/number.h"
#include "ot/describe.h"
#include "ot/gp0.h"
#include "ot/walker.h"

namespace inspect {
namespace {

struct Node {
  std::uint32_t address, words;  // words: tag and payload
};

class ListLinter {
 public:
  ListLinter(const ot::MainRam& ram, const std::optional<TableRange>& table) : ram_(ram), table_(table) {}

  std::vector<LintItem> run(std::uint32_t head) {
    const ot::WalkResult walk = ot::validate(ram_, head);
    std::uint32_t address = head;
    for (std::uint32_t n = 0; n < walk.nodes; ++n) {
      visit(address);
      address = ot::tag::Next::get(ram_.read(address));
    }
    walk_end(walk);
    if (table_) table_entries();
    linked_twice();
    overlaps();
    if (table_) {
      beside_table();
    } else {
      add("buckets", "", "not available: no ordering table is known");
    }
    return std::move(items_);
  }

 private:
  void add(const char* kind, std::string at, std::string text) {
    items_.push_back({kind, std::move(at), std::move(text)});
  }
  [[nodiscard]] std::uint32_t physical(std::uint32_t link) const { return link & (ram_.size_bytes() - 4); }
  [[nodiscard]] bool is_entry(std::uint32_t address) const {
    return table_ && address >= table_->address && address - table_->address < table_->length * 4;
  }

  void visit(std::uint32_t link) {
    const std::uint32_t tag = ram_.read(link);
    nodes_.push_back({physical(link), 1 + ot::tag::Length::get(tag)});
    visited_.insert(physical(link));
    note_link(link);
  }
  void note_link(std::uint32_t from) {
    const std::uint32_t next = ot::tag::Next::get(ram_.read(from));
    if ((next & 0x800000) == 0) sources_[physical(next)].insert(physical(from));
  }

  void walk_end(const ot::WalkResult& walk) {
    if (walk) return;
    constexpr std::array kinds{"", "loop", "outside-ram", "payload-past-end"};
    add(kinds[static_cast<std::size_t>(walk.end)], ot::address_text(walk.bad_tag), walk.message());
  }

  void table_entries() {
    std::uint32_t skipped = 0, first = 0;
    for (std::uint32_t k = 0; k < table_->length; ++k) {
      const std::uint32_t address = table_->address + 4 * k;
      if (visited_.contains(physical(address))) continue;
      note_link(address);
      nodes_.push_back({physical(address), 1});
      if (skipped++ == 0) first = k;
    }
    if (skipped == 0) return;
    add("unreachable-bucket", ot::address_text(table_->address + 4 * first),
        std::to_string(skipped) + " of " + std::to_string(table_->length) +
            " buckets are not in the list, the first is " + std::to_string(first));
  }

  void linked_twice() {
    for (const auto& [target, from] : sources_) {
      if (from.size() < 2) continue;
      add("linked-twice", ot::address_text(target),
          "tags " + ot::address_text(*from.begin()) + " and " + ot::address_text(*from.rbegin()) +
              " both link to it");
    }
  }

  void overlaps() {
    std::sort(nodes_.begin(), nodes_.end(),
              [](const Node& a, const Node& b) { return a.address < b.address; });
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      const Node &low = nodes_[i - 1], &high = nodes_[i];
      const std::uint32_t end = low.address + 4 * low.words;
      if (low.address != high.address && end > high.address) {
        add("overlap", ot::address_text(high.address),
            "the packet at " + ot::address_text(low.address) + " reaches to " + ot::address_text(end - 4));
      }
    }
  }

  // A stray insertion made the word beside the table a tag: no payload, and a link to a
  // packet nobody else links to.
  void beside_table() {
    for (const int beside : {-4, -3, -2, -1, 0, 1, 2, 3}) {
      const std::int64_t bucket = beside < 0 ? beside : std::int64_t{table_->length} + beside;
      const std::int64_t address = std::int64_t{table_->address} + 4 * bucket;
      if (address < 0 || address >= ram_.size_bytes()) continue;
      const std::uint32_t word = ram_.read(static_cast<std::uint32_t>(address));
      const std::uint32_t packet = ot::tag::Next::get(word);
      if (ot::tag::Length::get(word) != 0 || packet == 0 || packet % 4 != 0 || packet >= ram_.size_bytes())
        continue;
      if (is_entry(packet) || visited_.contains(packet) ||
          visited_.contains(static_cast<std::uint32_t>(address)))
        continue;
      const std::uint32_t length = ot::tag::Length::get(ram_.read(packet)),
                          opcode = ram_.read(packet + 4) >> 24;
      if (length == 0 || length > 16 || opcode < 0x20 || opcode > 0x7f) continue;
      if (auto item = lint_bucket(bucket, table_->length)) {
        item->at = ot::address_text(static_cast<std::uint32_t>(address));
        item->text += "; the packet at " + ot::address_text(packet) + " hangs there and is never drawn";
        items_.push_back(std::move(*item));
      }
    }
  }

  const ot::MainRam& ram_;
  std::optional<TableRange> table_;
  std::vector<Node> nodes_;
  std::set<std::uint32_t> visited_;
  std::map<std::uint32_t, std::set<std::uint32_t>> sources_;  // tag -> tags that link to it
  std::vector<LintItem> items_;
};

enum class Unseen : std::uint8_t { size_rule, no_area, outside_area, not_seen };
struct UnseenText {
  const char *kind, *text;
};
constexpr std::array<UnseenText, 4> unseen_texts{{{"size-rule", "more than 1023 columns or 511 rows large"},
                                                  {"no-area", "no pixel's sample point inside"},
                                                  {"outside-area", "outside the drawing area"},
                                                  {"not-seen", "every pixel transparent, masked or behind"}}};

// Why a polygon without a written pixel has none.
Unseen why_unseen(const gpu::Primitive& p) {
  bool too_large = true, empty = true, outside = true;
  for (std::size_t half = 0; half < (p.is_quad() ? 2 : 1); ++half) {
    gpu::Corners corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = {p.vertices[half + i].x, p.vertices[half + i].y};
    too_large = too_large && gpu::is_too_large(corners);
    gpu::for_each_covered_row(corners, [&](int y, int left, int right) {
      empty = false;
      if (y >= p.state.top() && y <= p.state.bottom() && right > p.state.left() && left <= p.state.right())
        outside = false;
    });
  }
  if (too_large) return Unseen::size_rule;
  if (empty) return Unseen::no_area;
  return outside ? Unseen::outside_area : Unseen::not_seen;
}

}  // namespace

std::vector<LintItem> lint_list(const ot::MainRam& ram, std::uint32_t head,
                                const std::optional<TableRange>& table) {
  return ListLinter(ram, table).run(head);
}

std::optional<LintItem> lint_bucket(std::int64_t bucket, std::uint32_t length) {
  if (bucket >= 0 && bucket < length) return std::nullopt;
  const std::string number = "bucket " + std::to_string(bucket),
                    of = " of a table of " + std::to_string(length);
  if (bucket < 0) return LintItem{"bucket-range", "", number + " is below 0" + of};
  if (bucket == length) {
    return LintItem{"bucket-range", "", number + " is the length" + of + " (compared with > instead of >=?)"};
  }
  return LintItem{"bucket-range", "", number + " is above the length" + of};
}

std::vector<LintItem> lint_buckets(const BucketFaults& faults, std::uint32_t length) {
  std::vector<LintItem> items;
  const std::string last = std::to_string(std::max(length, 1U) - 1);
  const auto note = [&](std::uint64_t count, const std::string& at, const char* where,
                        const std::string& instead) {
    if (count == 0) return;
    items.push_back({"bucket-range", "bucket " + at,
                     std::to_string(count) + (count == 1 ? " primitive asks" : " primitives ask") +
                         " for a bucket " + where + " of a table of " + std::to_string(length) +
                         "; drawn in bucket " + instead});
  };
  const std::string size = std::to_string(length);
  note(faults.below, "< 0", "below 0", "0");
  note(faults.at, "= " + size, "at the length",
       last + " (compared with > instead of >=, it would be written beside the table)");
  note(faults.above, "> " + size, "above the length", last);
  return items;
}

std::vector<LintItem> lint_draws(const gpu::Trace& trace, std::uint64_t frame) {
  std::array<std::uint32_t, unseen_texts.size()> counts{}, first{};
  for (std::uint32_t draw = 0; draw < trace.draws.size(); ++draw) {
    if (trace.written[draw] != 0 || trace.draws[draw].kind != gpu::Kind::polygon) continue;
    const auto reason = static_cast<std::size_t>(why_unseen(trace.draws[draw]));
    if (counts[reason]++ == 0) first[reason] = draw;
  }
  std::vector<LintItem> items;
  for (std::size_t reason = 0; reason < counts.size(); ++reason) {
    if (counts[reason] == 0) continue;
    items.push_back({unseen_texts[reason].kind,
                     gpu::to_text(gpu::number_of(frame, trace.draws[first[reason]])),
                     std::to_string(counts[reason]) + (counts[reason] == 1 ? " polygon" : " polygons") +
                         " drew nothing: " + unseen_texts[reason].text});
  }
  return items;
}

std::string why_nothing(const gpu::Trace& trace, std::uint32_t draw) {
  if (trace.draws[draw].kind != gpu::Kind::polygon) return "wrote no pixel";
  const auto& reason = unseen_texts[static_cast<std::size_t>(why_unseen(trace.draws[draw]))];
  return std::string(reason.kind) + ": " + reason.text;
}

}  // namespace inspect
