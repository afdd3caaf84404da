#pragma once
// Compressed files, as people share dumps: zstd and xz.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dump/parsed.h"

namespace dump {

enum class Compression : std::uint8_t { none, zstd, xz };

/// Told by the first bytes.
Compression compression_of(std::span<const std::byte> file);

/// What a file unpacks to at most, unless the caller says otherwise: 1 GiB, some hours of one game's frames.
/// A few bytes can claim to be more than any memory, so there has to be a bound.
inline constexpr std::uint64_t max_unpacked_bytes = std::uint64_t{1} << 30;

/// The whole contents, frames or streams one behind the other joined. Error: damaged, cut short or more than
/// `limit` bytes; the offset is that of the byte of the compressed file where it was noticed.
Parsed<std::vector<std::byte>> unpack(std::span<const std::byte> file,
                                      std::uint64_t limit = max_unpacked_bytes);

/// One frame or stream at the library's usual level.
std::vector<std::byte> pack(std::span<const std::byte> bytes, Compression compression);

}  // namespace dump
