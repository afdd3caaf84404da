#pragma once
// How wrong a setting is, each kind of error by itself.

#include <array>
#include <cstdint>

#include "cost/axes.h"
#include "cost/subject.h"
#include "inspect/causes.h"

namespace cost {

/// Distances: mean, 95th percentile, greatest.
struct Distance {
  double mean = 0, p95 = 0, greatest = 0;
};

struct Errors {
  std::uint64_t pixels_drawn = 0, wrong_pixels = 0;
  std::array<std::uint64_t, inspect::cause_count> causes{};
  Distance geometric_px;  ///< vertices from where float64 puts them
  Distance texel;         ///< texture coordinates from exact projection, texels
  double colour_rms = 0, block_rms = 0, psnr = 99, ssim = 1;  ///< against the reference picture
  double edge_rms = 0;                                        ///< against exact area coverage

  [[nodiscard]] double wrong_share() const {
    return pixels_drawn == 0 ? 0 : static_cast<double>(wrong_pixels) / static_cast<double>(pixels_drawn);
  }
  /// The number an axis is about, in the unit of its MeasureInfo.
  [[nodiscard]] double of(Measure measure) const;
};

/// Measures all of them. Keeps what several settings share: the reference picture, verdicts of one
/// visibility.
class ErrorMeter {
 public:
  explicit ErrorMeter(Subject& subject, const scene::Knobs& given);
  /// Needs subject.draw(knobs) done just before: the picture is read from it.
  base::Result<Errors> measure(const scene::Knobs& knobs);
  /// The picture of the reference knobs, at the console's resolution. Empty until measure() or prepare().
  [[nodiscard]] const base::Picture& reference() const { return reference_; }
  base::Result<void> prepare();

 private:
  base::Result<void> judge_surfaces(const scene::Knobs& knobs, Errors& errors);
  Distance geometric(const scene::Knobs& knobs);
  base::Result<Distance> texel(const scene::Knobs& knobs);
  double edge(const scene::Knobs& knobs);

  Subject& subject_;
  scene::Knobs given_;
  base::Picture reference_;
  std::map<std::string, Errors> verdicts_;      // by the knobs that decide visibility
  std::map<std::string, Distance> geometrics_;  // by those that place vertices
  std::map<std::string, Distance> texels_;
  std::map<std::string, double> edges_;
};

/// Root mean square difference between the edges of fixed triangles drawn with `knobs` and their exact area
/// coverage, over the pixels an edge crosses; a pixel is the square of side 1 round its sample point. 0..1.
double edge_error(const scene::Knobs& knobs);

}  // namespace cost
