#pragma once
// The effects of a frame that was recorded: there is no scene, only the words that drew it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cost/effects.h"
#include "cost/sweep.h"
#include "gpu/depth.h"

namespace cost {

struct RecordedFrame {
  /// Words sent to one port, whole commands unless they are the rest of one that began before.
  struct Piece {
    bool is_control = false;
    bool is_rest = false;
    std::vector<std::uint32_t> words;
  };
  std::string name;
  std::uint32_t frame = 0;
  int width = 0, height = 0;      ///< of the display area
  std::vector<std::byte> before;  ///< the state of the GPU, as gpu::Gpu::save() has it
  std::vector<Piece> pieces;
  std::optional<gpu::DepthOptions> depth;  ///< drawn with a z-buffer
};

/// As cost::find_effects of a scene. What its packets do not say (lighting, fog) is in none of the effects.
base::Result<EffectReport> find_effects(const RecordedFrame& frame, int rounds = 0,
                                        const KeepGoing& keep_going = {});

/// The axes that a recording has: visibility, its own list order against z-buffers, where its polygons carry
/// depth. What cannot be measured is named in `skipped`. `options.given`: near and far.
base::Result<SceneResult> sweep(const RecordedFrame& frame, const SweepOptions& options);

}  // namespace cost
