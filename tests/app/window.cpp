// The window itself, on SDL's dummy driver: what the outside world does to it.

#include "app/window/window.h"

#include <SDL.h>
#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "app/viewer.h"
#include "app/window/window_state.h"
#include "demos/demos.h"
#include "load/pictures.h"

namespace {

namespace fs = std::filesystem;

app::WindowOptions resting_window() {
  app::WindowOptions options;
  options.scenes.push_back({"crates",
                            [](const scene::Knobs& knobs) {
                              return base::Result<std::unique_ptr<app::Subject>>(
                                  std::make_unique<app::Viewer>(demos::make(*demos::find("crates")), knobs));
                            },
                            false});
  options.first.paused = true;
  options.scale = 1;
  return options;
}

/// Runs a window that finds these events waiting.
base::Result<int> run_with(const app::WindowOptions& options, const std::vector<Uint32>& events) {
  setenv("SDL_VIDEODRIVER", "dummy", 1);
  REQUIRE(SDL_Init(SDL_INIT_EVENTS) == 0);
  for (const auto type : events) {
    SDL_Event event{};
    event.type = type;
    REQUIRE(SDL_PushEvent(&event) == 1);
  }
  return app::run_window(options);
}

/// The console's picture in the window: the status line below it tells the time.
std::vector<std::uint32_t> picture_after(app::WindowOptions options, const std::vector<Uint32>& events) {
  const auto path = fs::temp_directory_path() / ("otter_tests_window_" + std::to_string(getpid()) + ".png");
  options.frames = 3;
  options.screenshot = path.string();
  REQUIRE(run_with(options, events));
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  fs::remove(path);
  auto image = load::decode_picture(bytes);
  REQUIRE(image);
  std::vector<std::uint32_t> picture;
  for (std::size_t i = 0; i < static_cast<std::size_t>(image->width) * 240; ++i) {
    const auto& p = image->pixels[i];
    picture.push_back(p.r | std::uint32_t{p.g} << 8 | std::uint32_t{p.b} << 16);
  }
  return picture;
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("a window that is closed ends the program with exit 0, without waiting for --frames") {
    const auto status = run_with(resting_window(), {SDL_QUIT});
    REQUIRE(status);
    CHECK(*status == 0);
  }

  TEST_CASE("a file that is dropped on the window is opened and shown; one that cannot be is no end") {
    setenv("SDL_VIDEODRIVER", "dummy", 1);
    for (const bool is_good : {true, false}) {
      REQUIRE(SDL_Init(SDL_INIT_EVENTS) == 0);
      SDL_Event event{};
      event.type = SDL_DROPFILE;
      event.drop.file = SDL_strdup("dropped.psxgpu");
      REQUIRE(SDL_PushEvent(&event) == 1);
      auto options = resting_window();
      int made = 0;
      options.open = [&made, is_good](const std::string& path) -> base::Result<app::WindowScene> {
        CHECK(path == "dropped.psxgpu");
        if (!is_good) return base::fail("dropped.psxgpu: cannot be read");
        return app::WindowScene{
            path, [&made](const scene::Knobs& knobs) {
              ++made;
              return base::Result<std::unique_ptr<app::Subject>>(
                  std::make_unique<app::Viewer>(demos::make(*demos::find("cyclic")), knobs));
            }};
      };
      options.frames = 3;
      REQUIRE(app::run_window(options));
      CHECK(made == (is_good ? 1 : 0));
    }
  }

  TEST_CASE(
      "a window whose textures the graphics driver has lost shows the same picture again, at rest too") {
    std::vector<app::WindowOptions> windows(4, resting_window());
    windows[1].first.split = true;
    windows[2].first.dock.raise(app::Panel::vram);
    windows[3].first.dock.raise(app::Panel::inspect);
    windows[3].first.map = app::Map::errors;
    for (const auto& window : windows) {
      const auto whole = picture_after(window, {});
      CHECK(std::count(whole.begin(), whole.end(), whole.front()) <
            static_cast<std::ptrdiff_t>(whole.size()));
      CHECK(picture_after(window, {SDL_RENDER_DEVICE_RESET}) == whole);
      CHECK(picture_after(window, {SDL_RENDER_TARGETS_RESET, SDL_RENDER_DEVICE_RESET}) == whole);
    }
  }
}
