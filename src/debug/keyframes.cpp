#include "debug/keyframes.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <iterator>

#include "debug/hash.h"
#include "gpu/vram.h"

namespace debug {

void Keyframes::add(Place place, bool is_in_frame, std::span<const std::byte> state) {
  const auto next = std::ranges::upper_bound(keys_, place, {}, &Key::place);
  const Key* const last = next == keys_.begin() ? nullptr : &*std::prev(next);
  if (last != nullptr && last->place == place) return;
  Key key{.place = place, .is_in_frame = is_in_frame, .head = {}, .blocks = {}};
  const std::size_t head = state.size() % block_bytes;
  key.head.assign(state.begin(), state.begin() + static_cast<std::ptrdiff_t>(head));
  const std::size_t count = state.size() / block_bytes;
  key.blocks.reserve(count);
  // Blocks are compared from the end: what varies in length lies at the beginning.
  const bool is_alike = last != nullptr && last->blocks.size() == count;
  for (std::size_t n = 0; n < count; ++n)
    key.blocks.push_back(keep(state.data() + head + n * block_bytes, is_alike ? last : nullptr, n));
  head_bytes_ += key.head.size();
  keys_.insert(next, std::move(key));
}

std::uint32_t Keyframes::keep(const std::byte* block, const Key* like, std::size_t number) {
  const auto is_equal = [&](std::uint32_t index) {
    return std::memcmp(pool_[index]->data(), block, block_bytes) == 0;
  };
  if (like != nullptr && is_equal(like->blocks[number])) {
    ++uses_[like->blocks[number]];
    return like->blocks[number];
  }
  const auto hash = hash_of({block, block_bytes});
  const auto known = by_hash_.find(hash);
  if (known != by_hash_.end() && is_equal(known->second)) {
    ++uses_[known->second];
    return known->second;
  }
  std::uint32_t index = 0;
  if (free_.empty()) {
    index = static_cast<std::uint32_t>(pool_.size());
    pool_.emplace_back();
    uses_.push_back(1);
  } else {
    index = free_.back();
    free_.pop_back();
    uses_[index] = 1;
  }
  pool_[index] = std::make_unique<Block>();
  std::memcpy(pool_[index]->data(), block, block_bytes);
  by_hash_[hash] = index;  // of two blocks with one hash the later one is found
  return index;
}

void Keyframes::release(std::uint32_t block) {
  if (--uses_[block] != 0) return;
  const auto known = by_hash_.find(hash_of(*pool_[block]));
  if (known != by_hash_.end() && known->second == block) by_hash_.erase(known);
  pool_[block].reset();
  free_.push_back(block);
}

void Keyframes::thin() {
  std::vector<Key> kept;
  for (std::size_t n = 0; n < keys_.size(); ++n) {
    if (n % 2 == 0 || n + 1 == keys_.size()) {
      kept.push_back(std::move(keys_[n]));
      continue;
    }
    head_bytes_ -= keys_[n].head.size();
    for (const auto block : keys_[n].blocks) release(block);
  }
  keys_ = std::move(kept);
}

void Keyframes::clear() { *this = {}; }

const Keyframes::Key& Keyframes::before(Place place) const {
  const auto next = std::ranges::upper_bound(keys_, place, {}, &Key::place);
  assert(next != keys_.begin());
  return *std::prev(next);
}

std::vector<std::byte> Keyframes::state_of(const Key& key) const {
  std::vector<std::byte> state(key.head.size() + key.blocks.size() * block_bytes);
  std::ranges::copy(key.head, state.begin());
  std::byte* to = state.data() + key.head.size();
  for (const auto block : key.blocks) {
    std::memcpy(to, pool_[block]->data(), block_bytes);
    to += block_bytes;
  }
  return state;
}

std::uint16_t Keyframes::pixel(const Key& key, std::uint32_t at) const {
  constexpr std::size_t vram_blocks = gpu::Vram::size * 2 / block_bytes;
  const std::size_t byte = std::size_t{at} * 2;
  const Block& block = *pool_[key.blocks[key.blocks.size() - vram_blocks + byte / block_bytes]];
  return static_cast<std::uint16_t>(std::to_integer<unsigned>(block[byte % block_bytes]) |
                                    std::to_integer<unsigned>(block[byte % block_bytes + 1]) << 8);
}

std::uint64_t Keyframes::bytes() const {
  constexpr std::uint64_t map_entry = 48, heap = 16;  // of the allocator, beside what is asked for
  const std::uint64_t refs = keys_.empty() ? 0 : keys_.size() * (keys_[0].blocks.size() * 4 + sizeof(Key));
  const std::uint64_t blocks = pool_.size() - free_.size();
  return head_bytes_ + refs + blocks * (block_bytes + heap) + pool_.capacity() * 16 +
         by_hash_.size() * map_entry;
}

}  // namespace debug
