#pragma once
// One block of words. Links are byte addresses in it, so a list is data, not pointers, and can be saved,
// loaded and damaged.
//
// Not modelled: the segments of the CPU's address space (bits 24-31 are dropped), scratchpad, access times.

#include <cstdint>
#include <span>
#include <vector>

namespace ot {

enum class RamSize : std::uint32_t {
  mib2 = 0x200000,  ///< the console's; the first 8 MiB are four mirrors of it
  mib8 = 0x800000,  ///< every address below bit 23 is memory of its own
};

/// Main RAM, zeroed at first. Addresses are bytes, masked to the size and to whole words, so every address is
/// safe. The object owns its memory; spans from words() live as long as it does.
class MainRam {
 public:
  explicit MainRam(RamSize size) : words_(static_cast<std::size_t>(size) / 4) {}

  [[nodiscard]] std::uint32_t size_bytes() const { return static_cast<std::uint32_t>(words_.size() * 4); }

  [[nodiscard]] std::uint32_t read(std::uint32_t address) const { return words_[index(address)]; }
  void write(std::uint32_t address, std::uint32_t word) { words_[index(address)] = word; }

  [[nodiscard]] std::span<std::uint32_t> words() { return words_; }
  [[nodiscard]] std::span<const std::uint32_t> words() const { return words_; }

 private:
  [[nodiscard]] std::size_t index(std::uint32_t address) const {
    return (address >> 2) & (words_.size() - 1);
  }

  std::vector<std::uint32_t> words_;
};

}  // namespace ot
