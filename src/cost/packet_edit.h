#pragma once
// A frame's words with one effect taken away from every packet.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/primitive.h"

namespace cost {

/// An effect that packets ask for.
struct PacketEffect {
  std::string_view name;
  bool (*asks)(const gpu::Primitive&);  ///< does a decoded primitive ask for it?
};
std::span<const PacketEffect> packet_effects();

/// `words` (whole commands, as a walk gives them) drawn the same, but without effect `index` of
/// packet_effects().
std::vector<std::uint32_t> without(std::span<const std::uint32_t> words, std::size_t index);

}  // namespace cost
