#pragma once
// Which effects a frame calls for, and what each costs: the frame is drawn again without it.

#include <functional>
#include <string>
#include <vector>

#include "cost/subject.h"

namespace cost {

struct Effect {
  std::string name;
  std::uint64_t primitives = 0;  ///< that ask for it; of a knob and of fog: all polygons
  std::uint64_t pixels = 0;      ///< that those wrote
  double ms = 0;                 ///< the frame's time less that of the frame without the effect: median
  double spread = 0;             ///< of these differences, quartile to quartile
};

struct NamedBytes {
  std::string name;
  std::uint64_t bytes = 0;
};

struct EffectReport {
  std::string scene;
  std::uint32_t frame = 0;
  int width = 0, height = 0;
  double ms = 0;  ///< the whole frame
  std::vector<Effect> effects;
  std::vector<std::string> kernels;  ///< that ran, most often first, with how often
  std::vector<NamedBytes> buffers;   ///< besides the 1 MiB of VRAM
  std::vector<std::string>
      notes;                ///< where the picture may differ from the console's for a reason of our own
  bool is_complete = true;  ///< false: keep_going ended it
};

/// Asked before each timing; false: report what is measured so far.
using KeepGoing = std::function<bool(std::size_t done, std::size_t all)>;

/// Error: the frame cannot be drawn. `rounds` timings of each variant, each beside one of the whole frame; 0:
/// as many as it takes for prices to settle, within about two seconds.
base::Result<EffectReport> find_effects(const scene::Scene& scene, std::uint32_t frame,
                                        const scene::Knobs& knobs, int rounds = 0,
                                        const KeepGoing& keep_going = {});

/// The kernels of the console's GPU that ran, most often first, with how often.
std::vector<std::string> kernels_that_ran(const gpu::Counters& counters);

std::string to_text(const EffectReport& report);
/// {"schema":"otter.effects/1",...}
std::string to_json(const EffectReport& report);

}  // namespace cost
