#include "gpu/canvas/resolve.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gpu::canvas {
namespace {

constexpr std::uint32_t one = 65536;

double falloff(Reconstruction filter, double distance) {
  switch (filter) {
    case Reconstruction::box:
      return distance >= -0.5 && distance < 0.5 ? 1 : 0;
    case Reconstruction::tent:
      return std::max(0.0, 1 - std::abs(distance));
    case Reconstruction::gauss:
      break;
  }
  constexpr double deviation = 0.5;
  constexpr double radius = 1.5;
  return std::abs(distance) < radius ? std::exp(-distance * distance / (2 * deviation * deviation)) : 0;
}

/// 5 bits in the high end of a byte, widened to the whole byte.
constexpr Pixel widen_bytes(Pixel five) { return five | (five >> 5 & 0x070707U); }

base::Rgba rgba(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
}

/// One sample a pixel and no filter: the frame is the picture.
base::Picture copy(const Canvas& canvas) {
  base::Picture picture(canvas.width(), canvas.height());
  const bool five = canvas.options().colour == Colour::bits15;
  std::ranges::transform(canvas.layer(0), picture.pixels.begin(), [five](Pixel p) {
    if (five) p = widen_bytes(p & 0xf8f8f8U);
    return rgba(p, p >> 8, p >> 16);
  });
  return picture;
}

/// What is averaged of each stored byte, and the byte of an average in 65536ths of it.
struct Scale {
  explicit Scale(AverageOf average) : is_light(average == AverageOf::light) {
    for (std::uint32_t byte = 0; byte < 256; ++byte) of_byte[byte] = is_light ? to_light(byte) : byte;
  }
  [[nodiscard]] std::uint32_t byte_of(std::uint32_t sum) const {
    return is_light ? from_light(sum >> 16) : sum >> 16;
  }
  std::array<std::uint32_t, 256> of_byte{};
  bool is_light;
};

/// Weighted sums of one row of the picture, three channels a pixel.
void add_row(std::vector<std::uint32_t>& sums, std::span<const Pixel> row, std::size_t samples,
             const Tap& tap, bool five, const Scale& scale) {
  const int width = static_cast<int>(row.size() / samples);
  for (int x = 0; x < width; ++x) {
    const auto source = static_cast<std::size_t>(std::clamp(x + tap.dx, 0, width - 1));
    const Pixel raw = row[source * samples + tap.sample];
    const Pixel p = five ? widen_bytes(raw & 0xf8f8f8U) : raw;
    const auto at = static_cast<std::size_t>(x) * 3;
    sums[at] += scale.of_byte[p & 255] * tap.weight;
    sums[at + 1] += scale.of_byte[p >> 8 & 255] * tap.weight;
    sums[at + 2] += scale.of_byte[p >> 16 & 255] * tap.weight;
  }
}

}  // namespace

std::vector<Tap> filter_taps(const Options& options, Reconstruction filter) {
  struct Weighted {
    Tap tap;
    double weight;
  };
  std::vector<Weighted> taps;
  double total = 0;
  const auto add = [&](std::size_t layer, std::size_t sample, Point at) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const double x = dx + static_cast<double>(at.x) / units_per_pixel;
        const double y = dy + static_cast<double>(at.y) / units_per_pixel;
        const double weight = falloff(filter, x) * falloff(filter, y);
        if (weight <= 0) continue;
        taps.push_back({{layer, sample, dx, dy, 0}, weight});
        total += weight;
      }
    }
  };
  if (options.samples.empty()) {
    for (std::size_t i = 0; i < options.layers.size(); ++i) add(i, 0, options.layers[i]);
  } else {
    for (std::size_t s = 0; s < options.samples.size(); ++s) add(0, s, options.samples[s]);
  }
  // Each weight is the difference of two rounded running sums, so that they sum to exactly one.
  std::vector<Tap> result;
  double running = 0;
  std::uint32_t given = 0;
  for (auto& [tap, weight] : taps) {
    running += weight;
    const auto until = static_cast<std::uint32_t>(std::lround(running / total * one));
    tap.weight = until - given;
    given = until;
    if (tap.weight != 0) result.push_back(tap);
  }
  return result;
}

