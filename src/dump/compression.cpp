#include "dump/compression.h"

#include <lzma.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

namespace dump {
namespace {

using Bytes = std::vector<std::byte>;
using Unpacked = Parsed<Bytes>;

constexpr std::size_t chunk_bytes = std::size_t{1} << 16;
constexpr std::uint64_t lzma_memory = std::uint64_t{1} << 28;  // xz -9 needs 65 MiB
constexpr int zstd_window_log = 27;  // what the zstd tool accepts without being asked

bool begins_with(std::span<const std::byte> file, std::span<const unsigned char> magic) {
  return file.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), file.begin(),
                    [](unsigned char m, std::byte b) { return std::byte{m} == b; });
}

Unpacked too_large(std::uint64_t at, std::uint64_t limit) {
  return Unpacked::error(at, "unpacks to more than " + std::to_string(limit) + " bytes");
}

/// Appends a chunk; false: the limit is passed.
bool append(Bytes& out, std::span<const std::byte> chunk, std::uint64_t limit) {
  if (chunk.size() > limit - out.size()) return false;
  out.insert(out.end(), chunk.begin(), chunk.end());
  return true;
}

Unpacked unpack_zstd(std::span<const std::byte> file, std::uint64_t limit) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, zstd_window_log);
  Bytes out;
  Bytes chunk(chunk_bytes);
  ZSTD_inBuffer in{file.data(), file.size(), 0};
  std::size_t left = 0;  // 0: a frame is complete
  bool full = false;     // the last call filled the chunk: there may be more without more input
  while (in.pos < in.size || (full && left != 0)) {
    ZSTD_outBuffer to{chunk.data(), chunk.size(), 0};
    left = ZSTD_decompressStream(context.get(), &to, &in);
    if (ZSTD_isError(left) != 0) {
      return Unpacked::error(in.pos, std::string("damaged zstd data: ") + ZSTD_getErrorName(left));
    }
    if (!append(out, std::span(chunk).first(to.pos), limit)) return too_large(in.pos, limit);
    full = to.pos == to.size;
  }
  if (left != 0) return Unpacked::error(file.size(), "the zstd data is cut short");
  return {std::move(out), {}, 0};
}

Unpacked unpack_xz(std::span<const std::byte> file, std::uint64_t limit) {
  lzma_stream stream = LZMA_STREAM_INIT;
  const std::unique_ptr<lzma_stream, decltype(&lzma_end)> guard(&stream, &lzma_end);
  if (lzma_stream_decoder(&stream, lzma_memory, LZMA_CONCATENATED) != LZMA_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<const std::uint8_t*>(file.data());
  stream.avail_in = file.size();
  Bytes out;
  Bytes chunk(chunk_bytes);
  for (;;) {
    stream.next_out = reinterpret_cast<std::uint8_t*>(chunk.data());
    stream.avail_out = chunk.size();
    const auto status = lzma_code(&stream, LZMA_FINISH);
    if (!append(out, std::span(chunk).first(chunk.size() - stream.avail_out), limit)) {
      return too_large(stream.total_in, limit);
    }
    if (status == LZMA_STREAM_END) return {std::move(out), {}, 0};
    if (status == LZMA_BUF_ERROR) return Unpacked::error(file.size(), "the xz data is cut short");
    if (status == LZMA_MEMLIMIT_ERROR)
      return Unpacked::error(stream.total_in, "the xz data needs over 256 MiB to unpack");
    if (status != LZMA_OK) return Unpacked::error(stream.total_in, "damaged xz data");
  }
}

}  // namespace

Compression compression_of(std::span<const std::byte> file) {
  static constexpr std::array<unsigned char, 4> zstd{0x28, 0xb5, 0x2f, 0xfd};
  static constexpr std::array<unsigned char, 6> xz{0xfd, '7', 'z', 'X', 'Z', 0x00};
  if (begins_with(file, zstd)) return Compression::zstd;
  return begins_with(file, xz) ? Compression::xz : Compression::none;
}

Unpacked unpack(std::span<const std::byte> file, std::uint64_t limit) {
  switch (compression_of(file)) {
    case Compression::zstd:
      return unpack_zstd(file, limit);
    case Compression::xz:
      return unpack_xz(file, limit);
    case Compression::none:
      break;
  }
  return {Bytes(file.begin(), file.end()), {}, 0};
}

Bytes pack(std::span<const std::byte> bytes, Compression compression) {
  if (compression == Compression::zstd) {
    Bytes out(ZSTD_compressBound(bytes.size()));
    const auto size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), ZSTD_CLEVEL_DEFAULT);
    if (ZSTD_isError(size) != 0) throw std::bad_alloc();  // the buffer is large enough: nothing else can fail
    out.resize(size);
    return out;
  }
  if (compression == Compression::xz) {
    Bytes out(lzma_stream_buffer_bound(bytes.size()));
    std::size_t size = 0;
    const auto status = lzma_easy_buffer_encode(
        LZMA_PRESET_DEFAULT, LZMA_CHECK_CRC64, nullptr, reinterpret_cast<const std::uint8_t*>(bytes.data()),
        bytes.size(), reinterpret_cast<std::uint8_t*>(out.data()), &size, out.size());
    if (status != LZMA_OK) throw std::bad_alloc();
    out.resize(size);
    return out;
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace dump
