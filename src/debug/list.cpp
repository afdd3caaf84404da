#include "debug/list.h"

#include <array>
#include <cctype>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

#include "debug/json.h"
#include "gpu/trace.h"

namespace debug {
namespace {

using dump::PacketType;

std::string hex(std::uint32_t value, int digits) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%0*Xh", digits, static_cast<unsigned>(value));
  return text.data();
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

std::string line_of(const std::string& where, const std::string& number, const char* port,
                    const std::string& drawing, std::uint32_t code, const std::string& text) {
  std::array<char, 96> head{};
  std::snprintf(head.data(), head.size(), "%9s %10s %-3s %7s %02X  ", where.c_str(), number.c_str(), port,
                drawing.c_str(), static_cast<unsigned>(code));
  return head.data() + text;
}

bool is_port(const dump::Packet& packet) {
  return packet.type == PacketType::port0 || packet.type == PacketType::port1;
}

/// Lists the commands of frames, one after the other, and the packets among them.
class Lister {
 public:
  Lister(Timeline& timeline, const std::function<void(const std::string&)>& line)
      : timeline_(timeline), line_(line) {}

  void frame(std::uint64_t frame, std::uint64_t most) {
    for (const Command& command : timeline_.commands(frame)) {
      if (command.number > most) return;
      packets_before(command.begin.packet);
      tell(frame, command);
    }
    if (most == whole_frame) packets_before(timeline_.frame(frame).end_packet);
  }

 private:
  void tell(std::uint64_t frame, const Command& command) {
    const auto& dump = timeline_.dump();
    const auto origin = timeline_.origin_of(command);
    line_(line_of(origin.empty() ? std::to_string(offset_of(dump, command)) : origin,
                  to_text(timeline_.number_of(frame, command)), command.is_control ? "GP1" : "GP0",
                  command.drawing == 0 ? "-" : std::string("#").append(std::to_string(command.drawing)),
                  ot::gp0::Opcode::get(dump.words[command.first]), describe(dump, command)));
  }
  void packets_before(std::size_t end) {
    const auto& dump = timeline_.dump();
    for (; next_ < end; ++next_) {
      const auto& packet = dump.packets[next_];
      if (is_port(packet)) continue;
      if (packet.type == PacketType::vsync) ++vsyncs_;
      line_(line_of(std::to_string(packet.offset), "-", "-", "-", static_cast<std::uint32_t>(packet.type),
                    packet_text(dump, packet, vsyncs_)));
    }
  }

  Timeline& timeline_;
  const std::function<void(const std::string&)>& line_;
  std::size_t next_ = 0;  // packet
  std::uint64_t vsyncs_ = 0;
};

Json state_json(const gpu::DrawState& state) {
  static constexpr std::array formats{"none", "4-bit", "8-bit", "15-bit"};
  static constexpr std::array blends{"", "(B+F)/2", "B+F", "B-F", "B+F/4"};
  return {
      {"page", {state.page_x(), state.page_y()}},
      {"texels", formats[static_cast<std::size_t>(state.texel_format())]},
      {"blend", blends[static_cast<std::size_t>(state.blend())]},
      {"dither", state.dithers()},
      {"draw_to_display", state.draws_to_display()},
      {"flip", {state.flips_x(), state.flips_y()}},
      {"window", {state.window_keep_u(), state.window_keep_v(), state.window_set_u(), state.window_set_v()}},
      {"area", {state.left(), state.top(), state.right(), state.bottom()}},
      {"offset", {state.offset_x(), state.offset_y()}},
      {"set_mask", state.mask_set() != 0},
      {"test_mask", state.mask_test() != 0}};
}

/// What a frame did, command by command.
struct FrameNotes {
  std::vector<gpu::DrawState> states;  ///< as each command found them
  std::vector<std::uint64_t> pixels;   ///< that each wrote
};

FrameNotes note_frame(const std::vector<Command>& commands, std::size_t end_packet, Player& player,
                      gpu::Trace& trace) {
  FrameNotes notes;
  notes.pixels.resize(commands.size());
  trace.clear();
  player.gpu().set_trace(&trace);
  for (const Command& command : commands) {
    if (player.place() < command.begin) player.run(command.begin);
    notes.states.push_back(player.gpu().state());
    if (player.place() < command.end) player.run(command.end);
  }
  player.run({end_packet, 0});
  player.gpu().set_trace(nullptr);
  for (std::size_t draw = 0; draw < trace.draws.size(); ++draw) {
    const auto number = trace.draws[draw].command_number;
    if (number < notes.pixels.size()) notes.pixels[number] += trace.written[draw];
  }
  return notes;
}

Json command_json(const Timeline& timeline, std::uint64_t frame, const Command& command,
                  const FrameNotes& notes) {
  const auto& dump = timeline.dump();
  const auto origin = timeline.origin_of(command);
  Json words = Json::array();
  for (const auto word : words_of(dump, command)) words.push_back(hex(word, 8));
  const std::size_t index = command.number - 1;
  return {{"number", to_text(timeline.number_of(frame, command))},
          {"port", command.is_control ? 1 : 0},
          {"offset", offset_of(dump, command)},
          {"drawing", command.drawing == 0 ? Json(nullptr) : Json(command.drawing)},
          {"opcode", hex(ot::gp0::Opcode::get(dump.words[command.first]), 2)},
          {"words", std::move(words)},
          {"text", describe(dump, command)},
          {"origin", origin.empty() ? Json(nullptr) : Json(origin)},
          {"pixels", notes.pixels[index]},
          {"state", state_json(notes.states[index])}};
}

}  // namespace

void list_text(Timeline& timeline, const Number& end, const std::function<void(const std::string&)>& line) {
  Lister lister(timeline, line);
  for (std::uint64_t frame = 1; frame <= end.frame; ++frame)
    lister.frame(frame, frame == end.frame ? end.command : whole_frame);
}

void list_json(Timeline& timeline, const std::string& name, const Number& end,
               const std::function<void(const std::string&)>& write,
               const std::function<bool()>& keep_going) {
  Json head{{"schema", "otter.list/1"},    {"scene", name},
            {"frame", end.frame},          {"width", gpu::Vram::width},
            {"height", gpu::Vram::height}, {"frames", timeline.frames()}};
  auto text = to_text(head);
  text.resize(text.rfind('\n', text.size() - 2));  // before the closing brace
  write(text + ",\n  \"commands\": [");
  Player player(timeline.recording(), timeline.frame_ends(), timeline.options());
  gpu::Trace trace;
  const char* separator = "\n    ";
  for (std::uint64_t frame = 1; frame <= end.frame; ++frame) {
    if (keep_going && !keep_going()) break;
    const auto& commands = timeline.commands(frame);
    const auto notes = note_frame(commands, timeline.frame(frame).end_packet, player, trace);
    for (const Command& command : commands) {
      if (frame == end.frame && command.number > end.command) break;
      write(separator + one_line(command_json(timeline, frame, command, notes)));
      separator = ",\n    ";
    }
  }
  write("\n  ]\n}\n");
}

}  // namespace debug
