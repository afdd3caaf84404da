#pragma once
// Ordering tables in recordings: a comment packet that says on which bucket of how many the packets behind it
// hang. Whoever does not know it skips it.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dump/dump.h"

namespace dump {

/// `length` 0: on none.
struct BucketNote {
  std::uint32_t bucket = 0, length = 0;
  bool operator==(const BucketNote&) const = default;
};

/// The text of PacketType::comment: "otter.bucket 12 of 256", "otter.bucket none".
std::string to_text(const BucketNote& note);
/// Of a packet's payload; nothing: it is another comment.
std::optional<BucketNote> bucket_note(const Dump& dump, const Packet& packet);

}  // namespace dump
