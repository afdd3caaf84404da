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
using Unpacked = Parsed<std::uint64_t>;

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

/// Counts what goes to a sink.
class Counted {
 public:
  Counted(const UnpackedSink& sink, std::uint64_t limit) : sink_(sink), limit_(limit) {}
  /// False: the limit is passed.
  bool take(std::span<const std::byte> chunk) {
    if (chunk.size() > limit_ - count) return false;
    count += chunk.size();
    if (!chunk.empty()) is_wanted = sink_(chunk);
    return true;
  }
  std::uint64_t count = 0;
  bool is_wanted = true;

 private:
  const UnpackedSink& sink_;
  std::uint64_t limit_;
};

Unpacked unpack_zstd(std::span<const std::byte> file, const UnpackedSink& sink, std::uint64_t limit) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, zstd_window_log);
  Counted out(sink, limit);
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
    if (!out.take(std::span(chunk).first(to.pos))) return too_large(in.pos, limit);
    if (!out.is_wanted) return {out.count, {}, 0};
    full = to.pos == to.size;
  }
  if (left != 0) return Unpacked::error(file.size(), "the zstd data is cut short");
  return {out.count, {}, 0};
}

Unpacked unpack_xz(std::span<const std::byte> file, const UnpackedSink& sink, std::uint64_t limit) {
  lzma_stream stream = LZMA_STREAM_INIT;
  const std::unique_ptr<lzma_stream, decltype(&lzma_end)> guard(&stream, &lzma_end);
  if (lzma_stream_decoder(&stream, lzma_memory, LZMA_CONCATENATED) != LZMA_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<const std::uint8_t*>(file.data());
  stream.avail_in = file.size();
  Counted out(sink, limit);
  Bytes chunk(chunk_bytes);
  for (;;) {
    stream.next_out = reinterpret_cast<std::uint8_t*>(chunk.data());
    stream.avail_out = chunk.size();
    const auto status = lzma_code(&stream, LZMA_FINISH);
    if (!out.take(std::span(chunk).first(chunk.size() - stream.avail_out))) {
      return too_large(stream.total_in, limit);
    }
    if (status == LZMA_STREAM_END || !out.is_wanted) return {out.count, {}, 0};
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

Unpacked unpack_to(std::span<const std::byte> file, const UnpackedSink& sink, std::uint64_t limit) {
  switch (compression_of(file)) {
    case Compression::zstd:
      return unpack_zstd(file, sink, limit);
    case Compression::xz:
      return unpack_xz(file, sink, limit);
    case Compression::none:
      break;
  }
  if (file.size() > limit) return too_large(limit, limit);
  (void)sink(file);
  return {file.size(), {}, 0};
}

Parsed<Bytes> unpack(std::span<const std::byte> file, std::uint64_t limit) {
  Bytes out;
  const auto done = unpack_to(
      file,
      [&out](std::span<const std::byte> chunk) {
        out.insert(out.end(), chunk.begin(), chunk.end());
        return true;
      },
      limit);
  if (!done) return Parsed<Bytes>::error(done.offset, done.message);
  return {std::move(out), {}, 0};
}

struct Packer::State {
  explicit State(Sink to) : sink(std::move(to)) {}
  ~State() { lzma_end(&xz); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void run_zstd(std::span<const std::byte> bytes, ZSTD_EndDirective directive) {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (bool more = true; more;) {
      ZSTD_outBuffer out{chunk.data(), chunk.size(), 0};
      const auto left = ZSTD_compressStream2(zstd.get(), &out, &in, directive);
      if (ZSTD_isError(left) != 0) throw std::bad_alloc();  // nothing else can fail
      if (out.pos != 0) sink(std::span(chunk).first(out.pos));
      more = directive == ZSTD_e_end ? left != 0 : in.pos < in.size;
    }
  }
  void run_xz(std::span<const std::byte> bytes, lzma_action action) {
    xz.next_in = reinterpret_cast<const std::uint8_t*>(bytes.data());
    xz.avail_in = bytes.size();
    for (bool more = true; more;) {
      xz.next_out = reinterpret_cast<std::uint8_t*>(chunk.data());
      xz.avail_out = chunk.size();
      const auto status = lzma_code(&xz, action);
      if (status != LZMA_OK && status != LZMA_STREAM_END) throw std::bad_alloc();
      if (xz.avail_out != chunk.size()) sink(std::span(chunk).first(chunk.size() - xz.avail_out));
      more = action == LZMA_FINISH ? status != LZMA_STREAM_END : xz.avail_in != 0;
    }
  }

  Sink sink;
  Compression compression = Compression::none;
  Bytes chunk = Bytes(chunk_bytes);
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{nullptr, &ZSTD_freeCCtx};
  lzma_stream xz = LZMA_STREAM_INIT;
};

Packer::Packer(Compression compression, Sink sink) : state_(std::make_unique<State>(std::move(sink))) {
  state_->compression = compression;
  if (compression == Compression::zstd) {
    state_->zstd.reset(ZSTD_createCCtx());
    if (!state_->zstd) throw std::bad_alloc();
  }
  if (compression == Compression::xz &&
      lzma_easy_encoder(&state_->xz, LZMA_PRESET_DEFAULT, LZMA_CHECK_CRC64) != LZMA_OK) {
    throw std::bad_alloc();
  }
}

Packer::~Packer() = default;

void Packer::add(std::span<const std::byte> bytes) {
  switch (state_->compression) {
    case Compression::zstd:
      return state_->run_zstd(bytes, ZSTD_e_continue);
    case Compression::xz:
      return state_->run_xz(bytes, LZMA_RUN);
    case Compression::none:
      return state_->sink(bytes);
  }
}

void Packer::finish() {
  if (state_->compression == Compression::zstd) state_->run_zstd({}, ZSTD_e_end);
  if (state_->compression == Compression::xz) state_->run_xz({}, LZMA_FINISH);
}

Bytes pack(std::span<const std::byte> bytes, Compression compression) {
  Bytes out;
  Packer packer(compression, [&out](std::span<const std::byte> chunk) {
    out.insert(out.end(), chunk.begin(), chunk.end());
  });
  packer.add(bytes);
  packer.finish();
  return out;
}

}  // namespace dump
