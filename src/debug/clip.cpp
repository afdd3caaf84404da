#include "debug/clip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <utility>

#include "debug/item_cutter.h"
#include "debug/timeline.h"
#include "ot/describe.h"
#include "ot/walker.h"

namespace debug {
namespace {

bool is_annotation(std::uint32_t word) { return ot::gp0::command_of(word) == ot::gp0::Command::annotation; }

/// All of VRAM as one upload.
std::vector<std::uint32_t> upload_of(const gpu::Vram& vram) {
  std::vector<std::uint32_t> words{
      ot::gp0::Opcode::put(0xa0), 0,
      ot::gp0::area::Width::put(gpu::Vram::width) | ot::gp0::area::Height::put(gpu::Vram::height)};
  const auto pixels = vram.pixels();
  for (std::size_t i = 0; i < pixels.size(); i += 2) {
    words.push_back(pixels[i] | std::uint32_t{pixels[i + 1]} << 16);
  }
  return words;
}

/// The registers of a state, as commands.
std::array<std::uint32_t, 7> registers_of(const gpu::DrawState& state) {
  using ot::gp0::Opcode;
  return {ot::gp0::clear_cache,
          Opcode::put(0xe1) | ot::gp0::draw_mode::All::get(state.draw_mode),
          Opcode::put(0xe2) | (state.texture_window & 0xffffff),
          Opcode::put(0xe3) | (state.area_top_left & 0xffffff),
          Opcode::put(0xe4) | (state.area_bottom_right & 0xffffff),
          Opcode::put(0xe5) | (state.offset & 0xffffff),
          Opcode::put(0xe6) | (state.mask & 0xffffff)};
}

std::array<std::uint32_t, 5> display_words(const gpu::Display& display) {
  const auto put = [](std::uint32_t command, std::uint32_t value) {
    return command << 24 | (value & 0xffffff);
  };
  return {put(0x03, display.is_off ? 1 : 0), put(0x05, display.start), put(0x06, display.horizontal_range),
          put(0x07, display.vertical_range), put(0x08, display.mode)};
}

}  // namespace

std::size_t Item::command_at() const {
  if (is_control) return 0;
  return static_cast<std::size_t>(std::find_if_not(words.begin(), words.end(), is_annotation) -
                                  words.begin());
}

bool Item::is_drawing() const {
  const auto at = command_at();
  return !is_control && !is_rest && at < words.size() && ot::gp0::is_drawing(ot::gp0::command_of(words[at]));
}

std::string Item::text() const {
  if (is_control) return words.empty() ? "" : ot::describe_control(words[0]);
  if (is_rest) return "the rest of a command (" + std::to_string(words.size()) + " words)";
  const auto at = command_at();
  if (at == words.size()) return "depths of nothing";
  const auto command = std::span(words).subspan(at);
  const bool is_upload = ot::gp0::command_of(command[0]) == ot::gp0::Command::upload;
  const auto told = is_upload ? command.first(std::min<std::size_t>(command.size(), 3)) : command;
  return ot::describe(told.first(std::min(told.size(), ot::CommandStream::kept_words)), command.size());
}

std::vector<Item> items_of(const std::vector<Sent>& sent) {
  std::vector<Item> items;
  ItemCutter cutter(items);
  for (const auto& one : sent) {
    if (one.is_control) {
      for (const auto word : one.words) cutter.gp1(word);
      continue;
    }
    cutter.set_node(one.address, one.bucket, one.origin);
    cutter.gp0(one.words);
  }
  cutter.finish();
  return items;
}

Clip clip_of(Timeline& timeline, std::uint64_t frame) {
  const auto& recording = timeline.recording();
  if (recording.image()) {
    return clip_of_list(recording.image()->ram, recording.image()->head, recording.image()->table,
                        recording.start());
  }
  Clip clip;
  clip.buckets = recording.buckets();
  clip.state = timeline.seek({.frame = frame, .command = 0}).save();
  const auto& dump = timeline.dump();
  const auto& where = timeline.frame(frame);
  const auto& commands = timeline.commands(frame);
  const auto first =
      std::find_if(commands.begin(), commands.end(), [](const auto& c) { return !c.is_control; });
  const bool is_late = first != commands.end() && first->begin.packet < where.first_packet;
  const Place begin = first == commands.end() ? Place{where.end_packet, 0}
                      : is_late               ? first->end
                                              : first->begin;
  ItemCutter cutter(clip.items);
  for (std::size_t n = where.first_packet; n < where.end_packet; ++n) {
    const auto& packet = dump.packets[n];
    const auto words = dump.payload(packet);
    if (packet.type == dump::PacketType::port1) {
      for (const auto word : words) cutter.gp1(word);
    }
    if (packet.type != dump::PacketType::port0) continue;
    const std::size_t before = n < begin.packet    ? words.size()
                               : n == begin.packet ? std::min<std::size_t>(begin.word, words.size())
                                                   : 0;
    if (before != 0) cutter.rest(words.first(before), is_late);
    const auto* node = recording.node_at(packet.first);
    cutter.set_node(0, node == nullptr ? gpu::no_bucket : node->bucket, {});
    cutter.gp0(words.subspan(before));
  }
  cutter.finish();
  return clip;
}

Clip clip_of_list(const ot::MainRam& ram, std::uint32_t head, const std::optional<inspect::TableRange>& table,
                  std::vector<std::byte> state) {
  Clip clip;
  clip.state = std::move(state);
  clip.is_list_in_ram = true;
  clip.buckets = table ? table->length : 0;
  clip.lint = inspect::lint_list(ram, head, table);
  const auto walked = ot::validate(ram, head);
  ItemCutter cutter(clip.items);
  std::uint32_t bucket = gpu::no_bucket;
  ot::send_nodes(ram.words(), head, walked.nodes,
                 [&](std::uint32_t tag, std::span<const std::uint32_t> payload) {
                   const auto at = tag & (ram.size_bytes() - 4);
                   if (table && at >= table->address && (at - table->address) / 4 < table->length) {
                     bucket = (at - table->address) / 4;
                   }
                   if (payload.empty()) return;
                   cutter.set_node(at, bucket, ot::address_text(at));
                   cutter.gp0(payload);
                 });
  cutter.finish();
  return clip;
}

void go_on_from(std::span<const std::byte> state, gpu::Gpu& gpu) {
  if (state.empty()) return;
  [[maybe_unused]] const auto error = gpu.load(state);
  assert(!error);
}

gpu::FrameEnd play(const Clip& clip, gpu::Gpu& gpu, const PlayOptions& options) {
  gpu.set_trace(nullptr);
  gpu.set_depth(options.depth);
  go_on_from(clip.state, gpu);
  if (options.trace != nullptr) {
    options.trace->clear();
    gpu.set_trace(options.trace);
  }
  gpu.begin_frame();
  for (std::size_t i = 0; i < clip.items.size(); ++i) {
    const auto& item = clip.items[i];
    if (options.before) options.before(i);
    if (options.trace != nullptr) options.trace->bucket = item.bucket;
    item.is_control ? gpu.gp1(item.words[0]) : gpu.gp0(item.words);
  }
  const auto end = gpu.end_frame();
  gpu.set_trace(nullptr);
  return end;
}

void add_state(std::span<const std::byte> state, dump::Dump& dump) {
  gpu::Gpu gpu;
  go_on_from(state, gpu);
  const std::array reset{std::uint32_t{0}};
  dump.add(dump::PacketType::port1, reset);
  dump.add(dump::PacketType::port0, upload_of(gpu.vram()));
  dump.add(dump::PacketType::port0, registers_of(gpu.state()));
  dump.add(dump::PacketType::port1, display_words(gpu.display()));
  dump.add(dump::PacketType::trace_begin);
}

void write_clip(const Clip& clip, dump::DumpWriter& writer) {
  dump::Dump before;
  add_state(clip.state, before);
  dump::add_packets(before, writer);
  for (const auto& item : clip.items) {
    writer.add(item.is_control ? dump::PacketType::port1 : dump::PacketType::port0, item.words);
  }
  writer.add(dump::PacketType::vsync);
}

}  // namespace debug
