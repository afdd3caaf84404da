#include "dump/dump.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>

#include "dump/compression.h"
#include "dump/frames.h"
#include "ot/command_stream.h"
#include "ot/gp1.h"

namespace dump {
namespace {

using ot::Field;

namespace header {  // the first word of a packet
using Length = Field<0, 24>;
using Type = Field<24, 8>;
}  // namespace header

constexpr std::string_view standard_magic{"PSXGPUDUMPv1r1\0\0", 16};
constexpr std::string_view v1_magic{"PSXGPUDUMPv1\0\0", 14};
constexpr std::string_view any_version{"PSXGPUDUMP"};

/// A read of more than all of VRAM is a mistake, however many commands came before it.
constexpr std::uint32_t max_read_words = gpu::Vram::size / 2;
constexpr std::uint64_t max_readback_bytes = std::uint64_t{128} << 20;

constexpr std::uint64_t usual_held_bytes = std::uint64_t{192} << 20;

/// What is wrong, and at which byte.
struct Error {
  std::uint64_t offset;
  std::string text;
};

std::string hex_byte(std::uint32_t value) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  return {digits[value >> 4 & 15], digits[value & 15], 'h'};
}

bool begins_with(std::span<const std::byte> bytes, std::string_view text) {
  return bytes.size() >= text.size() && std::memcmp(bytes.data(), text.data(), text.size()) == 0;
}

std::uint32_t little_endian(const std::byte* at) {
  std::uint32_t word = 0;
  for (int n = 3; n >= 0; --n) word = word << 8 | std::to_integer<std::uint32_t>(at[n]);
  return word;
}

void put_little_endian(std::vector<std::byte>& out, std::uint32_t word) {
  for (int n = 0; n < 4; ++n) out.push_back(static_cast<std::byte>(word >> 8 * n & 0xff));
}

/// Follows the commands of a whole dump to see that they are complete.
class Checker {
 public:
  explicit Checker(Dump& dump) : dump_(dump) {}

  void port0(const Packet& packet) {
    const auto words = dump_.payload(packet);
    for (std::size_t n = 0; n < words.size(); ++n) {
      n += stream_.skip_pixels(words.size() - n);
      if (n == words.size()) return;
      if (!stream_.is_open()) command_offset_ = packet.offset + 4 + 4 * n;
      if (stream_.take(words[n]) && ot::gp0::is_drawing(stream_.command())) ++dump_.drawing_commands;
    }
  }

  void port1(const Packet& packet) {
    if (std::ranges::any_of(dump_.payload(packet), ot::gp1::aborts_command)) stream_.abort();
  }

  /// One clause about the command that is still open; empty: none is.
  [[nodiscard]] std::string open_command() const {
    if (!stream_.is_open()) return {};
    if (stream_.command() == ot::gp0::Command::polyline) return "the polyline that begins here has no end";
    return "the command that begins here (" + hex_byte(ot::gp0::Opcode::get(stream_.words()[0])) +
           ") ends after " + std::to_string(stream_.length()) + " of " + std::to_string(stream_.needed()) +
           " words";
  }
  [[nodiscard]] std::uint64_t command_offset() const { return command_offset_; }

 private:
  Dump& dump_;
  ot::CommandStream stream_;
  std::uint64_t command_offset_ = 0;
};

/// What each packet means, one after the other.
class PacketChecker {
 public:
  explicit PacketChecker(Dump& dump) : dump_(dump), commands_(dump) {}

  /// What is wrong with the packet; empty: nothing.
  std::optional<Error> take(const Packet& packet) {
    switch (packet.type) {
      case PacketType::port0:
        commands_.port0(packet);
        return {};
      case PacketType::port1:
        commands_.port1(packet);
        return {};
      case PacketType::vsync:
        ++dump_.vsyncs;
        return {};
      case PacketType::discard:
      case PacketType::readback:
        return read(packet);
      case PacketType::gpu_version:
        if (packet.count != 1) return not_single(packet);
        dump_.gpu_version = dump_.words[packet.first] + (dump_.format == DumpFormat::v1 ? 1 : 0);
        return {};
      default:
        return {};  // texts, marks, and what later revisions add
    }
  }

  [[nodiscard]] std::optional<Error> end() const {
    if (auto open = commands_.open_command(); !open.empty()) {
      return Error{commands_.command_offset(), std::move(open)};
    }
    return {};
  }

