#include "machine/present.h"

#include <algorithm>

#include "display/scanout.h"
#include "gpu/canvas/canvas.h"
#include "gpu/canvas/sample_pattern.h"

namespace machine {
namespace {

namespace canvas = gpu::canvas;
using scene::AntialiasKind;

base::Picture to_picture(const canvas::Image& image) {
  base::Picture picture(image.width, image.height);
  std::ranges::transform(image.pixels, picture.pixels.begin(), [](std::uint32_t p) {
    return base::Rgba{static_cast<std::uint8_t>(p), static_cast<std::uint8_t>(p >> 8),
                      static_cast<std::uint8_t>(p >> 16)};
  });
  return picture;
}

canvas::Image to_image(const base::Picture& picture) {
  canvas::Image image(picture.width, picture.height);
  std::ranges::transform(picture.pixels, image.pixels.begin(), [](base::Rgba p) {
    return std::uint32_t{p.r} | std::uint32_t{p.g} << 8 | std::uint32_t{p.b} << 16 | 0xff000000U;
  });
  return image;
}

base::Picture shown(const gpu::Gpu& gpu) {
  return display::scan_out(gpu.vram().pixels(), display::area_of(gpu.display()));
}

}  // namespace

int Presenter::frames_before(const scene::Knobs& knobs) {
  return knobs.antialias.kind == AntialiasKind::taa ? canvas::jitter_length - 1 : 0;
}

base::Picture Presenter::show(const gpu::Gpu& gpu, const scene::Knobs& knobs) {
  if (knobs.antialias.kind != AntialiasKind::taa) accumulator_ = {};
  if (gpu.canvas() == nullptr) {
    if (knobs.antialias.kind != AntialiasKind::fxaa) return shown(gpu);
    return to_picture(canvas::fxaa(to_image(shown(gpu))));
  }
  const auto image = canvas::resolve(*gpu.canvas(), knobs.aa_filter);
  switch (knobs.antialias.kind) {
    case AntialiasKind::fxaa:
      return to_picture(canvas::fxaa(image));
    case AntialiasKind::taa:
      return to_picture(accumulator_.add(image));
    default:
      return to_picture(image);
  }
}

}  // namespace machine
