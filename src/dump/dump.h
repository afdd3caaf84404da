#pragma once
// GPU dumps: everything a program sent to the two ports of the GPU, in packets.
// Read, checked, replayed, written.
//   [ps1dev/standards, GPUDUMP.md, revision v1r1]
// The older form that emulators wrote has a 14-byte magic, so that its packets lie unaligned, and counts its
// GPU versions from 0.
//
// Not modelled: the time stamps of VSync packets, the second megabyte of VRAM (GPU version 3).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dump/parsed.h"
#include "gpu/gpu.h"

namespace dump {

enum class DumpFormat : std::uint8_t { standard, v1 };

/// The first byte of a packet. Others may come and are skipped.
enum class PacketType : std::uint8_t {
  port0 = 0x00,        ///< words written to GP0; commands may be cut by packets
  port1 = 0x01,        ///< words written to GP1
  vsync = 0x02,        ///< 0 to 2 words of time stamp
  discard = 0x03,      ///< 1 word: so many words are read from GPUREAD and thrown away
  readback = 0x04,     ///< 1 word: so many words are read from GPUREAD and kept
  trace_begin = 0x05,  ///< what came before was made up to restore the state
  gpu_version = 0x06,  ///< 1 word
  game_id = 0x10,
  video_format = 0x11,
  comment = 0x12,
};

struct Packet {
  PacketType type = PacketType::port0;
  std::uint32_t offset = 0;  ///< byte of the unpacked file where the packet begins; 0 when not read from one
  std::uint32_t first = 0, count = 0;  ///< its words in Dump::words
};

struct Dump {
  DumpFormat format = DumpFormat::standard;
  std::vector<Packet> packets;       ///< those of the ports that are empty are not kept
  std::vector<std::uint32_t> words;  ///< payloads one behind the other
  std::uint64_t empty_packets = 0;   ///< of the ports, left out of `packets`
  std::uint32_t gpu_version = 2;     ///< 1: the first chip; 2: the later one; 3: that with 2 MB of VRAM
  std::uint64_t vsyncs = 0;
  std::uint64_t drawing_commands = 0;  ///< polygon, line or polyline, rectangle, fill, copy, upload

  [[nodiscard]] std::span<const std::uint32_t> payload(const Packet& p) const {
    return std::span(words).subspan(p.first, p.count);
  }

  /// What it takes in memory, as most_held_bytes() counts.
  [[nodiscard]] std::int64_t held_bytes() const {
    return static_cast<std::int64_t>(words.size() * sizeof(std::uint32_t) + packets.size() * sizeof(Packet));
  }

  /// Appends a packet, or several when port data is longer than one can be (2^24 - 1 words).
  void add(PacketType type, std::span<const std::uint32_t> payload = {});
  void add_text(PacketType type, std::string_view text);
};

/// What a dump may take in memory, words and packets together, so that a few bytes cannot unpack to more than
/// any machine has: 192 MiB, or four times its file, and never more than 1 GiB.
std::uint64_t most_held_bytes(std::uint64_t file_bytes);

/// Reads a plain dump, as its bytes come, and checks it: every packet whole, every command complete at the
/// end, read counts within VRAM. Counts VSyncs and drawing commands. Memory: what the words and packets take
/// that are kept, and that is bounded.
class DumpReader {
 public:
  explicit DumpReader(std::uint64_t most_held = most_held_bytes(0));
  ~DumpReader();
  DumpReader(const DumpReader&) = delete;
  DumpReader& operator=(const DumpReader&) = delete;

  /// The next bytes, however many. False: something is wrong, and finish() tells what; no more is wanted.
  bool feed(std::span<const std::byte> bytes);
  /// What has come so far: packets that are whole and good. It grows, and moves away with finish().
  [[nodiscard]] const Dump& so_far() const;
  /// The end of the file. Error: so_far() stays.
  Parsed<Dump> finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole of a plain dump that is in memory already.
Parsed<Dump> parse_dump(std::span<const std::byte> bytes);

/// Writes a dump as it is made: what is added goes to `sink` at once, the magic first.
class DumpWriter {
 public:
  using Sink = std::function<void(std::span<const std::byte>)>;
  DumpWriter(DumpFormat format, Sink sink);

  /// A packet, or several when port data is longer than one can be (2^24 - 1 words). A packet of
  /// PacketType::gpu_version counts as the standard format does, from 1.
  void add(PacketType type, std::span<const std::uint32_t> payload = {});
  void add_text(PacketType type, std::string_view text);
  /// What whoever reads the dump will hold of it, as most_held_bytes() counts.
  [[nodiscard]] std::uint64_t held_bytes() const { return held_bytes_; }
  [[nodiscard]] std::uint64_t words() const { return words_; }

 private:
  DumpFormat format_;
  Sink sink_;
  std::vector<std::byte> bytes_;
  std::uint64_t held_bytes_ = 0, words_ = 0;
};

/// All packets of a dump.
void add_packets(const Dump& dump, DumpWriter& writer);

/// The file that parse_dump reads back to the same packets.
std::vector<std::byte> write_dump(const Dump& dump, DumpFormat format);

/// Reads GPUREAD so many times, as packets of types 3 and 4 ask; the words are appended to `into`, if there
/// is one.
void read_words(gpu::Gpu& gpu, std::uint32_t count, std::vector<std::uint32_t>* into = nullptr);

class Frames;

struct ReplayOptions {
  std::optional<std::uint64_t> frame{};            ///< stop at this VSync packet, from 1
  std::optional<std::uint64_t> until{};            ///< stop after this drawing command, from 1
  std::vector<std::uint32_t>* readback = nullptr;  ///< words of readback packets are appended
  /// Asked after every few packets and every few hundred words of a long one: false ends the replay there.
  /// Told how many of the dump's words have been sent.
  std::function<bool(std::uint64_t words)> keep_going{};
  /// Only these packets; frames and commands are counted from the first of them.
  std::size_t first_packet = 0, end_packet = static_cast<std::size_t>(-1);
  /// Where the frames of a z-buffer end; nullptr: Frames(dump), found anew for every replay with a z-buffer.
  const Frames* frames = nullptr;
  std::uint32_t end_words = 0;  ///< and so many words of packet `end_packet`, if it is one of a port
};

/// The sum of what end_frame told, and the frame in which `first_without_depth` counts.
struct ReplayEnd : gpu::FrameEnd {
  std::uint64_t first_frame = 0;  ///< from 1
};

/// Feeds a checked dump to the GPU in its present state (a new one: VRAM zero, as after GP1(00h)). A z-buffer
/// begins and ends its frames where `frames` says, or where the replay stops.
ReplayEnd replay(const Dump& dump, gpu::Gpu& gpu, const ReplayOptions& options = {});

}  // namespace dump