 private:
  static Error not_single(const Packet& packet) {
    return {packet.offset, "packet of type " + hex_byte(static_cast<std::uint32_t>(packet.type)) + " has " +
                               std::to_string(packet.count) + " words, 1 was expected"};
  }
  std::optional<Error> read(const Packet& packet) {
    if (packet.count != 1) return not_single(packet);
    const std::uint32_t count = dump_.words[packet.first];
    if (count > max_read_words) {
      return Error{packet.offset + 4,
                   "reads " + std::to_string(count) + " words, VRAM holds " + std::to_string(max_read_words)};
    }
    if (packet.type == PacketType::readback) readback_bytes_ += 4 * std::uint64_t{count};
    if (readback_bytes_ > max_readback_bytes) {
      return Error{packet.offset, "reads back more than " + std::to_string(max_readback_bytes) + " bytes"};
    }
    return {};
  }

  Dump& dump_;
  Checker commands_;
  std::uint64_t readback_bytes_ = 0;
};

/// Words from a drawing command's end on are not wanted: how many of `words` are.
class DrawingLimit {
 public:
  explicit DrawingLimit(std::optional<std::uint64_t> until) : left_(until) {}

  /// The words up to and including the last that is wanted.
  std::span<const std::uint32_t> wanted(std::span<const std::uint32_t> words) {
    if (!left_) return words;
    for (std::size_t n = 0; n < words.size(); ++n) {
      n += stream_.skip_pixels(words.size() - n);
      if (n == words.size()) break;
      if (stream_.take(words[n]) && ot::gp0::is_drawing(stream_.command()) && --*left_ == 0)
        return words.first(n + 1);
    }
    return words;
  }
  void port1(std::uint32_t word) {
    if (ot::gp1::aborts_command(word)) stream_.abort();
  }
  [[nodiscard]] bool reached() const { return left_ == std::uint64_t{0}; }

 private:
  std::optional<std::uint64_t> left_;
  ot::CommandStream stream_;
};

/// Text as a packet holds it: four characters a word, the last one filled up with zeros.
std::vector<std::uint32_t> words_of(std::string_view text) {
  std::vector<std::uint32_t> words((text.size() + 3) / 4);
  for (std::size_t n = 0; n < text.size(); ++n) {
    words[n / 4] |= std::uint32_t{static_cast<unsigned char>(text[n])} << 8 * (n % 4);
  }
  return words;
}

void add(ReplayEnd& sum, const gpu::FrameEnd& frame, std::uint64_t number) {
  if (sum.polygons_without_depth == 0) {
    sum.first_without_depth = frame.first_without_depth;
    sum.first_frame = number;
  }
  sum.polygons_without_depth += frame.polygons_without_depth;
  sum.queued += frame.queued;
}

}  // namespace

void Dump::add(PacketType type, std::span<const std::uint32_t> payload) {
  [[maybe_unused]] const bool is_port = type == PacketType::port0 || type == PacketType::port1;
  assert(is_port || payload.size() <= header::Length::max);
  do {
    const auto part = payload.first(std::min<std::size_t>(payload.size(), header::Length::max));
    packets.push_back({.type = type,
                       .first = static_cast<std::uint32_t>(words.size()),
                       .count = static_cast<std::uint32_t>(part.size())});
    words.insert(words.end(), part.begin(), part.end());
    payload = payload.subspan(part.size());
  } while (!payload.empty());
}

void Dump::add_text(PacketType type, std::string_view text) { add(type, words_of(text)); }

std::uint64_t most_held_bytes(std::uint64_t file_bytes) {
  return std::clamp(4 * std::min(file_bytes, max_unpacked_bytes), usual_held_bytes, max_unpacked_bytes);
}

struct DumpReader::State {
  explicit State(std::uint64_t most) : most_held(most) {}

  /// Whether enough of the beginning is there to tell what it is.
  [[nodiscard]] bool take_magic(std::span<const std::byte>& bytes) {
    while (!bytes.empty() && begin.size() < standard_magic.size()) {
      begin.push_back(bytes.front());
      bytes = bytes.subspan(1);
      if (begins_with(begin, v1_magic)) {
        dump.format = DumpFormat::v1;
        has_magic = true;
      } else if (begins_with(begin, standard_magic)) {
        has_magic = true;
      }
      if (has_magic) {
        at = begin.size();
        return true;
      }
    }
    if (begin.size() == standard_magic.size()) error = no_magic();
    return false;
  }
  [[nodiscard]] Error no_magic() const {
    if (begins_with(begin, any_version)) {
      return {any_version.size(), "a GPU dump of another version than v1r1 and v1"};
    }
    return {0, "not a GPU dump: it does not begin with PSXGPUDUMP"};
  }

