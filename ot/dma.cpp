#include "ot/dma.h"

#include <algorithm>
#include <utility>

#include "ot/gp1.h"
#include "ot/links.h"

namespace ot {
namespace {

using namespace dma;

constexpr std::uint32_t address_mask = 0xffffff;
constexpr std::uint32_t gpu_control_mask = 0x71770703;
/// OTC always is a burst from the device with step -4: only start, trigger and bit 30 can be written.
constexpr std::uint32_t otc_control_mask = 0x51000000;
constexpr std::uint32_t interrupt_stored = 0x00ff807f;

constexpr std::uint32_t or_64k(std::uint32_t count) { return count == 0 ? 0x10000 : count; }
using links::is_outside;

constexpr std::uint32_t stepped(std::uint32_t control_word, std::uint32_t address, std::uint32_t words) {
  const auto bytes = 4 * words;
  return (control::Backwards::get(control_word) != 0 ? address - bytes : address + bytes) & address_mask;
}

/// The request in GPUSTAT, if the direction set by GP1(04h) is that of the transfer.
bool requests(std::uint32_t gpustat, bool to_device) {
  const auto direction = gpu_status::DmaDirection::get(gpustat);
  return gpu_status::DmaRequest::get(gpustat) != 0 &&
         (to_device ? direction == 1 || direction == 2 : direction == 3);
}

}  // namespace

Dma::Channel* Dma::channel_at(std::uint32_t address) {
  if (address >> 4 == madr(dma::gpu) >> 4) return &gpu_;
  return address >> 4 == madr(dma::otc) >> 4 ? &otc_ : nullptr;
}

std::uint32_t Dma::read(std::uint32_t address) const {
  if (address == dma::dpcr) return dpcr_;
  if (address == dma::dicr) return dicr_;
  const auto* channel = const_cast<Dma*>(this)->channel_at(address);
  if (channel == nullptr) return 0;
  switch (address & 15) {
    case 0:
      return channel->madr;
    case 4:
      return channel->bcr;
    case 8:
      return channel->chcr;
    default:
      return 0;
  }
}

void Dma::write(std::uint32_t address, std::uint32_t word) {
  if (address == dma::dpcr) dpcr_ = word;
  if (address == dma::dicr) {
    const auto flags = dicr_ & ~word & interrupt::Flags::mask;
    set_dicr((word & interrupt_stored) | flags);
  }
  auto* const channel = channel_at(address);
  if (channel == nullptr) return;
  switch (address & 15) {
    case 0:
      channel->madr = word & address_mask;
      break;
    case 4:
      channel->bcr = word;
      break;
    case 8:
      channel->chcr =
          channel == &gpu_ ? word & gpu_control_mask : (word & otc_control_mask) | control::Backwards::put(1);
      channel->has_begun = false;
      break;
    default:
      break;
  }
}

bool Dma::is_busy(std::uint32_t channel) const { return control::Busy::get(read(chcr(channel))) != 0; }

bool Dma::take_interrupt() { return std::exchange(interrupt_, false); }

void Dma::set_dicr(std::uint32_t word) {
  const bool master = interrupt::Error::get(word) != 0 ||
                      (interrupt::Enable::get(word) != 0 && interrupt::Flags::get(word) != 0);
  const bool was = interrupt::Master::get(dicr_) != 0;
  dicr_ = interrupt::Master::set(word, master);
  interrupt_ = interrupt_ || (master && !was);
}

bool Dma::can_move(std::uint32_t number, DmaPort& port) const {
  const Channel& c = number == dma::gpu ? gpu_ : otc_;
  const bool enabled = (dpcr_ >> (4 * number) & 8) != 0;
  if (!enabled || control::Busy::get(c.chcr) == 0) return false;
  const bool triggered = c.has_begun || control::Trigger::get(c.chcr) != 0;
  if (number == dma::otc) return triggered;
  switch (static_cast<DmaMode>(control::Mode::get(c.chcr))) {
    case DmaMode::burst:
      return triggered || requests(port.status(), control::ToDevice::get(c.chcr) != 0);
    case DmaMode::slice:
      return requests(port.status(), control::ToDevice::get(c.chcr) != 0);
    case DmaMode::linked_list:
      return requests(port.status(), true);
    case DmaMode::reserved:
      break;
  }
  return false;
}

std::uint64_t Dma::run(DmaPort& port, std::uint64_t budget) {
  std::uint64_t moved = 0;
  while (moved < budget) {
    const bool gpu_ready = can_move(dma::gpu, port);
    const bool otc_ready = can_move(dma::otc, port);
    if (!gpu_ready && !otc_ready) break;
    // Priority 0 goes first; of equal ones the higher channel.
    const auto priority = [&](std::uint32_t number) { return dpcr_ >> (4 * number) & 7; };
    const bool otc_first = otc_ready && (!gpu_ready || priority(dma::otc) <= priority(dma::gpu));
    moved += move(otc_first ? dma::otc : dma::gpu, port);
  }
  return moved;
}

std::uint64_t Dma::move(std::uint32_t number, DmaPort& port) {
  Channel& c = number == dma::gpu ? gpu_ : otc_;
  c.has_begun = true;
  c.chcr = control::Trigger::set(c.chcr, 0);
  if (number == dma::otc) return clear_table(c);
  switch (static_cast<DmaMode>(control::Mode::get(c.chcr))) {
    case DmaMode::linked_list:
      return send_node(c, port);
    case DmaMode::slice:
      return move_block(c, port);
    default:
      return move_burst(c, port);
  }
}

/// Each entry links to the word below it, the last one ends the list. Below address 0 there is no RAM.
std::uint64_t Dma::clear_table(Channel& c) {
  const auto count = or_64k(block::Words::get(c.bcr));
  auto address = c.madr & ~3U;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (is_outside(address)) {
      bus_error(c);
      return k + 1;
    }
    const auto below = (address - 4) & (ram_.size_bytes() - 1);
    ram_.write(address, k == count - 1 ? tag::end : below);
    address = (address - 4) & address_mask;
  }
  complete(c);
  return count;
}

