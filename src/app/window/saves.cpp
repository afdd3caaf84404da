#include "app/window/saves.h"

#include <system_error>

#include "base/picture.h"
#include "debug/clip.h"
#include "display/png.h"
#include "dump/dump_file.h"

namespace app {

std::filesystem::path free_name(const std::string& scene, std::int64_t frame, const std::string& what,
                                const std::string& extension) {
  const auto stem =
      "otter-" + std::filesystem::path(scene).stem().string() + "-" + std::to_string(frame) + what;
  std::filesystem::path path = stem + extension;
  std::error_code ignored;
  for (int n = 2; std::filesystem::exists(path, ignored); ++n) {
    path = stem + "-" + std::to_string(n) + extension;
  }
  return path;
}

base::Result<void> save_window(SDL_Renderer* renderer, const std::filesystem::path& path) {
  int width = 0;
  int height = 0;
  SDL_GetRendererOutputSize(renderer, &width, &height);
  base::Picture picture(width, height);
  if (SDL_RenderReadPixels(renderer, nullptr, SDL_PIXELFORMAT_RGBA32, picture.pixels.data(), width * 4) !=
      0) {
    return base::fail(path.string() + ": the window cannot be read back: " + SDL_GetError(),
                      base::Exit::failed);
  }
  return display::write_png(path, picture);
}

base::Result<void> save_changes(debug::FrameView& view, const std::filesystem::path& path) {
  return dump::write_dump(path, dump::DumpFormat::standard, [&](dump::DumpWriter& writer) {
    debug::write_clip(view.edited(), writer);
    return base::Result<void>{};
  });
}

}  // namespace app