  void header_word(std::uint32_t word) {
    packet = {.type = static_cast<PacketType>(header::Type::get(word)),
              .offset = static_cast<std::uint32_t>(at),
              .first = static_cast<std::uint32_t>(dump.words.size()),
              .count = header::Length::get(word)};
    at += 4;
    left = packet.count;
    if (left == 0) end_packet();
  }
  void payload_word(std::uint32_t word) {
    dump.words.push_back(word);
    at += 4;
    if (--left == 0) end_packet();
  }
  void end_packet() {
    const bool is_port = packet.type == PacketType::port0 || packet.type == PacketType::port1;
    if (packet.count == 0 && is_port) {
      ++dump.empty_packets;
      return;
    }
    dump.packets.push_back(packet);
    error = checker.take(packet);
    check_held();
    if (error) dump.packets.pop_back();
  }
  void check_held() {
    if (!error && static_cast<std::uint64_t>(dump.held_bytes()) > most_held) {
      error = Error{packet.offset, "its words and packets take more than " + std::to_string(most_held) +
                                       " bytes up to here, which is the limit"};
    }
  }
  std::uint64_t most_held, at = 0;  // at: bytes of whole words seen
  Dump dump;
  PacketChecker checker{dump};
  std::vector<std::byte> begin;  // until the magic is whole
  bool has_magic = false;
  std::array<std::byte, 4> partial{};  // bytes of a word whose rest has not come
  std::size_t partial_count = 0;
  Packet packet;
  std::uint32_t left = 0;  // words of `packet` that have not come
  std::optional<Error> error;
};

DumpReader::DumpReader(std::uint64_t most_held) : state_(std::make_unique<State>(most_held)) {}
DumpReader::~DumpReader() = default;

bool DumpReader::feed(std::span<const std::byte> bytes) {
  State& s = *state_;
  if (s.error) return false;
  if (!s.has_magic && !s.take_magic(bytes)) return !s.error;
  const auto take = [&s](std::uint32_t word) { s.left == 0 ? s.header_word(word) : s.payload_word(word); };
  while (!bytes.empty() && !s.error) {
    if (s.partial_count != 0 || bytes.size() < 4) {
      s.partial[s.partial_count++] = bytes.front();
      bytes = bytes.subspan(1);
      if (s.partial_count < 4) continue;
      s.partial_count = 0;
      take(little_endian(s.partial.data()));
      continue;
    }
    // A long packet is judged as it grows: its header may claim 64 MiB.
    const auto whole = bytes.first(std::min<std::size_t>(bytes.size() / 4 * 4, std::size_t{1} << 20));
    for (std::size_t n = 0; n < whole.size() && !s.error; n += 4) take(little_endian(&whole[n]));
    bytes = bytes.subspan(whole.size());
    s.check_held();
  }
  return !s.error;
}

const Dump& DumpReader::so_far() const { return state_->dump; }

Parsed<Dump> DumpReader::finish() {
  State& s = *state_;
  if (!s.error && !s.has_magic) s.error = s.no_magic();
  if (!s.error && s.left == 0 && s.partial_count != 0) {
    s.error = Error{s.at, std::to_string(s.partial_count) + " bytes are left, a packet header takes 4"};
  }
  if (!s.error && s.left != 0) {
    s.error = Error{s.packet.offset, "packet of type " + hex_byte(static_cast<std::uint32_t>(s.packet.type)) +
                                         " claims " + std::to_string(s.packet.count) + " words, " +
                                         std::to_string(s.packet.count - s.left) + " are left"};
  }
  if (!s.error) s.error = s.checker.end();
  if (s.error) return Parsed<Dump>::error(s.error->offset, s.error->text);
  return {std::move(s.dump), {}, 0};
}

Parsed<Dump> parse_dump(std::span<const std::byte> bytes) {
  DumpReader reader(most_held_bytes(bytes.size()));
  reader.feed(bytes);
  return reader.finish();
}

DumpWriter::DumpWriter(DumpFormat format, Sink sink) : format_(format), sink_(std::move(sink)) {
  const auto magic = format == DumpFormat::v1 ? v1_magic : standard_magic;
  sink_(std::as_bytes(std::span(magic.data(), magic.size())));
}

