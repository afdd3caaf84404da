// What the window looks at in a frame, command by command.

#include "app/window/lens.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <set>
#include <vector>

#include "app/tape.h"
#include "app/viewer.h"
#include "app/window/timeline_bar.h"
#include "app/window/vram_view.h"
#include "debug/timeline.h"
#include "demos/demos.h"

namespace {

using app::Step, app::StepBy;

struct Looking {
  explicit Looking(const char* scene, scene::Knobs knobs = {})
      : subject(demos::make(*demos::find(scene)), knobs) {
    state.knobs = knobs;
    REQUIRE(lens.update(state, subject));
    REQUIRE(lens.view() != nullptr);
  }
  app::Viewer subject;
  app::WindowState state;
  app::Lens lens;
};

std::uint32_t xy(int x, int y) { return static_cast<std::uint32_t>(x | y << 16); }

/// Each frame fills the screen and draws a square a pixel further to the right.
std::shared_ptr<debug::Timeline> squares(int frames) {
  dump::Dump dump;
  for (int n = 0; n < frames; ++n) {
    const std::array<std::uint32_t, 10> words{0xe3000000,   0xe4000000 | 1023 | 511 << 10,
                                              0x02000000,   0,
                                              xy(320, 240), 0x600000ff,
                                              xy(n, 0),     xy(4, 4),
                                              0xe1000000,   0xe6000000};
    dump.add(dump::PacketType::port0, words);
    dump.add(dump::PacketType::port1, std::array<std::uint32_t, 3>{0x03000000, 0x05000000, 0x08000001});
    dump.add(dump::PacketType::vsync);
    ++dump.vsyncs;
  }
  return std::make_shared<debug::Timeline>(debug::Recording(std::move(dump)));
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("a scene taken apart shows what the scene shows") {
    Looking at("crates");
    REQUIRE(at.subject.draw(0, at.state.knobs));
    at.state.lens.edits.hidden = {100'000};  // of nothing
    REQUIRE(at.lens.update(at.state, at.subject));
    const auto picture = at.lens.picture(at.state);
    REQUIRE(picture);
    CHECK(picture->pixels == at.subject.picture().pixels);
  }

  TEST_CASE("polygons of a scene are named by instance and face, and keep their names from frame to frame") {
    Looking at("crates");
    const auto& items = at.lens.view()->clip().items;
    const auto named =
        std::find_if(items.begin(), items.end(), [](const auto& i) { return i.origin == "i2/f3"; });
    REQUIRE(named != items.end());
    CHECK(named->key);
    at.state.lens.selected = static_cast<std::size_t>(named - items.begin());
    at.state.frame = 1;
    REQUIRE(at.lens.update(at.state, at.subject));
    REQUIRE(at.state.lens.selected);
    CHECK(at.lens.view()->clip().items[*at.state.lens.selected].origin == "i2/f3");
  }

  TEST_CASE(
      "stepping forward from everything begins with the first command, and back from it with the last") {
    Looking at("cyclic");
    app::take_step(at.state, at.lens, {StepBy::command, true});
    CHECK(at.state.paused);
    CHECK(at.state.lens.shown == 1);
    app::take_step(at.state, at.lens, {StepBy::command, false});
    CHECK(at.state.lens.shown == 0);
    app::take_step(at.state, at.lens, {StepBy::command, false});
    CHECK(at.state.lens.shown == 0);
    at.state.lens.shown.reset();
    app::take_step(at.state, at.lens, {StepBy::command, false});
    CHECK(at.state.lens.shown == at.lens.view()->rows().size() - 1);
    app::take_step(at.state, at.lens, {StepBy::command, true});
    CHECK_FALSE(at.state.lens.shown);
  }

  TEST_CASE("stepping by group ends where the bucket changes, and selects the last command drawn") {
    Looking at("crates");
    const auto rows = at.lens.view()->rows();
    at.state.lens.shown = 0;
    while (at.state.lens.shown) {
      app::take_step(at.state, at.lens, {StepBy::group, true});
      if (!at.state.lens.shown) break;
      const auto shown = *at.state.lens.shown;
      CHECK(rows[shown].bucket != rows[shown - 1].bucket);
      CHECK(at.state.lens.selected == rows[shown - 1].item);
    }
  }

  TEST_CASE("stepping by wrong pixels finds a command that is seen where it should not be") {
    Looking at("cyclic");
    app::take_step(at.state, at.lens, {StepBy::wrong, true});
    REQUIRE(at.state.lens.shown);
    CHECK(at.lens.view()->rows()[*at.state.lens.shown - 1].wrong > 0);
  }

  TEST_CASE("a pixel that is clicked selects the command seen there, opens its bucket and is pinned") {
    Looking at("crates");
    const auto rows = at.lens.view()->rows();
    const auto seen = std::find_if(rows.rbegin(), rows.rend(), [](const auto& row) { return row.seen > 10; });
    REQUIRE(seen != rows.rend());
    const auto pixels = at.lens.view()->pixels_of(*seen);
    const auto own = std::find_if(pixels.begin(), pixels.end(), [&](auto pixel) {
      return at.lens.view()->row_at(pixel) == static_cast<std::size_t>(&*seen - rows.data());
    });
    REQUIRE(own != pixels.end());
    app::pick(at.state.lens, *at.lens.view(), *own);
    CHECK(at.state.lens.selected == seen->item);
    CHECK(at.state.lens.pinned == *own);
    CHECK(at.state.lens.open_bucket == seen->bucket);
  }

  TEST_CASE(
      "the list shows the heads of buckets, the rows of the open one, and with a filter all that are left") {
    Looking at("crates");
    auto& lens = at.state.lens;
    const auto lines = app::table_lines(*at.lens.view(), lens);
    CHECK(std::all_of(lines.begin(), lines.end(), [](const auto& line) { return line.is_head; }));
    lens.open_bucket = lines.back().group;
    CHECK(app::table_lines(*at.lens.view(), lens).size() == lines.size() + lines.back().count);
    lens.filter.only_drawing = true;
    std::size_t rows = 0;
    for (const auto& line : app::table_lines(*at.lens.view(), lens)) rows += line.is_head ? 0 : 1;
    CHECK(rows == at.lens.view()->filtered(lens.filter).size());
  }

  TEST_CASE("the bars of the histogram hold every bucket once") {
    Looking at("corridor");
    for (const std::size_t columns : {1U, 7U, 100U, 5000U}) {
      std::uint32_t next = 0, commands = 0;
      for (const auto& bar : app::histogram(*at.lens.view(), columns)) {
        CHECK(bar.first == next);
        next = bar.last + 1;
        commands += bar.commands;
      }
      CHECK(next == at.lens.view()->clip().buckets);
      const auto buckets = at.lens.view()->buckets();
      CHECK(commands == std::accumulate(buckets.begin(), buckets.end(), 0U));
    }
  }

  TEST_CASE("any frame of a recording is shown, in any order, and one beyond the last is the last") {
    app::Tape tape("squares", squares(5));
    CHECK(tape.last_frame() == 5);
    const auto left_edge = [&tape](std::int64_t frame) {
      REQUIRE(tape.draw(frame, {}, {}));
      int x = 0;
      while (tape.picture().at(x, 0).r == 0) ++x;
      return x;
    };
    CHECK(left_edge(4) == 3);
    CHECK(left_edge(1) == 0);
    CHECK(left_edge(5) == 4);
    CHECK(left_edge(99) == 4);
  }

  TEST_CASE("a z-buffer without depths draws a recording as the console does") {
    app::Tape tape("squares", squares(3));
    REQUIRE(tape.draw(2, {}, {}));
    const auto console = tape.vram();
    scene::Knobs knobs;
    knobs.visibility = scene::Visibility::zbuffer;
    REQUIRE(tape.draw(2, knobs, {}));
    CHECK(tape.vram() == console);
    knobs.visibility = scene::Visibility::bsp;
    CHECK_FALSE(tape.draw(2, knobs, {}));
  }

  TEST_CASE("knobs that a recording cannot follow say why") {
    const app::Tape tape("squares", squares(1));
    // What asks for the world that the packets came from.
    const std::set<std::string_view> worldly{"transform", "key", "buckets", "fog", "subdivide"};
    const std::set<std::string_view> followed{"visibility",    "depth",   "near",
                                              "without-depth", "texture", "resolution"};
    for (const auto& knob : scene::knob_table()) {
      CAPTURE(std::string(knob.name));
      if (worldly.contains(knob.name)) CHECK_FALSE(tape.why_idle(knob).empty());
      if (followed.contains(knob.name)) CHECK(tape.why_idle(knob).empty());
    }
  }

  TEST_CASE("a program with two buffers is shown where it draws, unless the display is asked for") {
    gpu::Gpu gpu;
    gpu.gp1(0x08000001);
    gpu.gp1(0x05000000);
    gpu.gp0(std::array{0xe3000000U | 240 << 10, 0xe4000000U | 319 | 479 << 10});
    CHECK(app::shown_area(gpu, app::Shown::either).y == 240);
    CHECK(app::shown_area(gpu, app::Shown::display).y == 0);
    gpu.gp1(0x05000000 | 240 << 10);
    CHECK(app::shown_area(gpu, app::Shown::either).y == 240);
  }

  TEST_CASE("a recording plays its loop again and again, or all of it") {
    app::WindowState state;
    state.pace = app::Pace::hz50;
    state.recorded.last = 10;
    state.frame = 9;
    app::let_pass(state, 0);
    CHECK(state.frame == 10);
    app::let_pass(state, 0);
    CHECK(state.frame == 1);
    state.frame = 4;
    app::handle(state, {app::KeyAction::loop});
    state.frame = 6;
    app::handle(state, {app::KeyAction::loop});
    app::let_pass(state, 0);
    CHECK(state.frame == 4);
    app::handle(state, {app::KeyAction::loop});
    CHECK_FALSE(state.recorded.from);
  }

  TEST_CASE("in slow motion ten calls are one frame") {
    app::WindowState state;
    state.pace = app::Pace::slow;
    for (int n = 0; n < 30; ++n) app::let_pass(state, 0);
    CHECK(state.frame == 3);
  }

  TEST_CASE("a place on the bar is a frame, and the middle of a frame is that frame") {
    CHECK(app::frame_at(0, 100) == 1);
    CHECK(app::frame_at(1, 100) == 100);
    CHECK(app::frame_at(-1, 100) == 1);
    for (const std::int64_t last : {1, 2, 7, 36'000}) {
      for (std::int64_t frame = 1; frame <= last; frame += 1 + last / 50) {
        CHECK(app::frame_at(app::place_of_frame(frame, last), last) == frame);
      }
    }
    CHECK(app::commands_at(0, 8) == 0);
    CHECK(app::commands_at(0.5, 8) == 4);
    CHECK_FALSE(app::commands_at(1, 8));
  }

  TEST_CASE("zooming VRAM keeps what is under the mouse there, and shows nothing beyond its edges") {
    app::VramState vram;
    const auto under = [&vram] { return vram.x + 0.3 * 1024 / vram.zoom; };
    const double before = under();
    app::zoom_vram(vram, 5, 0.3, 0.6);
    CHECK(under() == doctest::Approx(before));
    app::pan_vram(vram, 100, 100);
    CHECK(vram.x + 1024 / vram.zoom == doctest::Approx(1024));
    CHECK(vram.y + 512 / vram.zoom == doctest::Approx(512));
    app::zoom_vram(vram, -100, 0.5, 0.5);
    CHECK(vram.zoom == 1);
    CHECK(vram.x == doctest::Approx(0));
  }

  TEST_CASE("VRAM read as indices shows the colours of the palette, low bits first") {
    std::vector<std::uint16_t> vram(1024 * 512);
    vram[5] = 0x0321;
    vram[1024 * 7 + 16 + 1] = 0x001f;
    vram[1024 * 7 + 16 + 2] = 0x03e0;
    vram[1024 * 7 + 16 + 3] = 0x7c00;
    vram[1024 * 7 + 16 + 0x21] = 0x7fff;
    const auto four = display::vram_picture(vram, display::VramFormat::bits4, {16, 7});
    CHECK(four.width == 4096);
    CHECK(four.at(20, 0) == base::Rgba{255, 0, 0});
    CHECK(four.at(21, 0) == base::Rgba{0, 255, 0});
    CHECK(four.at(22, 0) == base::Rgba{0, 0, 255});
    const auto eight = display::vram_picture(vram, display::VramFormat::bits8, {16, 7});
    CHECK(eight.width == 2048);
    CHECK(eight.at(10, 0) == base::Rgba{255, 255, 255});
    CHECK(eight.at(11, 0) == base::Rgba{0, 0, 255});
    CHECK(display::vram_picture(vram, display::VramFormat::bits24, {}).width == 682);
    CHECK(display::vram_picture(vram, display::VramFormat::bits15, {}).at(17, 7) == base::Rgba{255, 0, 0});
  }
}
