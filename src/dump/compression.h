#pragma once
// Compressed files, as people share dumps: zstd and xz.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
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

/// Takes the next bytes of what a file holds; false: no more are wanted.
using UnpackedSink = std::function<bool(std::span<const std::byte>)>;

/// Unpacks what comes piece by piece, as the first bytes say: frames or streams one behind the other joined,
/// and bytes that are not packed as they are.
class Unpacker {
 public:
  explicit Unpacker(UnpackedSink sink, std::uint64_t limit = max_unpacked_bytes);
  ~Unpacker();
  Unpacker(const Unpacker&) = delete;
  Unpacker& operator=(const Unpacker&) = delete;

  /// The next bytes of the file. False: something is wrong, or the sink wants no more.
  bool feed(std::span<const std::byte> bytes);
  /// The end of the file. The value and the error are those of unpack_to.
  Parsed<std::uint64_t> finish();
  /// Known once six bytes have come.
  [[nodiscard]] Compression compression() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Hands the contents to `sink` piece by piece, frames or streams one behind the other joined. The value: how
/// many bytes. Error: damaged, cut short or more than `limit` bytes; the offset is that of the byte of the
/// compressed file where it was noticed.
Parsed<std::uint64_t> unpack_to(std::span<const std::byte> file, const UnpackedSink& sink,
                                std::uint64_t limit = max_unpacked_bytes);

/// The whole contents in memory.
Parsed<std::vector<std::byte>> unpack(std::span<const std::byte> file,
                                      std::uint64_t limit = max_unpacked_bytes);

/// Packs what comes piece by piece into one frame or stream at the library's usual level.
class Packer {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  Packer(Compression compression, Sink sink);
  ~Packer();
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;

  void add(std::span<const std::byte> bytes);
  /// The end: what is still held goes to the sink.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The same for bytes that are in memory already.
std::vector<std::byte> pack(std::span<const std::byte> bytes, Compression compression);

}  // namespace dump
