// GP0: words are gathered until a command is whole, then it runs. A command that lies whole in the caller's
// words is read where it lies.

#include <algorithm>

#include "gpu/canvas/canvas.h"
#include "gpu/gpu.h"
#include "ot/gp0.h"

namespace gpu {

namespace {

/// What ot/gp0.h says of each opcode, looked up instead of decided.
struct Opening {
  gp0::Command command;
  std::uint8_t words;
};

constexpr auto openings = [] {
  std::array<Opening, 256> table{};
  for (std::uint32_t opcode = 0; opcode < 256; ++opcode) {
    const std::uint32_t word = gp0::Opcode::put(opcode);
    table[opcode] = {gp0::command_of(word), static_cast<std::uint8_t>(gp0::command_words(word))};
  }
  return table;
}();

}  // namespace

/// What is open comes before what begins: pixels of an upload, vertices of a polyline, the rest of a command.
void Gpu::gp0(std::span<const std::uint32_t> words) {
  counters_.words += words.size();
  const std::uint32_t* at = words.data();
  const std::uint32_t* const end = at + words.size();
  while (at != end) {
    if (upload_.is_active()) {
      at = upload(at, end);
    } else if (polyline_open_) {
      at = continue_polyline(at, end);
    } else if (gathered_count_ != 0) {
      at = gather(at, end);
    } else {
      at = run_commands(at, end);
    }
  }
}

/// Whole commands, up to one that leaves something open.
const std::uint32_t* Gpu::run_commands(const std::uint32_t* at, const std::uint32_t* end) {
  while (at != end) {
    const Opening opening = openings[gp0::Opcode::get(*at)];
    if (opening.command == gp0::Command::annotation) {
      at = annotate(at, end);
      continue;
    }
    if (end - at < opening.words) return gather(at, end);
    execute(at);
    at += opening.words;
    if (opening.command == gp0::Command::upload || opening.command == gp0::Command::polyline) break;
  }
  return at;
}

const std::uint32_t* Gpu::gather(const std::uint32_t* at, const std::uint32_t* end) {
  if (gathered_count_ == 0) gathered_[gathered_count_++] = *at++;
  const std::size_t needed = openings[gp0::Opcode::get(gathered_[0])].words;
  const auto taken = std::min(needed - gathered_count_, static_cast<std::size_t>(end - at));
  std::copy_n(at, taken, gathered_.begin() + static_cast<std::ptrdiff_t>(gathered_count_));
  gathered_count_ += taken;
  if (gathered_count_ == needed) {
    gathered_count_ = 0;
    execute(gathered_.data());
  }
  return at + taken;
}

void Gpu::execute(const std::uint32_t* words) {
  ++next_command_;
  switch (openings[gp0::Opcode::get(words[0])].command) {
    case gp0::Command::nop:
    case gp0::Command::annotation:  // run_commands has them
      break;
    case gp0::Command::clear_cache:
      clut_.invalidate();
      break;
    case gp0::Command::irq:
      irq_ = true;
      break;
    case gp0::Command::polygon:
      polygon(words);
      break;
    case gp0::Command::line:
    case gp0::Command::polyline:
      line(words);
      break;
    case gp0::Command::rectangle:
      rectangle(words);
      break;
    case gp0::Command::fill:
      fill(words);
      break;
    case gp0::Command::copy:
      copy(words);
      break;
    case gp0::Command::upload:
      begin_upload(words);
      break;
    case gp0::Command::download:
      begin_download(words);
      break;
    default:
      set_attribute(words[0]);
      break;
  }
}

void Gpu::set_attribute(std::uint32_t word) {
  DrawState& state = current_.state;
  switch (gp0::command_of(word)) {
    case gp0::Command::draw_mode:
      state.draw_mode = gp0::draw_mode::All::get(allowed_mode(word));
      update_skipped_rows();
      break;
    case gp0::Command::texture_window:
      state.texture_window = gp0::texture_window::All::get(word);
      break;
    case gp0::Command::area_top_left:
      state.area_top_left = gp0::draw_area::All::get(word);
      break;
    case gp0::Command::area_bottom_right:
      state.area_bottom_right = gp0::draw_area::All::get(word);
      break;
    case gp0::Command::draw_offset:
      state.offset = gp0::draw_offset::All::get(word);
      break;
    default:
      state.mask = gp0::mask_bits::All::get(word);
      break;
  }
}

/// E7h-EFh from `at` on: kept until the next polygon, which decodes them.
const std::uint32_t* Gpu::annotate(const std::uint32_t* at, const std::uint32_t* end) {
  constexpr std::uint32_t first = gp0::annotation::depth_high, codes = 9;
  for (; at != end; ++at) {
    std::uint32_t place = gp0::Opcode::get(*at) - first;
    if (place >= codes) break;
    if (place == 0 && (annotation_.seen & 1) != 0) place = codes;  // the second E7h
    annotation_.words[place] = *at;
    annotation_.seen |= 1U << place;
  }
  return at;
}

/// GP1(00h), GP1(01h): whatever is open is dropped.
void Gpu::abort_command() {
  gathered_count_ = 0;
  polyline_open_ = false;
  upload_ = {};
  download_ = {};
}

}  // namespace gpu