/// The end is tested after the payload of the node that carries it.
std::uint64_t Dma::send_node(Channel& c, DmaPort& port) {
  if (c.madr == tag::end) {
    complete(c);
    return 1;
  }
  if (is_outside(c.madr)) {
    bus_error(c);
    return 1;
  }
  const auto word = ram_.read(c.madr);
  const auto length = tag::Length::get(word);
  std::array<std::uint32_t, tag::Length::max> payload;
  for (std::uint32_t n = 0; n < length; ++n) payload[n] = ram_.read(c.madr + 4 * (n + 1));
  if (length > 0) port.gp0(std::span(payload).first(length));
  c.madr = tag::Next::get(word);
  if (c.madr == tag::end) complete(c);
  return 1 + length;
}

std::uint64_t Dma::move_block(Channel& c, DmaPort& port) {
  const auto words = or_64k(block::Words::get(c.bcr));
  if (move_words(c, port, words)) {
    const auto blocks = block::Blocks::get(c.bcr) - 1;  // 0 counts as 10000h: wraps to FFFFh
    c.bcr = block::Blocks::set(c.bcr, blocks);
    if (block::Blocks::get(c.bcr) == 0) complete(c);
  }
  return words;
}

/// MADR and BCR stay, unless chopping lets the CPU see them between windows.
std::uint64_t Dma::move_burst(Channel& c, DmaPort& port) {
  const auto words = or_64k(block::Words::get(c.bcr));
  if (control::Chopping::get(c.chcr) == 0) {
    const auto start = c.madr;
    if (move_words(c, port, words)) {
      c.madr = start;
      complete(c);
    }
    return words;
  }
  const auto window = std::min(words, std::uint32_t{1} << control::ChopWindow::get(c.chcr));
  if (move_words(c, port, window)) {
    c.bcr = block::Words::set(c.bcr, words - window);
    if (words == window) complete(c);
  }
  return window;
}

/// False: an address was outside RAM, and the transfer has ended there.
bool Dma::move_words(Channel& c, DmaPort& port, std::uint32_t count) {
  const bool to_device = control::ToDevice::get(c.chcr) != 0;
  for (std::uint32_t n = 0; n < count; ++n) {
    if (is_outside(c.madr)) {
      bus_error(c);
      return false;
    }
    if (to_device) {
      const std::array word{ram_.read(c.madr)};
      port.gp0(word);
    } else {
      ram_.write(c.madr, port.read());
    }
    c.madr = stepped(c.chcr, c.madr, 1);
  }
  return true;
}

void Dma::complete(Channel& channel) {
  channel.has_begun = false;
  channel.chcr = control::Busy::set(channel.chcr, 0);
  const auto bit = std::uint32_t{1} << number_of(channel);
  if ((interrupt::Masks::get(dicr_) & bit) != 0 && interrupt::Enable::get(dicr_) != 0) {
    set_dicr(dicr_ | interrupt::Flags::put(bit));
  }
}

void Dma::bus_error(Channel& channel) {
  channel.has_begun = false;
  channel.chcr = control::Busy::set(channel.chcr, 0);
  set_dicr(dicr_ | interrupt::Error::put(1));
}

}  // namespace ot
