#pragma once
// Words as they are sent, cut into the items of a clip.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "debug/clip.h"
#include "ot/command_stream.h"

namespace debug {

/// Appends to the items of a clip, which must outlive it.
class ItemCutter {
 public:
  explicit ItemCutter(std::vector<Item>& items) : items_(items) {}

  /// Where the words to come are from; see Item.
  void set_node(std::uint32_t address, std::uint32_t bucket, std::string origin);
  /// Words that end a command of which the beginning is not known. `counts`: the GPU begins to obey it here.
  void rest(std::span<const std::uint32_t> words, bool counts);
  /// Words to port 0.
  void gp0(std::span<const std::uint32_t> words);
  /// A word to port 1.
  void gp1(std::uint32_t word);
  /// What is left of an open command becomes an item too.
  void finish() { cut(); }

 private:
  void take(std::uint32_t word);
  [[nodiscard]] bool begins(bool is_whole) const;
  void cut();

  std::vector<Item>& items_;
  ot::CommandStream stream_;
  Item now_;
  std::uint32_t count_ = 0, address_ = 0, bucket_ = gpu::no_bucket;
  std::string origin_;
};

}  // namespace debug
