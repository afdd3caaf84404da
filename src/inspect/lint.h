#pragma once
// What is wrong with a list before anything is drawn, and why a draw left no pixel.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gpu/trace.h"
#include "ot/main_ram.h"

namespace inspect {

struct LintItem {
  std::string kind;  ///< "linked-twice", "bucket-range", ...: one word, stable
  std::string at;    ///< "123000h", "3:17" (gpu/number.h), or empty
  std::string text;  ///< one clause for people
  bool operator==(const LintItem&) const = default;
};

/// Where an ordering table lies in RAM.
struct TableRange {
  std::uint32_t address = 0, length = 0;
};

/// Lints a list in RAM without drawing it:
///   loop, outside-ram, payload-past-end   the walk does not end well
///   linked-twice                          two tags link to one (a packet inserted twice)
///   unreachable-bucket                    entries of the table that the list skips
///   overlap                               packets, or a packet and the table, share words
///   bucket-range                          a packet hangs on a word beside the table: inserted below 0, or at
///   or
///                                         above the length (programs that compare with > where >= is needed)
/// Without a table the last two kinds that need one read "not available".
std::vector<LintItem> lint_list(const ot::MainRam& ram, std::uint32_t head,
                                const std::optional<TableRange>& table);

/// What is wrong with a bucket number that is about to be inserted; nothing if it is below `length`.
std::optional<LintItem> lint_bucket(std::int64_t bucket, std::uint32_t length);

/// How many of a program's primitives ask for a bucket that a table has not got.
struct BucketFaults {
  std::uint64_t below = 0, at = 0, above = 0;  ///< 0; the length; beyond the length
};

/// One item per kind of fault that occurs. For programs that limit the number; where one does not, the list
/// in RAM shows the packet beside the table (lint_list).
std::vector<LintItem> lint_buckets(const BucketFaults& faults, std::uint32_t length);

/// Draws that wrote no pixel, one item per reason with their number and the first of them: size-rule,
/// no-area, outside-area, not-seen (transparent texels, masked or behind).
std::vector<LintItem> lint_draws(const gpu::Trace& trace, std::uint64_t frame);

/// The same of one draw that wrote none, as a clause.
std::string why_nothing(const gpu::Trace& trace, std::uint32_t draw);

}  // namespace inspect
