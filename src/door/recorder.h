#pragma once
// What goes into a GPU, kept as a dump that begins with the state it was in.

#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "base/result.h"
#include "dump/dump.h"
#include "gpu/gpu.h"

namespace door {

/// A dump begins between two commands. While one is open that began before the recording did, its words are
/// left out; what they do is in the state that follows.
class Recorder {
 public:
  explicit Recorder(std::filesystem::path path) : path_(std::move(path)) {}

  /// Before words are sent to the GPU: begins, or goes on after a jump, if that is possible now. False: it is
  /// not, and what comes is not kept.
  bool catch_up(const gpu::Gpu& gpu);
  /// Words that went to the port.
  void gp0(std::span<const std::uint32_t> words);
  void gp1(std::uint32_t word);
  /// Words that were read from GPUREAD.
  void reads(std::size_t words) { reads_ += is_waiting_ ? 0 : words; }
  void vblank();
  /// The GPU was given another state than the words led to.
  void jump();

  /// Writes the file, whole or not at all.
  base::Result<void> finish(const gpu::Gpu& gpu);

 private:
  void put_state(const gpu::Gpu& gpu);
  void put_reads();
  void put_words();

  std::filesystem::path path_;
  dump::Dump dump_;
  std::vector<std::uint32_t> words_;  // of GP0, not yet a packet
  std::size_t reads_ = 0;
  bool is_waiting_ = true;
};

}  // namespace door
