#include "machine/present.h"

#include "display/scanout.h"
#include "gpu/canvas/canvas.h"
#include "gpu/canvas/sample_pattern.h"

namespace machine {
namespace {

namespace canvas = gpu::canvas;
using scene::AntialiasKind;

}  // namespace

int Presenter::frames_before(const scene::Knobs& knobs) {
  return knobs.antialias.kind == AntialiasKind::taa ? canvas::jitter_length - 1 : 0;
}

base::Picture Presenter::show(base::Picture scanned, const scene::Knobs& knobs) {
  return knobs.antialias.kind == AntialiasKind::fxaa ? canvas::fxaa(scanned) : scanned;
}

base::Picture Presenter::show(const gpu::Gpu& gpu, const scene::Knobs& knobs) {
  if (knobs.antialias.kind != AntialiasKind::taa) accumulator_ = {};
  if (gpu.canvas() == nullptr)
    return show(display::scan_out(gpu.vram().pixels(), display::area_of(gpu.display())), knobs);
  auto picture = canvas::resolve(*gpu.canvas(), knobs.aa_filter, knobs.aa_space);
  switch (knobs.antialias.kind) {
    case AntialiasKind::fxaa:
      return canvas::fxaa(picture);
    case AntialiasKind::taa:
      return accumulator_.add(picture, knobs.aa_space);
    default:
      return picture;
  }
}

}  // namespace machine
