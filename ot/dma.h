#pragma once
// The registers of DMA channels 2 (GPU) and 6 (OTC, which clears ordering tables), to the bit: what a program
// sees that drives them by itself.   [docs/hardware.md#dma-registers, docs/hardware.md#otc,
// docs/hardware.md#linked-list-dma]
//
// Not modelled: time. Nothing moves until run(), and a run moves as much as it can. Where the sources
// disagree: a channel's flag needs its mask bit and the master enable; a linked list with the direction bit
// clear is sent all the same; the step bit is ignored in linked-list mode; other channels read 0.

#include <array>
#include <cstdint>
#include <span>

#include "ot/field.h"
#include "ot/main_ram.h"

namespace ot {

namespace dma {
/// Register addresses: channel n is at base + 10h * n.
inline constexpr std::uint32_t base = 0x1f801080, dpcr = 0x1f8010f0, dicr = 0x1f8010f4;
constexpr std::uint32_t madr(std::uint32_t channel) { return base + 0x10 * channel; }
constexpr std::uint32_t bcr(std::uint32_t channel) { return base + 0x10 * channel + 4; }
constexpr std::uint32_t chcr(std::uint32_t channel) { return base + 0x10 * channel + 8; }

inline constexpr std::uint32_t gpu = 2, otc = 6;  ///< the channels

namespace block {              // BCR; 0 means 10000h
using Words = Field<0, 16>;    ///< burst: all words; slice: words of one block
using Blocks = Field<16, 16>;  ///< slice: blocks to go
}  // namespace block
namespace control {               // CHCR
using ToDevice = Field<0, 1>;     ///< 0: device to RAM
using Backwards = Field<1, 1>;    ///< addresses step by -4
using Chopping = Field<8, 1>;     ///< burst mode in windows
using Mode = Field<9, 2>;         ///< DmaMode
using ChopWindow = Field<16, 3>;  ///< 2^n words
using Busy = Field<24, 1>;        ///< written 1: start; reads 0 when done
using Trigger = Field<28, 1>;     ///< start without a request; cleared when the transfer begins
}  // namespace control
namespace interrupt {        // DICR
using Error = Field<15, 1>;  ///< bus error; forces the master flag
using Masks = Field<16, 7>;  ///< channels that may set their flag
using Enable = Field<23, 1>;
using Flags = Field<24, 7>;   ///< of channels that completed; written 1: cleared
using Master = Field<31, 1>;  ///< read only; its rising edge is the interrupt
}  // namespace interrupt
}  // namespace dma

enum class DmaMode : std::uint32_t { burst, slice, linked_list, reserved };

/// What DMA2 needs of a GPU.
class DmaPort {
 public:
  virtual ~DmaPort() = default;
  virtual void gp0(std::span<const std::uint32_t> words) = 0;
  virtual std::uint32_t read() = 0;    ///< GPUREAD
  virtual std::uint32_t status() = 0;  ///< GPUSTAT: DmaRequest and DmaDirection are looked at
};

/// Any object with these three members as a port, gpu::Gpu for one. It must outlive the port.
template <class Device>
class PortOf final : public DmaPort {
 public:
  explicit PortOf(Device& device) : device_(device) {}
  void gp0(std::span<const std::uint32_t> words) override { device_.gp0(words); }
  std::uint32_t read() override { return device_.read(); }
  std::uint32_t status() override { return device_.status(); }

 private:
  Device& device_;
};

/// The RAM must outlive it. After construction the registers are as after reset: DPCR 07654321h, the rest 0.
class Dma {
 public:
  explicit Dma(MainRam& ram) : ram_(ram) {}

  /// A register by its address; others read 0 and take no value.
  [[nodiscard]] std::uint32_t read(std::uint32_t address) const;
  void write(std::uint32_t address, std::uint32_t word);

  /// Moves data until nothing is left that can move, or `budget` tags and words have moved (it ends on a
  /// node, block or window, so a little more may have). Returns how many did. A list that loops is still busy
  /// then, as on the console; clearing CHCR bit 24 stops it.
  std::uint64_t run(DmaPort& port, std::uint64_t budget);

  [[nodiscard]] bool is_busy(std::uint32_t channel) const;
  /// IRQ3: true once for each time that DICR bit 31 rose.
  bool take_interrupt();

 private:
  struct Channel {
    std::uint32_t madr = 0, bcr = 0, chcr = 0;
    bool has_begun = false;  // the trigger bit is gone, but the transfer goes on
  };

  [[nodiscard]] Channel* channel_at(std::uint32_t address);
  [[nodiscard]] bool can_move(std::uint32_t number, DmaPort& port) const;
  std::uint64_t move(std::uint32_t number, DmaPort& port);
  std::uint64_t clear_table(Channel& c);
  std::uint64_t send_node(Channel& c, DmaPort& port);
  std::uint64_t move_block(Channel& c, DmaPort& port);
  std::uint64_t move_burst(Channel& c, DmaPort& port);
  bool move_words(Channel& c, DmaPort& port, std::uint32_t count);
  void complete(Channel& channel);
  void bus_error(Channel& channel);
  void set_dicr(std::uint32_t word);
  [[nodiscard]] std::uint32_t number_of(const Channel& c) const { return &c == &gpu_ ? dma::gpu : dma::otc; }

  MainRam& ram_;
  Channel gpu_, otc_{.chcr = dma::control::Backwards::put(1)};
  std::uint32_t dpcr_ = 0x07654321, dicr_ = 0;
  bool interrupt_ = false;
};

}  // namespace ot
