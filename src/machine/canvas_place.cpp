#include "machine/canvas_place.h"

#include "scene/accurate.h"

namespace machine {

bool draws_picture(const gpu::Gpu& gpu) {
  const auto& state = gpu.state();
  const int width = state.right() - state.left() + 1, height = state.bottom() - state.top() + 1;
  return width > 0 && height > 0 && width * height * 2 >= gpu.display().width() * gpu.display().height();
}

base::Result<std::optional<Corner>> place_canvas(gpu::Gpu& gpu, gpu::canvas::Options options) {
  if (!draws_picture(gpu)) return std::nullopt;
  const auto& state = gpu.state();
  options.width = state.right() - state.left() + 1;
  options.height = state.bottom() - state.top() + 1;
  if (auto checked = scene::check_size(options); !checked) return tl::make_unexpected(checked.error());
  gpu.set_canvas(options);
  gpu.begin_frame(state.left(), state.top());
  return Corner{state.left(), state.top()};
}

}  // namespace machine