void DumpWriter::add(PacketType type, std::span<const std::uint32_t> payload) {
  do {
    const auto part = payload.first(std::min<std::size_t>(payload.size(), header::Length::max));
    bytes_.clear();
    put_little_endian(bytes_, header::Type::put(static_cast<std::uint32_t>(type)) |
                                  header::Length::put(static_cast<std::uint32_t>(part.size())));
    const std::uint32_t less = type == PacketType::gpu_version && format_ == DumpFormat::v1 ? 1 : 0;
    for (const auto word : part) put_little_endian(bytes_, word - less);
    sink_(bytes_);
    held_bytes_ += sizeof(Packet) + part.size() * sizeof(std::uint32_t);
    words_ += part.size();
    payload = payload.subspan(part.size());
  } while (!payload.empty());
}

void DumpWriter::add_text(PacketType type, std::string_view text) { add(type, words_of(text)); }

void add_packets(const Dump& dump, DumpWriter& writer) {
  for (const auto& packet : dump.packets) {
    if (packet.type == PacketType::gpu_version) {
      writer.add(packet.type, std::span(&dump.gpu_version, 1));
    } else {
      writer.add(packet.type, dump.payload(packet));
    }
  }
}

std::vector<std::byte> write_dump(const Dump& dump, DumpFormat format) {
  std::vector<std::byte> out;
  out.reserve(standard_magic.size() + 4 * (dump.words.size() + dump.packets.size()));
  DumpWriter writer(format, [&out](std::span<const std::byte> bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
  });
  add_packets(dump, writer);
  return out;
}

void read_words(gpu::Gpu& gpu, std::uint32_t count, std::vector<std::uint32_t>* into) {
  // Without pixels to send every read gives the same latch.
  for (; count > 0 && ot::gpu_status::ReadyToSend::get(gpu.status()) != 0; --count) {
    const auto word = gpu.read();
    if (into != nullptr) into->push_back(word);
  }
  if (into != nullptr && count > 0) into->insert(into->end(), count, gpu.read());
}

ReplayEnd replay(const Dump& dump, gpu::Gpu& gpu, const ReplayOptions& options) {
  constexpr std::size_t piece = 512;  // words between two questions whether to go on
  DrawingLimit limit(options.until);
  ReplayEnd end;
  std::uint64_t vsyncs = 0, packets = 0;
  bool in_frame = false;  // z-buffer: from the first word of a frame to its last packet
  std::optional<Frames> found;
  const Frames* frames = options.frames;
  if (frames == nullptr && gpu.depth_plane() != nullptr) frames = &found.emplace(dump);
  std::uint64_t number = frames != nullptr ? frames->of_packet(options.first_packet) : 0;
  bool goes_on = true;
  const auto ask = [&](std::uint64_t words) { goes_on = !options.keep_going || options.keep_going(words); };
  const auto begin_frame = [&] {
    if (in_frame) return;
    gpu.begin_frame();
    in_frame = true;
  };
  const auto end_frame = [&] {
    if (in_frame) add(end, gpu.end_frame(), frames != nullptr ? number : vsyncs + 1);
    in_frame = false;
  };
  const auto whole = std::min(options.end_packet, dump.packets.size());
  const bool is_cut = options.end_words != 0 && whole < dump.packets.size();
  for (std::size_t n = options.first_packet; n < whole + (is_cut ? 1 : 0); ++n) {
    const Packet& packet = dump.packets[n];
    auto payload = dump.payload(packet);
    if (n == whole) payload = payload.first(std::min<std::size_t>(payload.size(), options.end_words));
    for (; frames != nullptr && number <= frames->count() && n >= frames->end(number); ++number) end_frame();
    switch (packet.type) {
      case PacketType::port0: {
        begin_frame();
        auto words = limit.wanted(payload);
        for (std::uint64_t sent = packet.first; words.size() > piece && goes_on;
             words = words.subspan(piece)) {
          gpu.gp0(words.first(piece));
          ask(sent += piece);
        }
        if (goes_on) gpu.gp0(words);
        break;
      }
      case PacketType::port1:
        begin_frame();
        for (const auto word : payload) {
          gpu.gp1(word);
          limit.port1(word);
        }
        break;
      case PacketType::vsync:
        gpu.next_field();
        ++vsyncs;
        break;
      case PacketType::discard:
        read_words(gpu, payload[0], nullptr);
        break;
      case PacketType::readback:
        read_words(gpu, payload[0], options.readback);
        break;
      default:
        break;
    }
    if (goes_on && ++packets % 16 == 0) ask(packet.first + packet.count);
    if (!goes_on || limit.reached() || (options.frame && vsyncs >= *options.frame)) break;
  }
  end_frame();
  return end;
}

}  // namespace dump
