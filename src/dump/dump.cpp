#include "dump/dump.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>

#include "dump/compression.h"
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

/// The one word that some packets consist of, or what is wrong with it.
Parsed<std::uint32_t> single_word(const Dump& dump, const Packet& packet) {
  if (packet.count == 1) return {dump.words[packet.first], {}, 0};
  return Parsed<std::uint32_t>::error(
      packet.offset, "packet of type " + hex_byte(static_cast<std::uint32_t>(packet.type)) + " has " +
                         std::to_string(packet.count) + " words, 1 was expected");
}

/// What the packets mean, once all of them are there.
Parsed<Dump> check(Dump dump) {
  Checker checker(dump);
  std::uint64_t readback_bytes = 0;
  for (const auto& packet : dump.packets) {
    switch (packet.type) {
      case PacketType::port0:
        checker.port0(packet);
        break;
      case PacketType::port1:
        checker.port1(packet);
        break;
      case PacketType::vsync:
        ++dump.vsyncs;
        break;
      case PacketType::discard:
      case PacketType::readback: {
        const auto count = single_word(dump, packet);
        if (!count) return Parsed<Dump>::error(count.offset, count.message);
        if (*count.value > max_read_words) {
          return Parsed<Dump>::error(packet.offset + 4, "reads " + std::to_string(*count.value) +
                                                            " words, VRAM holds " +
                                                            std::to_string(max_read_words));
        }
        if (packet.type == PacketType::readback) readback_bytes += 4 * std::uint64_t{*count.value};
        if (readback_bytes > max_unpacked_bytes) {
          return Parsed<Dump>::error(packet.offset,
                                     "reads back more than " + std::to_string(max_unpacked_bytes) + " bytes");
        }
        break;
      }
      case PacketType::gpu_version: {
        const auto version = single_word(dump, packet);
        if (!version) return Parsed<Dump>::error(version.offset, version.message);
        dump.gpu_version = *version.value + (dump.format == DumpFormat::v1 ? 1 : 0);
        break;
      }
      default:
        break;  // texts, marks, and what later revisions add
    }
  }
  if (auto open = checker.open_command(); !open.empty()) {
    return Parsed<Dump>::error(checker.command_offset(), std::move(open));
  }
  return {std::move(dump), {}, 0};
}

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

void read_words(gpu::Gpu& gpu, std::uint32_t count, std::vector<std::uint32_t>* into) {
  // Without pixels to send every read gives the same latch.
  for (; count > 0 && ot::gpu_status::ReadyToSend::get(gpu.status()) != 0; --count) {
    const auto word = gpu.read();
    if (into != nullptr) into->push_back(word);
  }
  if (into != nullptr && count > 0) into->insert(into->end(), count, gpu.read());
}

gpu::FrameEnd sum(gpu::FrameEnd a, const gpu::FrameEnd& b) {
  if (a.polygons_without_depth == 0) a.first_without_depth = b.first_without_depth;
  a.polygons_without_depth += b.polygons_without_depth;
  a.queued += b.queued;
  return a;
}

}  // namespace

void Dump::add(PacketType type, std::span<const std::uint32_t> payload) {
  [[maybe_unused]] const bool is_port = type == PacketType::port0 || type == PacketType::port1;
  assert(is_port || payload.size() <= header::Length::max);
  do {
    const auto part = payload.first(std::min<std::size_t>(payload.size(), header::Length::max));
    packets.push_back({.type = type, .first = words.size(), .count = part.size()});
    words.insert(words.end(), part.begin(), part.end());
    payload = payload.subspan(part.size());
  } while (!payload.empty());
}

void Dump::add_text(PacketType type, std::string_view text) {
  std::vector<std::uint32_t> payload((text.size() + 3) / 4);
  for (std::size_t n = 0; n < text.size(); ++n) {
    payload[n / 4] |= std::uint32_t{static_cast<unsigned char>(text[n])} << 8 * (n % 4);
  }
  add(type, payload);
}

Parsed<Dump> parse_dump(std::span<const std::byte> bytes) {
  using Result = Parsed<Dump>;
  Dump dump;
  std::size_t at = 0;
  if (begins_with(bytes, standard_magic)) {
    at = standard_magic.size();
  } else if (begins_with(bytes, v1_magic)) {
    dump.format = DumpFormat::v1;
    at = v1_magic.size();
  } else if (begins_with(bytes, any_version)) {
    return Result::error(any_version.size(), "a GPU dump of another version than v1r1 and v1");
  } else {
    return Result::error(0, "not a GPU dump: it does not begin with PSXGPUDUMP");
  }

  dump.words.reserve((bytes.size() - at) / 4);
  while (at < bytes.size()) {
    const auto left = bytes.size() - at;
    if (left < 4) return Result::error(at, std::to_string(left) + " bytes are left, a packet header takes 4");
    const auto word = little_endian(&bytes[at]);
    const std::size_t count = header::Length::get(word);
    if (count > (left - 4) / 4) {
      return Result::error(at, "packet of type " + hex_byte(header::Type::get(word)) + " claims " +
                                   std::to_string(count) + " words, " + std::to_string((left - 4) / 4) +
                                   " are left");
    }
    dump.packets.push_back({.type = static_cast<PacketType>(header::Type::get(word)),
                            .offset = at,
                            .first = dump.words.size(),
                            .count = count});
    at += 4;
    for (std::size_t n = 0; n < count; ++n, at += 4) dump.words.push_back(little_endian(&bytes[at]));
  }
  return check(std::move(dump));
}

std::vector<std::byte> write_dump(const Dump& dump, DumpFormat format) {
  std::vector<std::byte> out;
  const auto magic = format == DumpFormat::v1 ? v1_magic : standard_magic;
  out.reserve(magic.size() + 4 * (dump.words.size() + dump.packets.size()));
  for (const char c : magic) out.push_back(static_cast<std::byte>(c));
  for (const auto& packet : dump.packets) {
    put_little_endian(out, header::Type::put(static_cast<std::uint32_t>(packet.type)) |
                               header::Length::put(static_cast<std::uint32_t>(packet.count)));
    for (auto word : dump.payload(packet)) {
      if (packet.type == PacketType::gpu_version)
        word = dump.gpu_version - (format == DumpFormat::v1 ? 1 : 0);
      put_little_endian(out, word);
    }
  }
  return out;
}

gpu::FrameEnd replay(const Dump& dump, gpu::Gpu& gpu, const ReplayOptions& options) {
  DrawingLimit limit(options.until);
  gpu::FrameEnd end;
  std::uint64_t vsyncs = 0;
  bool in_frame = false;  // z-buffer: from the first word after a VSync to the next VSync
  const auto begin_frame = [&] {
    if (gpu.depth_plane() == nullptr || in_frame) return;
    gpu.begin_frame();
    in_frame = true;
  };
  const auto end_frame = [&] {
    if (in_frame) end = sum(end, gpu.end_frame());
    in_frame = false;
  };
  for (const auto& packet : dump.packets) {
    const auto payload = dump.payload(packet);
    switch (packet.type) {
      case PacketType::port0:
        begin_frame();
        gpu.gp0(limit.wanted(payload));
        break;
      case PacketType::port1:
        for (const auto word : payload) {
          gpu.gp1(word);
          limit.port1(word);
        }
        break;
      case PacketType::vsync:
        end_frame();
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
    if (limit.reached() || (options.frame && vsyncs >= *options.frame)) break;
  }
  end_frame();
  return end;
}

}  // namespace dump
