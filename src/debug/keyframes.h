#pragma once
// Saved states of a GPU along a recording. Between two of them most of VRAM stays as it is: what is equal is
// kept once. Where there is no room left every second one goes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "debug/frames.h"

namespace debug {

class Keyframes {
 public:
  struct Key {
    Place place;
    bool is_in_frame = false;
    std::vector<std::byte> head;        // what is left of the state in front of whole blocks
    std::vector<std::uint32_t> blocks;  // indices into the pool, up to the end of the state
  };

  /// Keeps `state`, as gpu::Gpu::save() has it, unless there is one of that place.
  void add(Place place, bool is_in_frame, std::span<const std::byte> state);
  /// Drops every second one, but neither the first nor the last.
  void thin();
  void clear();

  [[nodiscard]] bool is_empty() const { return keys_.empty(); }
  [[nodiscard]] std::size_t size() const { return keys_.size(); }
  [[nodiscard]] const Key& operator[](std::size_t index) const { return keys_[index]; }
  /// The last one at or before `place`. There has to be one.
  [[nodiscard]] const Key& before(Place place) const;
  /// The state that was given to add().
  [[nodiscard]] std::vector<std::byte> state_of(const Key& key) const;
  /// A halfword of VRAM in a state without a depth plane, by y * 1024 + x.
  [[nodiscard]] std::uint16_t pixel(const Key& key, std::uint32_t at) const;

  /// What all of them take in memory.
  [[nodiscard]] std::uint64_t bytes() const;

 private:
  static constexpr std::size_t block_bytes = 256;
  using Block = std::array<std::byte, block_bytes>;

  std::uint32_t keep(const std::byte* block, const Key* like, std::size_t number);
  void release(std::uint32_t block);

  std::vector<Key> keys_;  // by place
  // Each block by itself, so that what thinning frees is free.
  std::vector<std::unique_ptr<Block>> pool_;
  std::vector<std::uint32_t> uses_;  // of each block of the pool
  std::vector<std::uint32_t> free_;  // places in the pool that have no block
  std::unordered_map<std::uint64_t, std::uint32_t> by_hash_;
  std::uint64_t head_bytes_ = 0;
};

}  // namespace debug
