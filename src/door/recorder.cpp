#include "door/recorder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/write_file.h"
#include "ot/gp1.h"

namespace door {

namespace {

using dump::PacketType;

namespace gp1 = ot::gp1;

/// GP1 words that bring a reset GPU to what is displayed.
std::array<std::uint32_t, 6> display_words(const gpu::Gpu& gpu) {
  const gpu::Display& d = gpu.display();
  return {gp1::make(gp1::Command::reset),
          gp1::display_off::make(d.is_off),
          gp1::make(gp1::Command::display_start, d.start),
          gp1::make(gp1::Command::horizontal_range, d.horizontal_range),
          gp1::make(gp1::Command::vertical_range, d.vertical_range),
          gp1::make(gp1::Command::display_mode, d.mode)};
}

std::array<std::uint32_t, 6> attribute_words(const gpu::DrawState& s) {
  return {0xe1000000 | s.draw_mode,         0xe2000000 | s.texture_window, 0xe3000000 | s.area_top_left,
          0xe4000000 | s.area_bottom_right, 0xe5000000 | s.offset,         0xe6000000 | s.mask};
}

}  // namespace

bool Recorder::catch_up(const gpu::Gpu& gpu) {
  if (!is_waiting_) return true;
  if (!gpu.is_between_commands()) return false;
  is_waiting_ = false;
  const bool is_first = dump_.packets.empty();
  put_state(gpu);
  if (is_first) dump_.add(PacketType::trace_begin);
  return true;
}

void Recorder::put_state(const gpu::Gpu& gpu) {
  dump_.add(PacketType::port1, display_words(gpu));
  const bool may_disable_textures = (gpu.state().draw_mode >> 11 & 1) != 0;
  const std::uint32_t permission =
      gp1::make(gp1::Command::allow_texture_disable, may_disable_textures ? 1 : 0);
  dump_.add(PacketType::port1, std::span(&permission, 1));
  // Mask bits are off after the reset: the upload is taken as it is.
  std::vector<std::uint32_t> upload{0xa0000000, 0, gpu::Vram::height << 16 | gpu::Vram::width};
  const auto pixels = gpu.vram().pixels();
  for (std::size_t i = 0; i < pixels.size(); i += 2)
    upload.push_back(std::uint32_t{pixels[i]} | std::uint32_t{pixels[i + 1]} << 16);
  dump_.add(PacketType::port0, upload);
  dump_.add(PacketType::port0, attribute_words(gpu.state()));
  // The rows that an interlaced picture skips are those of its field.
  if (gpu.display().is_interlaced() && gpu.display().odd_field) dump_.add(PacketType::vsync);
  const std::uint32_t direction = gp1::dma_direction::make(ot::gpu_status::DmaDirection::get(gpu.status()));
  dump_.add(PacketType::port1, std::span(&direction, 1));
}

void Recorder::gp0(std::span<const std::uint32_t> words) {
  if (is_waiting_) return;
  put_reads();
  words_.insert(words_.end(), words.begin(), words.end());
}

void Recorder::gp1(std::uint32_t word) {
  if (is_waiting_) return;
  put_words();
  put_reads();
  dump_.add(PacketType::port1, std::span(&word, 1));
}

void Recorder::vblank() {
  if (is_waiting_) return;
  put_words();
  put_reads();
  dump_.add(PacketType::vsync);
}

void Recorder::jump() {
  put_words();
  put_reads();
  is_waiting_ = true;
}

/// A read that comes after words that are not a packet yet makes them one.
void Recorder::put_reads() {
  constexpr std::size_t most = 1024 * 512 / 2;  // the most that a dump may ask for at once
  while (reads_ > 0) {
    put_words();
    const auto count = static_cast<std::uint32_t>(std::min(reads_, most));
    dump_.add(PacketType::discard, std::span(&count, 1));
    reads_ -= count;
  }
}

void Recorder::put_words() {
  if (words_.empty()) return;
  dump_.add(PacketType::port0, words_);
  words_.clear();
}

base::Result<void> Recorder::finish(const gpu::Gpu& gpu) {
  catch_up(gpu);
  put_words();
  put_reads();
  // A dump ends between commands.
  const std::uint32_t clear_fifo = gp1::make(gp1::Command::clear_fifo);
  dump_.add(PacketType::port1, std::span(&clear_fifo, 1));
  return base::write_file(path_, dump::write_dump(dump_, dump::DumpFormat::standard));
}

}  // namespace door
