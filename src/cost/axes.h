#pragma once
// The axes of the cost report: for each approximation of the console, its settings from cheap to accurate.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/knobs.h"

namespace cost {

/// Which number tells how wrong a setting is. All are 0 for a perfect one, except psnr and ssim.
enum class Measure : std::uint8_t {
  wrong_surface,  ///< share of the drawn pixels that show a surface that is not the true one
  geometric,      ///< mean distance of the vertices from their exact place, pixels
  texel,          ///< mean distance of texture coordinates from the exact ones, texels
  colour,         ///< root mean square difference from the reference, of 255
  block_colour,   ///< the same of the means of 4 x 4 pixels
  edge,           ///< root mean square difference from exact area coverage on edge pixels, 0..1
};
inline constexpr std::size_t measure_count = 6;
struct MeasureInfo {
  std::string_view key;         ///< in JSON and CSV
  std::string_view noun, unit;  ///< for people
  [[nodiscard]] std::string name() const { return std::string(noun) + ", " + std::string(unit); }
};
const MeasureInfo& info(Measure measure);

/// One setting: what the knobs of its axis are set to.
struct Setting {
  struct Value {
    std::string_view knob, value;
  };
  std::string_view name;
  std::vector<Value> values;
  bool in_quick = true;
};

struct Axis {
  std::string_view name;          ///< as --axes has it
  std::string_view question;      ///< what is paid for, as the subject of a sentence
  Measure measure;                ///< the error the axis is about
  std::vector<Setting> settings;  ///< cheap to accurate
  std::size_t console = 0;        ///< index of the console's setting
  /// Swept down without super-sampling: the axis is itself a way of sampling, or decided sample by sample.
  bool without_samples = false;
};

/// In the order of the report.
std::span<const Axis> axes();
/// nullptr: no axis of that name.
const Axis* find_axis(std::string_view name);

/// `base` with one setting of an axis.
scene::Knobs with(const scene::Knobs& base, const Setting& setting);

/// The console's knobs, keeping picture size and table length of `given`.
scene::Knobs console_knobs(const scene::Knobs& given);
/// The most accurate knobs from which axes are swept down. Anti-aliasing is 16 samples; the reference picture
/// has 64.
scene::Knobs accurate_knobs(const scene::Knobs& given);
scene::Knobs reference_knobs(const scene::Knobs& given);

/// Combinations across axes: the Pareto front is drawn from them and from all that the axes measure.
struct Combination {
  std::string name;
  scene::Knobs knobs;
};
std::vector<Combination> combinations(const scene::Knobs& given, bool quick);

}  // namespace cost
