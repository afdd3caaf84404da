#pragma once
// A packet's words to the GPU, without a list between.

#include <array>
#include <cstdint>
#include <span>

#include "gpu/gpu.h"
#include "ot/packet.h"

namespace stability {

template <class Packet>
void send(gpu::Gpu& gpu, const Packet& packet) {
  std::array<std::uint32_t, 16> words{};
  gpu.gp0(std::span(words).first(ot::encode(packet, words)));
}

}  // namespace stability
