// GP1, GPUSTAT and GPUREAD.

#include "gpu/gpu.h"
#include "ot/field.h"

namespace gpu {

using ot::Field;

namespace {

/// GP1 words: bits 24-29 say which; 40h-FFh mirror 00h-3Fh. [psx-spx, GPU Display Control Commands]
enum Control : std::uint32_t {
  reset = 0x00,
  clear_fifo = 0x01,
  acknowledge_irq = 0x02,
  display_off = 0x03,
  dma_direction = 0x04,
  display_start = 0x05,
  horizontal_range = 0x06,
  vertical_range = 0x07,
  display_mode = 0x08,
  allow_texture_disable = 0x09,
};

namespace status_bits {
using DrawMode = Field<0, 11>;
using Mask = Field<11, 2>;
using Field_ = Field<13, 1>;  ///< the field being output; 1 when not interlaced
using Reverse = Field<14, 1>;
using TextureDisable = Field<15, 1>;
using Width368 = Field<16, 1>;
using Mode = Field<17, 6>;  ///< GP1(08h) bits 0-5
using DisplayOff = Field<23, 1>;
using Irq = Field<24, 1>;
using DmaRequest = Field<25, 1>;
using ReadyForCommand = Field<26, 1>;
using ReadyToSend = Field<27, 1>;
using ReadyForDma = Field<28, 1>;
using DmaDirection = Field<29, 2>;
}  // namespace status_bits

}  // namespace

void Gpu::gp1(std::uint32_t word) {
  switch (const std::uint32_t control = word >> 24 & 0x3f) {
    case reset:
      abort_command();
      clut_.invalidate();
      annotation_ = {};
      current_.state = {};
      display_ = {};
      irq_ = false;
      dma_direction_ = 0;
      break;
    case clear_fifo:
      abort_command();
      break;
    case acknowledge_irq:
      irq_ = false;
      break;
    case display_off:
      display_.is_off = (word & 1) != 0;
      break;
    case dma_direction:
      dma_direction_ = word & 3;
      break;
    case display_start:
      display_.start = word & 0x7ffff;
      break;
    case horizontal_range:
      display_.horizontal_range = word & 0xffffff;
      break;
    case vertical_range:
      display_.vertical_range = word & 0xfffff;
      break;
    case display_mode:
      display_.mode = word & 0xff;
      break;
    case allow_texture_disable:
      texture_disable_allowed_ = (word & 1) != 0;
      break;
    default:
      if (control >= 0x10 && control < 0x20) latch_register(word & 15);
      break;
  }
  update_skipped_rows();
}

/// GP1(10h): a register, by the low 4 bits of the word, to be read through GPUREAD; other
/// numbers leave the latch alone.
void Gpu::latch_register(std::uint32_t number) {
  constexpr std::uint32_t gpu_version = 2;
  const DrawState& state = current_.state;
  switch (number) {
    case 2:
      latch_ = state.texture_window;
      break;
    case 3:
      latch_ = state.area_top_left;
      break;
    case 4:
      latch_ = state.area_bottom_right;
      break;
    case 5:
      latch_ = state.offset;
      break;
    case 7:
      latch_ = gpu_version;
      break;
    case 8:
      latch_ = 0;
      break;
    default:
      break;
  }
}

std::uint32_t Gpu::status() const {
  namespace bits = status_bits;
  const DrawState& state = current_.state;
  const std::uint32_t mode = display_.mode;
  const bool is_open = gathered_count_ != 0 || polyline_open_ || upload_.is_active();
  const bool sends = download_.is_active();
  const bool takes = !sends;
  const bool requests[] = {false, true, takes, sends};  // by DMA direction; the FIFO is never full
  return bits::DrawMode::put(state.draw_mode) | bits::Mask::put(state.mask) |
         bits::Field_::put(!display_.is_interlaced() || display_.odd_field) | bits::Reverse::put(mode >> 7) |
         bits::TextureDisable::put(state.draw_mode >> 11) | bits::Width368::put(mode >> 6) |
         bits::Mode::put(mode) | bits::DisplayOff::put(display_.is_off) | bits::Irq::put(irq_) |
         bits::DmaRequest::put(requests[dma_direction_]) | bits::ReadyForCommand::put(!is_open && !sends) |
         bits::ReadyToSend::put(sends) | bits::ReadyForDma::put(takes) |
         bits::DmaDirection::put(dma_direction_);
}

std::uint32_t Gpu::read() {
  if (!download_.is_active()) return latch_;
  std::uint32_t word = 0;
  for (int half = 0; half < 32 && download_.is_active(); half += 16) {
    const std::uint32_t pixel = vram_.at(download_.x + download_.column, download_.y + download_.row);
    word |= pixel << half;
    download_.advance(1);
  }
  return word;
}

void Gpu::next_field() {
  display_.odd_field = display_.is_interlaced() && !display_.odd_field;
  update_skipped_rows();
}

/// Drawing to the displayed field is off by default: its rows are skipped. [psx-spx, GP0(E1h) bit 10]
void Gpu::update_skipped_rows() {
  const bool draws_to_display = (current_.state.draw_mode >> 10 & 1) != 0;
  const bool skips = display_.is_480_lines() && display_.is_interlaced() && !draws_to_display;
  const bool odd = ((display_.start_y() & 1) != 0) != display_.odd_field;
  current_.state.skipped_rows = !skips ? SkippedRows::none : odd ? SkippedRows::odd : SkippedRows::even;
}

}  // namespace gpu
