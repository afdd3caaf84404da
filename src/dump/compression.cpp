#include "dump/compression.h"

#include <lzma.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <utility>

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
  [[nodiscard]] std::uint64_t limit() const { return limit_; }
  std::uint64_t count = 0;
  bool is_wanted = true;

 private:
  const UnpackedSink& sink_;
  std::uint64_t limit_;
};

/// One way of packing: takes the file piece by piece.
class Decoder {
 public:
  virtual ~Decoder() = default;
  /// All of `bytes`, unless something is wrong: then error() tells.
  virtual void take(std::span<const std::byte> bytes, Counted& out) = 0;
  /// What is wrong with the file ending here.
  virtual void end(Counted& out) = 0;
  [[nodiscard]] const std::optional<Unpacked>& error() const { return error_; }

 protected:
  void fail(std::uint64_t at, std::string text) { error_ = Unpacked::error(at, std::move(text)); }
  /// False: no more is to be done.
  bool hand_on(std::span<const std::byte> chunk, Counted& out) {
    if (!out.take(chunk)) error_ = too_large(taken_, out.limit());
    return !error_ && out.is_wanted;
  }
  std::uint64_t taken_ = 0;  // bytes of the file
  std::optional<Unpacked> error_;
};

class PlainDecoder : public Decoder {
 public:
  void take(std::span<const std::byte> bytes, Counted& out) override {
    taken_ += bytes.size();
    if (!out.take(bytes)) error_ = too_large(out.limit(), out.limit());
  }
  void end(Counted&) override {}
};

class ZstdDecoder : public Decoder {
 public:
  ZstdDecoder() {
    if (!context_) throw std::bad_alloc();
    ZSTD_DCtx_setParameter(context_.get(), ZSTD_d_windowLogMax, zstd_window_log);
  }
  void take(std::span<const std::byte> bytes, Counted& out) override {
    const std::uint64_t before = taken_;
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    // A chunk that was filled may have more behind it without more input.
    for (bool full = false; in.pos < in.size || (full && left_ != 0);) {
      ZSTD_outBuffer to{chunk_.data(), chunk_.size(), 0};
      left_ = ZSTD_decompressStream(context_.get(), &to, &in);
      taken_ = before + in.pos;
      if (ZSTD_isError(left_) != 0)
        return fail(taken_, std::string("damaged zstd data: ") + ZSTD_getErrorName(left_));
      if (!hand_on(std::span(chunk_).first(to.pos), out)) return;
      full = to.pos == to.size;
    }
  }
  void end(Counted&) override {
    if (left_ != 0) fail(taken_, "the zstd data is cut short");
  }

 private:
  std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context_{ZSTD_createDCtx(), &ZSTD_freeDCtx};
  Bytes chunk_ = Bytes(chunk_bytes);
  std::size_t left_ = 0;  // 0: a frame is complete
};

class XzDecoder : public Decoder {
 public:
  XzDecoder() {
    if (lzma_stream_decoder(&stream_, lzma_memory, LZMA_CONCATENATED) != LZMA_OK) throw std::bad_alloc();
  }
  ~XzDecoder() override { lzma_end(&stream_); }
  XzDecoder(const XzDecoder&) = delete;
  XzDecoder& operator=(const XzDecoder&) = delete;

  void take(std::span<const std::byte> bytes, Counted& out) override {
    stream_.next_in = reinterpret_cast<const std::uint8_t*>(bytes.data());
    stream_.avail_in = bytes.size();
    run(LZMA_RUN, out);
    taken_ += bytes.size();
  }
  void end(Counted& out) override {
    run(LZMA_FINISH, out);
    if (!error_ && out.is_wanted && !is_over_) fail(taken_, "the xz data is cut short");
  }

 private:
  void run(lzma_action action, Counted& out) {
    while (!is_over_) {
      stream_.next_out = reinterpret_cast<std::uint8_t*>(chunk_.data());
      stream_.avail_out = chunk_.size();
      const auto status = lzma_code(&stream_, action);
      if (!hand_on(std::span(chunk_).first(chunk_.size() - stream_.avail_out), out)) return;
      if (status == LZMA_BUF_ERROR) return;  // no more without more input
      if (status == LZMA_STREAM_END) {
        is_over_ = true;
      } else if (status == LZMA_MEMLIMIT_ERROR) {
        return fail(stream_.total_in, "the xz data needs over 256 MiB to unpack");
      } else if (status != LZMA_OK) {
        return fail(stream_.total_in, "damaged xz data");
      }
      if (action == LZMA_RUN && stream_.avail_in == 0 && stream_.avail_out != 0) return;
    }
  }

  lzma_stream stream_ = LZMA_STREAM_INIT;
  Bytes chunk_ = Bytes(chunk_bytes);
  bool is_over_ = false;
};

std::unique_ptr<Decoder> decoder_of(std::span<const std::byte> beginning) {
  switch (compression_of(beginning)) {
    case Compression::zstd:
      return std::make_unique<ZstdDecoder>();
    case Compression::xz:
      return std::make_unique<XzDecoder>();
    case Compression::none:
      break;
  }
  return std::make_unique<PlainDecoder>();
}

}  // namespace

Compression compression_of(std::span<const std::byte> file) {
  static constexpr std::array<unsigned char, 4> zstd{0x28, 0xb5, 0x2f, 0xfd};
  static constexpr std::array<unsigned char, 6> xz{0xfd, '7', 'z', 'X', 'Z', 0x00};
  if (begins_with(file, zstd)) return Compression::zstd;
  return begins_with(file, xz) ? Compression::xz : Compression::none;
}

struct Unpacker::State {
  State(UnpackedSink to, std::uint64_t limit) : sink(std::move(to)), out(sink, limit) {}
  void take(std::span<const std::byte> bytes) {
    if (!decoder) {
      // The beginning is kept until it tells what it is.
      const auto missing = std::min(bytes.size(), magic_bytes - beginning.size());
      beginning.insert(beginning.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(missing));
      bytes = bytes.subspan(missing);
      if (beginning.size() < magic_bytes) return;
      begin();
    }
    if (!decoder->error() && out.is_wanted && !bytes.empty()) decoder->take(bytes, out);
  }
  void begin() {
    decoder = decoder_of(beginning);
    decoder->take(beginning, out);
  }

  static constexpr std::size_t magic_bytes = 6;
  UnpackedSink sink;
  Counted out;
  Bytes beginning;
  std::unique_ptr<Decoder> decoder;
};

Unpacker::Unpacker(UnpackedSink sink, std::uint64_t limit)
    : state_(std::make_unique<State>(std::move(sink), limit)) {}
Unpacker::~Unpacker() = default;

Compression Unpacker::compression() const { return compression_of(state_->beginning); }

bool Unpacker::feed(std::span<const std::byte> bytes) {
  state_->take(bytes);
  return state_->out.is_wanted && (!state_->decoder || !state_->decoder->error());
}

Parsed<std::uint64_t> Unpacker::finish() {
  State& s = *state_;
  if (!s.decoder) s.begin();  // less than any magic
  if (!s.decoder->error() && s.out.is_wanted) s.decoder->end(s.out);
  if (s.decoder->error()) return *s.decoder->error();
  return {s.out.count, {}, 0};
}

Unpacked unpack_to(std::span<const std::byte> file, const UnpackedSink& sink, std::uint64_t limit) {
  Unpacker unpacker(sink, limit);
  unpacker.feed(file);
  return unpacker.finish();
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
