#pragma once
// Which effects a frame calls for, and what each costs: the frame is drawn again without it.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "cost/subject.h"

namespace cost {

struct Effect {
  std::string name;
  std::uint64_t primitives = 0;  ///< that ask for it; of a knob and of fog: all polygons
  std::uint64_t pixels = 0;      ///< that those wrote
  double ms = 0;      ///< median of what the frame takes less without it, and without those before it
  double spread = 0;  ///< of these differences, quartile to quartile
  /// The price cannot be told from 0.
  [[nodiscard]] bool is_within_noise() const { return ms <= spread; }
};

/// What a frame takes as it is and then without one effect after the other: steps[k] gives what it takes
/// without effects 0..k. All are taken in turn, so that each is beside its neighbours in time; to and fro.
class Chain {
 public:
  using Timed = std::function<base::Result<double>()>;
  explicit Chain(Timed whole) { steps_.push_back({{}, std::move(whole), {}, {}}); }
  void add(Effect effect, Timed without) {
    steps_.push_back({std::move(effect), std::move(without), {}, {}});
  }
  [[nodiscard]] std::size_t timings() const { return steps_.size(); }
  /// One round; `keep_going` is asked before each timing, and false ends it.
  void run(int round, const std::function<bool()>& keep_going);
  [[nodiscard]] double whole() const;      ///< median
  [[nodiscard]] double remainder() const;  ///< without all of them: whole() less all prices
  /// Adds every effect that was priced.
  void report(std::vector<Effect>& out) const;

 private:
  struct Step {
    Effect effect;
    Timed time;
    std::vector<double> times, differences;
  };
  std::vector<Step> steps_;
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
  std::vector<std::string>
      not_needed;                    ///< knobs, with their values, that change nothing here and cost nothing
  std::vector<std::string> kernels;  ///< that ran, most often first, with how often
  std::vector<NamedBytes> buffers;   ///< besides the 1 MiB of VRAM
  std::vector<std::string>
      notes;                ///< where the picture may differ from the console's for a reason of our own
  bool is_complete = true;  ///< false: keep_going ended it

  /// What is left of the frame without them: ms less their prices, which noise may make too high.
  [[nodiscard]] double rest_ms() const {
    double rest = ms;
    for (const Effect& effect : effects) rest -= effect.ms;
    return std::max(0.0, rest);
  }
};

/// Asked before each timing; false: report what is measured so far.
using KeepGoing = std::function<bool(std::size_t done, std::size_t all)>;

/// Knobs that are not at the console's setting though the frame has nothing that they are about: what is
/// drawn and allocated is the same without them.
std::vector<std::string> knobs_not_needed(Subject& subject, const scene::Knobs& knobs);

/// Error: the frame cannot be drawn. `rounds` timings of each variant; 0: as many as it takes for prices to
/// settle, within about two seconds. Prices add up: knobs are lowered one after the other, then packets lose
/// one effect after the other, and light and fog are what the vertices take less without them.
base::Result<EffectReport> find_effects(const scene::Scene& scene, std::uint32_t frame,
                                        const scene::Knobs& knobs, int rounds = 0,
                                        const KeepGoing& keep_going = {});

/// The kernels of the console's GPU that ran, most often first, with how often.
std::vector<std::string> kernels_that_ran(const gpu::Counters& counters);

std::string to_text(const EffectReport& report);
/// {"schema":"otter.effects/1",...}
std::string to_json(const EffectReport& report);

}  // namespace cost
