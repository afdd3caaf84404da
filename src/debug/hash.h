#pragma once
// A number that stands for bytes. The same on every machine, so that it can be kept in a file; not for
// anybody who means harm.

#include <cstddef>
#include <cstdint>
#include <span>

namespace debug {

/// Four sums side by side, each fed 8 bytes at a time (little-endian), multiplied by an odd constant and
/// turned; then mixed with the length. [ours]
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> bytes);
/// Of halfwords, as if each were two bytes, the low one first.
[[nodiscard]] std::uint64_t hash_of(std::span<const std::uint16_t> pixels);

}  // namespace debug
