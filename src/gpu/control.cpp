// GP1, GPUSTAT and GPUREAD.

#include "gpu/gpu.h"
#include "ot/gp1.h"

namespace gpu {

void Gpu::gp1(std::uint32_t word) {
  using gp1::Command;
  ++next_command_;
  switch (gp1::command_of(word)) {
    case Command::reset:
      abort_command();
      clut_.invalidate();
      annotation_ = {};
      current_.state = {};
      display_ = {};
      irq_ = false;
      dma_direction_ = 0;
      break;
    case Command::clear_fifo:
      abort_command();
      break;
    case Command::acknowledge_irq:
      irq_ = false;
      break;
    case Command::display_off:
      display_.is_off = gp1::display_off::IsOff::get(word) != 0;
      break;
    case Command::dma_direction:
      dma_direction_ = gp1::dma_direction::Direction::get(word);
      break;
    case Command::display_start:
      display_.start = gp1::display_start::All::get(word);
      break;
    case Command::horizontal_range:
      display_.horizontal_range = gp1::horizontal_range::All::get(word);
      break;
    case Command::vertical_range:
      display_.vertical_range = gp1::vertical_range::All::get(word);
      break;
    case Command::display_mode:
      display_.mode = gp1::display_mode::All::get(word);
      break;
    case Command::allow_texture_disable:
      texture_disable_allowed_ = gp1::allow_texture_disable::IsAllowed::get(word) != 0;
      break;
    case Command::read_register:
      latch_register(gp1::read_register::Number::get(word));
      break;
    case Command::unknown:
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
  namespace status = ot::gpu_status;
  const DrawState& state = current_.state;
  const std::uint32_t mode = display_.mode;
  const bool sends = download_.is_active();
  const bool takes = !sends;
  const bool requests[] = {false, true, takes, sends};  // by DMA direction; the FIFO is never full
  return status::DrawMode::put(state.draw_mode) | status::Mask::put(state.mask) |
         status::OddField::put(!display_.is_interlaced() || display_.odd_field) |
         status::IsReversed::put(gp1::display_mode::IsReversed::get(mode)) |
         status::TextureDisable::put(gp0::draw_mode::TextureDisable::get(state.draw_mode)) |
         status::IsWidth368::put(gp1::display_mode::IsWidth368::get(mode)) | status::DisplayMode::put(mode) |
         status::IsDisplayOff::put(display_.is_off) | status::Irq::put(irq_) |
         status::DmaRequest::put(requests[dma_direction_]) |
         status::ReadyForCommand::put(is_between_commands() && !sends) | status::ReadyToSend::put(sends) |
         status::ReadyForDma::put(takes) | status::DmaDirection::put(dma_direction_) |
         status::OddLine::put(display_.is_interlaced() ? display_.odd_field : display_.odd_frame);
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
  display_.odd_frame = !display_.odd_frame;
  update_skipped_rows();
}

/// Drawing to the displayed field is off by default: its rows are skipped. [docs/hardware.md#interlace-skip]
void Gpu::update_skipped_rows() {
  const bool skips =
      display_.is_480_lines() && display_.is_interlaced() && !current_.state.draws_to_display();
  const bool odd = ((display_.start_y() & 1) != 0) != display_.odd_field;
  current_.state.skipped_rows = !skips ? SkippedRows::none : odd ? SkippedRows::odd : SkippedRows::even;
}

}  // namespace gpu
