#include "dump/dump_file.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <span>
#include <vector>

#include "base/file_kind.h"
#include "base/read_file.h"
#include "base/write_file.h"
#include "dump/compression.h"
#include "ot/command_stream.h"
#include "ot/describe.h"
#include "ot/gp1.h"

namespace dump {
namespace {

Compression compression_by_name(const std::filesystem::path& path) {
  const auto extension = base::lower_extension(path);
  if (extension == ".zst") return Compression::zstd;
  return extension == ".xz" ? Compression::xz : Compression::none;
}

std::string packet_text(const dump::Dump& dump, const dump::Packet& packet, std::uint64_t vsyncs) {
  const auto payload = dump.payload(packet);
  switch (packet.type) {
    case PacketType::vsync:
      return "vsync " + std::to_string(vsyncs);
    case PacketType::discard:
      return "discard " + std::to_string(payload[0]) + " words";
    case PacketType::readback:
      return "read back " + std::to_string(payload[0]) + " words";
    case PacketType::trace_begin:
      return "trace begins";
    case PacketType::gpu_version:
      return "GPU version " + std::to_string(dump.gpu_version);
    case PacketType::game_id:
    case PacketType::video_format:
    case PacketType::comment: {
      std::string text;
      for (const auto word : payload) {
        for (int shift = 0; shift < 32; shift += 8) {
          const auto c = static_cast<char>(word >> shift & 0xff);
          if (c != '\0') text += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
        }
      }
      return "text: " + text;
    }
    default:
      return std::to_string(payload.size()) + " words of unknown type, skipped";
  }
}

std::string line_of(std::uint64_t offset, const char* port, const std::string& draw, std::uint32_t code,
                    const std::string& text) {
  char head[64];
  std::snprintf(head, sizeof head, "%9llu %-4s %7s %02X  ", static_cast<unsigned long long>(offset), port,
                draw.c_str(), static_cast<unsigned>(code));
  return head + text;
}

}  // namespace

base::Result<Dump> read_dump(const std::filesystem::path& path) {
  const auto fail = [&](std::uint64_t offset, const char* where, const std::string& text) {
    return base::fail(path.string() + ": byte " + std::to_string(offset) + where + ": " + text);
  };
  const auto file = base::read_file(path, max_unpacked_bytes);
  if (!file) return tl::make_unexpected(file.error());
  if (compression_of(*file) == Compression::none) {
    auto dump = parse_dump(*file);
    if (!dump) return fail(dump.offset, "", dump.message);
    return std::move(*dump);
  }
  DumpReader reader(most_held_bytes(file->size()));
  const auto unpacked =
      unpack_to(*file, [&](std::span<const std::byte> bytes) { return reader.feed(bytes); });
  if (!unpacked) return fail(unpacked.offset, "", unpacked.message);
  auto dump = reader.finish();
  if (!dump) return fail(dump.offset, " of the unpacked dump", dump.message);
  return std::move(*dump);
}

base::Result<void> write_dump(const std::filesystem::path& path, DumpFormat format,
                              const std::function<base::Result<void>(DumpWriter&)>& make) {
  std::uint64_t file_bytes = 0;
  return base::write_file(path, [&](std::FILE* file) -> base::Result<void> {
    Packer packer(compression_by_name(path), [&](std::span<const std::byte> bytes) {
      std::fwrite(bytes.data(), 1, bytes.size(), file);
      file_bytes += bytes.size();
    });
    DumpWriter writer(format, [&](std::span<const std::byte> bytes) { packer.add(bytes); });
    if (auto made = make(writer); !made) return made;
    packer.finish();
    if (const auto most = most_held_bytes(file_bytes); writer.held_bytes() > most) {
      return base::fail(path.string() + ": the dump would take " + std::to_string(writer.held_bytes()) +
                        " bytes of memory to be read, the limit is " + std::to_string(most) +
                        "; fewer frames fit");
    }
    return {};
  });
}

void list_dump(const Dump& dump, const ReplayOptions& options,
               const std::function<void(const std::string&)>& line) {
  ot::CommandStream stream;
  std::uint64_t draws = 0, vsyncs = 0, begin = 0;
  const auto listed = std::min(options.end_packet, dump.packets.size());
  for (const auto& packet : std::span(dump.packets).first(listed)) {
    const auto payload = dump.payload(packet);
    if (packet.type == PacketType::port0) {
      for (std::size_t n = 0; n < payload.size(); ++n) {
        n += stream.skip_pixels(payload.size() - n);
        if (n == payload.size()) break;
        if (!stream.is_open()) begin = packet.offset + 4 + 4 * n;
        if (!stream.take(payload[n])) continue;
        const bool draws_now = ot::gp0::is_drawing(stream.command());
        if (draws_now) ++draws;
        line(line_of(begin, "GP0", draws_now ? std::string("#").append(std::to_string(draws)) : "-",
                     ot::gp0::Opcode::get(stream.words()[0]), ot::describe(stream.words(), stream.length())));
        if (draws_now && options.until && draws == *options.until) return;
      }
    } else if (packet.type == PacketType::port1) {
      for (std::size_t n = 0; n < payload.size(); ++n) {
        line(line_of(packet.offset + 4 + 4 * n, "GP1", "-", ot::gp0::Opcode::get(payload[n]),
                     ot::describe_control(payload[n])));
        if (ot::gp1::aborts_command(payload[n])) stream.abort();
      }
    } else {
      if (packet.type == PacketType::vsync) ++vsyncs;
      line(line_of(packet.offset, "-", "-", static_cast<std::uint32_t>(packet.type),
                   packet_text(dump, packet, vsyncs)));
      if (options.frame && vsyncs == *options.frame) return;
    }
  }
}

}  // namespace dump
