#include "debug/slice_writer.h"

#include <algorithm>
#include <array>
#include <bit>

#include "ot/gp0.h"
#include "ot/gp1.h"

namespace debug {
namespace {

namespace gp0 = ot::gp0;
namespace gp1 = ot::gp1;
using dump::PacketType;
using gpu::Kind, gpu::Vram;
using Pixels = std::map<std::uint32_t, std::uint16_t>;

constexpr int header_pixels = 6;  // what the three words of an upload could hold instead

/// Pixels side by side in one row: from..to, both inside.
struct Run {
  int from, to;
  [[nodiscard]] int width() const { return to - from + 1; }
};

/// The needed pixels of row `y`, gaps closed that are shorter than a header.
std::vector<Run> runs_of(int y, const Pixels& needed, const Pixels& known) {
  std::vector<Run> runs;
  const auto row = static_cast<std::uint32_t>(y) * Vram::width;
  for (auto at = needed.lower_bound(row); at != needed.end() && at->first < row + Vram::width; ++at) {
    const int x = static_cast<int>(at->first - row);
    const auto is_bridge = [&](int from, int to) {
      for (int gap = from; gap < to; ++gap)
        if (!known.contains(row + static_cast<std::uint32_t>(gap))) return false;
      return true;
    };
    if (!runs.empty() && x - runs.back().to - 1 <= header_pixels && is_bridge(runs.back().to + 1, x)) {
      runs.back().to = x;
    } else {
      runs.push_back({x, x});
    }
  }
  return runs;
}

/// A rectangle that may grow downwards.
struct Growing {
  int from, to, top, bottom;
  [[nodiscard]] int area() const { return (to - from + 1) * (bottom - top + 1); }
};

bool is_known(const Growing& box, const Pixels& known) {
  for (int y = box.top; y <= box.bottom; ++y)
    for (int x = box.from; x <= box.to; ++x)
      if (!known.contains(static_cast<std::uint32_t>(y * Vram::width + x))) return false;
  return true;
}

std::vector<std::uint32_t> packed(const UploadPiece& piece) {
  std::vector<std::uint32_t> words{0xa0000000,
                                   gp0::area::X::put(static_cast<std::uint32_t>(piece.x)) |
                                       gp0::area::Y::put(static_cast<std::uint32_t>(piece.y)),
                                   gp0::area::Width::put(static_cast<std::uint32_t>(piece.width)) |
                                       gp0::area::Height::put(static_cast<std::uint32_t>(piece.height()))};
  for (std::size_t n = 0; n < piece.pixels.size(); n += 2) {
    const std::uint32_t high = n + 1 < piece.pixels.size() ? piece.pixels[n + 1] : 0;
    words.push_back(piece.pixels[n] | high << 16);
  }
  return words;
}

/// The annotation words before a command.
std::vector<std::uint32_t> annotation_before(const dump::Dump& dump, const Command& command, Place from) {
  std::vector<std::uint32_t> words;
  for (; from < command.begin; from = {from.packet + 1, 0}) {
    const auto& packet = dump.packets[from.packet];
    if (packet.type != PacketType::port0) continue;
    const std::uint32_t end = from.packet == command.begin.packet ? command.begin.word : packet.count;
    for (const auto word : dump.payload(packet).subspan(from.word, end - from.word))
      if (gp0::command_of(word) == gp0::Command::annotation) words.push_back(word);
  }
  return words;
}

/// Which registers a command looks at.
struct Looks {
  bool mode, window, area, mask;
};

Looks looks_of(Kind kind, std::uint32_t first_word) {
  if (kind == Kind::fill) return {false, false, false, false};
  if (kind == Kind::copy || kind == Kind::upload) return {false, false, false, true};
  const bool is_textured = kind != Kind::line && gp0::polygon::IsTextured::get(first_word) != 0;
  return {true, is_textured, true, true};
}

}  // namespace

std::vector<UploadPiece> cut_upload(const Pixels& needed, const Pixels& known) {
  std::vector<Growing> done, open;
  const auto row_of = [](std::uint32_t pixel) { return static_cast<int>(pixel / Vram::width); };
  int y = -1;
  for (const auto& [pixel, value] : needed) {
    if (row_of(pixel) == y) continue;
    y = row_of(pixel);
    for (const Run& run : runs_of(y, needed, known)) {
      // Into the box above that grows least, if that takes less than a header of its own.
      Growing* best = nullptr;
      Growing best_grown{};
      int best_cost = run.width() + header_pixels;
      for (Growing& box : open) {
        const Growing grown{std::min(box.from, run.from), std::max(box.to, run.to), box.top, y};
        const int cost = grown.area() - box.area();
        if (cost >= best_cost || !is_known(grown, known)) continue;
        best = &box;
        best_grown = grown;
        best_cost = cost;
      }
      if (best != nullptr) {
        *best = best_grown;
      } else {
        open.push_back({run.from, run.to, y, y});
      }
    }
    const auto is_behind = [&](const Growing& box) { return y - box.bottom > header_pixels; };
    std::ranges::copy_if(open, std::back_inserter(done), is_behind);
    std::erase_if(open, is_behind);
  }
  done.insert(done.end(), open.begin(), open.end());
  std::vector<UploadPiece> pieces;
  for (const Growing& box : done) {
    UploadPiece piece{box.from, box.top, box.to - box.from + 1, {}};
    for (int row = box.top; row <= box.bottom; ++row)
      for (int x = box.from; x <= box.to; ++x)
        piece.pixels.push_back(known.at(static_cast<std::uint32_t>(row * Vram::width + x)));
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

void SliceWriter::port0(std::span<const std::uint32_t> words) {
  gpu_.gp0(words);
  held_.insert(held_.end(), words.begin(), words.end());
}

void SliceWriter::flush() {
  if (!held_.empty()) slice_.dump.add(PacketType::port0, held_);
  held_.clear();
}

void SliceWriter::port1(std::uint32_t word) {
  flush();
  gpu_.gp1(word);
  slice_.dump.add(PacketType::port1, std::array{word});
}

void SliceWriter::vsync() {
  flush();
  gpu_.next_field();
  slice_.dump.add(PacketType::vsync);
  ++slice_.dump.vsyncs;
}

void SliceWriter::upload(const Pixels& needed, const Pixels& known) {
  for (const UploadPiece& piece : cut_upload(needed, known)) {
    port0(packed(piece));
    slice_.upload_pixels += piece.pixels.size();
  }
}

void SliceWriter::begin(const Needs& needs) {
  constexpr std::uint32_t gpu_version = 2;
  slice_.dump.add(PacketType::gpu_version, std::array{gpu_version});
  port1(gp1::make(gp1::Command::reset));
  const auto vram = timeline_.seek({.frame = 1, .command = 0}).vram().pixels();
  Pixels first;
  for (std::uint32_t p = 0; p < needs.pixels.size(); ++p)
    if (needs.pixels[p] && vram[p] != 0) first.emplace(p, vram[p]);
  upload(first, first);
}

void SliceWriter::add(std::uint64_t frame, const Kept& kept) {
  Number number{.frame = frame, .command = kept.command};
  if (kept.kind == Kind::upload) {
    set_registers(timeline_.seek({frame, kept.command}), kept, 0);
    upload(kept.uploaded, kept.around);
    slice_.kept.push_back(number);
    return;
  }
  while (number.command == 0 && number.frame > 1) {  // it began in a frame before
    --number.frame;
    const auto& commands = timeline_.commands(number.frame);
    const auto last = std::ranges::find_if(commands.rbegin(), commands.rend(),
                                           [](const Command& c) { return c.drawing != 0; });
    if (last != commands.rend()) number.command = last->number;
  }
  if (number.command == 0 || (!slice_.kept.empty() && slice_.kept.back() == number)) return;
  const auto& commands = timeline_.commands(number.frame);
  const Command command = commands[number.command - 1];
  const Place before = number.command == 1 ? Place{timeline_.frame(number.frame).first_packet, 0}
                                           : commands[number.command - 2].end;
  const auto annotation = annotation_before(timeline_.dump(), command, before);
  const std::uint32_t first_word = timeline_.dump().words[command.first];
  set_registers(timeline_.seek({number.frame, number.command - 1}), kept, first_word);
  if (kept.loads_palette && has_palette_) port0(std::array{gp0::clear_cache});
  has_palette_ = has_palette_ || kept.loads_palette;
  port0(annotation);
  port0(all_words_of(timeline_.dump(), command));
  if (!gpu_.is_between_commands()) port0(std::array{gp0::line::terminator});  // a polyline that was cut off
  slice_.kept.push_back(number);
}

void SliceWriter::set_registers(const gpu::Gpu& original, const Kept& kept, std::uint32_t first_word) {
  const gpu::DrawState &wanted = original.state(), &has = gpu_.state();
  const auto [mode, window, area, mask] = looks_of(kept.kind, first_word);
  const auto set = [&](std::uint32_t opcode, std::uint32_t fields) {
    port0(std::array{gp0::Opcode::put(opcode) | fields});
  };
  if (mode && wanted.draw_mode != has.draw_mode) {
    if (gp0::draw_mode::TextureDisable::get(wanted.draw_mode) != 0)
      port1(gp1::make(gp1::Command::allow_texture_disable, gp1::allow_texture_disable::IsAllowed::put(1)));
    set(0xe1, wanted.draw_mode);
  }
  if (window && wanted.texture_window != has.texture_window) set(0xe2, wanted.texture_window);
  if (area && wanted.area_top_left != has.area_top_left) set(0xe3, wanted.area_top_left);
  if (area && wanted.area_bottom_right != has.area_bottom_right) set(0xe4, wanted.area_bottom_right);
  if (area && wanted.offset != has.offset) set(0xe5, wanted.offset);
  if (mask && wanted.mask != has.mask) set(0xe6, wanted.mask);
  if (kept.kind != Kind::copy && kept.kind != Kind::upload) set_skipped_rows(original);
}

/// Which rows are skipped follows from what is displayed, and from the field.
void SliceWriter::set_skipped_rows(const gpu::Gpu& original) {
  const auto differs = [&] { return gpu_.state().skipped_rows != original.state().skipped_rows; };
  if (!differs()) return;
  port0(std::array{gp0::draw_mode::make(original.state().draw_mode)});
  port1(gp1::make(gp1::Command::display_mode, original.display().mode));
  port1(gp1::make(gp1::Command::display_start, original.display().start));
  if (differs()) vsync();
}

void SliceWriter::end(std::uint64_t frame) {
  const gpu::Display shown = timeline_.seek({.frame = frame, .command = whole_frame}).display();
  port1(gp1::make(gp1::Command::display_mode, shown.mode));
  port1(gp1::make(gp1::Command::display_start, shown.start));
  port1(gp1::make(gp1::Command::horizontal_range, shown.horizontal_range));
  port1(gp1::make(gp1::Command::vertical_range, shown.vertical_range));
  port1(gp1::display_off::make(shown.is_off));
  vsync();
  slice_.dump.drawing_commands = slice_.kept.size();
}

}  // namespace debug