std::uint32_t to_light(std::uint32_t byte) {
  static const auto table = [] {
    std::array<std::uint32_t, 256> lights{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const double v = static_cast<double>(i) / 255;
      const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
      lights[i] = static_cast<std::uint32_t>(std::lround(light * 65535));
    }
    return lights;
  }();
  return table[byte];
}

std::uint32_t from_light(std::uint32_t light) {
  static const auto table = [] {
    std::vector<std::uint8_t> bytes(65536);
    std::uint32_t byte = 0;
    for (std::uint32_t i = 0; i < bytes.size(); ++i) {
      while (byte < 255 && 2 * i > to_light(byte) + to_light(byte + 1)) ++byte;
      bytes[i] = static_cast<std::uint8_t>(byte);
    }
    return bytes;
  }();
  return table[light];
}

base::Picture resolve(const Canvas& canvas, Reconstruction filter, AverageOf average) {
  const auto taps = filter_taps(canvas.options(), filter);
  if (taps.size() == 1) return copy(canvas);
  base::Picture picture(canvas.width(), canvas.height());
  const bool five = canvas.options().colour == Colour::bits15;
  const auto samples = canvas.samples();
  const auto row_samples = static_cast<std::size_t>(picture.width) * samples;
  std::vector<std::uint32_t> sums(static_cast<std::size_t>(picture.width) * 3);
  const Scale scale(average);
  for (int y = 0; y < picture.height; ++y) {
    std::ranges::fill(sums, one / 2);
    for (const Tap& tap : taps) {
      const auto line = static_cast<std::size_t>(std::clamp(y + tap.dy, 0, picture.height - 1));
      add_row(sums, canvas.layer(tap.layer).subspan(line * row_samples, row_samples), samples, tap, five,
              scale);
    }
    for (int x = 0; x < picture.width; ++x) {
      const auto at = static_cast<std::size_t>(x) * 3;
      picture.at(x, y) =
          rgba(scale.byte_of(sums[at]), scale.byte_of(sums[at + 1]), scale.byte_of(sums[at + 2]));
    }
  }
  return picture;
}

const base::Picture& Accumulator::add(const base::Picture& frame, AverageOf average) {
  constexpr int memory = 8;  // frames: the length of the jitter sequence
  constexpr std::array channels{&base::Rgba::r, &base::Rgba::g, &base::Rgba::b};
  const auto values = frame.pixels.size() * channels.size();
  if (history_.size() != values || shown_.width != frame.width || average_ != average) {
    history_.assign(values, 0);
    shown_ = frame;
    frames_ = 0;
    average_ = average;
  }
  const bool is_light = average == AverageOf::light;
  frames_ = std::min(frames_ + 1, memory);
  auto past = history_.begin();
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      for (const auto channel : channels) {
        const auto scaled = [channel, is_light](const base::Rgba& p) {
          return static_cast<int>(is_light ? to_light(p.*channel) : std::uint32_t{p.*channel} << 8);
        };
        const int value = scaled(frame.at(x, y));
        int low = value;
        int high = value;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int beside = scaled(frame.nearest(x + dx, y + dy));
            low = std::min(low, beside);
            high = std::max(high, beside);
          }
        }
        const int kept = frames_ == 1 ? value : std::clamp<int>(*past, low, high);
        const int mixed = kept + (value - kept) / frames_;
        *past++ = static_cast<std::uint16_t>(mixed);
        shown_.at(x, y).*channel = static_cast<std::uint8_t>(
            is_light ? from_light(static_cast<std::uint32_t>(mixed))
                     : static_cast<std::uint32_t>(std::min((mixed + 128) >> 8, 255)));
      }
    }
  }
  return shown_;
}

}  // namespace gpu::canvas
