// A program that runs elsewhere, as the window shows it.

#include "app/live.h"

#include <doctest/doctest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <thread>

#include "app/window/lens.h"
#include "app/window/program_keys.h"
#include "app/window/window_state.h"

namespace {

constexpr std::uint32_t xy(std::uint32_t x, std::uint32_t y) { return x | y << 16; }

/// A red square of two pixels at x, from a list in RAM, in bucket 5 of 8; and the display behind it.
door::LiveFrame frame(std::uint64_t number, std::uint32_t x) {
  gpu::Gpu gpu;
  gpu.gp0(std::array<std::uint32_t, 2>{0xe3000000, 0xe407ffff});
  gpu.gp1(0x08000001);
  gpu.gp1(0x06c60260);
  gpu.gp1(0x07040010);
  door::LiveFrame frame;
  frame.number = number;
  frame.state = gpu.save();
  frame.buckets = 8;
  frame.runs = {{.is_list = true, .address = 0x2000, .bucket = 5, .words = 3},
                {.is_control = true, .words = 1}};
  frame.words = {0x600000ff, xy(x, 0), xy(2, 2), 0x03000000};
  return frame;
}

std::shared_ptr<app::LiveReel> reel_of(std::initializer_list<std::uint64_t> numbers) {
  auto reel = std::make_shared<app::LiveReel>();
  for (const auto number : numbers) reel->add(frame(number, static_cast<std::uint32_t>(number)));
  return reel;
}

}  // namespace

TEST_SUITE("live") {
  TEST_CASE("a frame of a program is taken apart with addresses and buckets") {
    const auto clip = app::clip_of(frame(1, 4));
    REQUIRE(clip.items.size() == 2);
    CHECK(clip.is_list_in_ram);
    CHECK(clip.buckets == 8);
    CHECK(clip.items[0].address == 0x2000);
    CHECK(clip.items[0].bucket == 5);
    CHECK(clip.items[0].is_drawing());
    CHECK(clip.items[1].is_control);
  }

  TEST_CASE("the last frames are kept, and gone through across those that were let pass") {
    auto reel = reel_of({3, 4, 7});
    CHECK(reel->first() == 3);
    CHECK(reel->last() == 7);
    CHECK(reel->at(5).number == 4);
    CHECK(reel->at(1).number == 3);
    CHECK(reel->after(4) == 7);
    CHECK(reel->after(7) == 7);
    CHECK(reel->before(7) == 4);
    CHECK(reel->before(3) == 3);
    for (std::uint64_t n = 8; n < 8 + app::LiveReel::kept_frames; ++n) reel->add(frame(n, 0));
    CHECK(reel->first() == 8);
  }

  TEST_CASE(
      "a frame is drawn as it was sent, on a canvas where a knob asks for one, and through a z-buffer") {
    app::Live live(nullptr, reel_of({4}));
    REQUIRE(live.draw(4, {}, {}));
    CHECK(live.picture().width == 320);
    CHECK(live.picture().at(4, 0).r == 0xff);
    CHECK(live.picture().at(6, 0).r == 0);
    scene::Knobs knobs;
    knobs.resolution = 2;
    REQUIRE(live.draw(4, knobs, {}));
    CHECK(live.picture().width == 640);
    CHECK(live.picture().at(8, 0).r == 0xff);
    knobs = {};
    knobs.visibility = scene::Visibility::zbuffer;
    REQUIRE(live.draw(4, knobs, {}));
    CHECK(live.picture().at(4, 0).r == 0xff);
    knobs.visibility = scene::Visibility::bsp;
    CHECK_FALSE(live.draw(4, knobs, {}));
  }

  TEST_CASE("before the first frame there is a picture, and why it is black") {
    app::Live live(nullptr);
    REQUIRE(live.draw(1, {}, {}));
    CHECK(live.picture().width > 0);
    CHECK_FALSE(live.why_empty().empty());
    REQUIRE(live.clip(1, {}, {}));
    CHECK(live.clip(1, {}, {})->items.empty());
  }

  TEST_CASE("shares are told of polygons alone") {
    debug::Clip clip = app::clip_of(frame(1, 0));
    CHECK(app::to_text(app::shares_of(clip)) == "no polygons");
    debug::Item polygon{.bucket = 5};
    polygon.words = {0xe8001000, 0xe9001000, 0xea001000, 0x200000ff, 0, xy(1, 0), xy(0, 1)};
    clip.items.push_back(polygon);
    CHECK(app::to_text(app::shares_of(clip)) == "1 polygons: all with depth, all in buckets");
    polygon.words.erase(polygon.words.begin(), polygon.words.begin() + 3);
    polygon.bucket = gpu::no_bucket;
    for (int n = 0; n < 999; ++n) clip.items.push_back(polygon);
    CHECK(app::to_text(app::shares_of(clip)) == "1,000 polygons: 1 % with depth, 1 % in buckets");
  }

  TEST_CASE("frames come through the socket, requests go back, and the program's end is noticed") {
    std::array<int, 2> ends{};
    REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
    app::LiveLink link(ends[0], {});
    const auto bytes = door::to_bytes(frame(9, 1));
    const std::uint64_t length = bytes.size();
    REQUIRE(write(ends[1], &length, sizeof length) == sizeof length);
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const auto now = write(ends[1], bytes.data() + sent, bytes.size() - sent);
      REQUIRE(now > 0);
      sent += static_cast<std::size_t>(now);
    }
    std::vector<door::LiveFrame> frames;
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (frames.empty() && std::chrono::steady_clock::now() < until) frames = link.take();
    REQUIRE(frames.size() == 1);
    CHECK(frames[0].number == 9);
    link.ask(door::LiveAsk::pace, 2);
    door::LiveRequest request;
    REQUIRE(read(ends[1], &request, sizeof request) == sizeof request);
    CHECK(request.what == door::LiveAsk::pace);
    CHECK(request.value == 2);
    CHECK_FALSE(link.has_ended());
    close(ends[1]);
    while (!link.has_ended() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    CHECK(link.has_ended());
    CHECK(link.error().empty());
  }

  TEST_CASE("what is no frame ends the link with one line") {
    std::array<int, 2> ends{};
    REQUIRE(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
    app::LiveLink link(ends[0], {});
    const std::uint64_t length = door::most_frame_bytes + 1;
    REQUIRE(write(ends[1], &length, sizeof length) == sizeof length);
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!link.has_ended() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
    CHECK(link.error().find("bytes are announced") != std::string::npos);
    close(ends[1]);
  }

  TEST_CASE("at rest N and B ask for a frame, and the first of them only stops the program") {
    app::WindowState state;
    state.live.is_live = true;
    app::handle(state, {app::KeyAction::next_frame});
    CHECK(state.paused);
    CHECK(state.live.go == 0);
    app::handle(state, {app::KeyAction::next_frame});
    CHECK(state.live.go == 1);
    app::handle(state, {app::KeyAction::previous_frame});
    CHECK(state.live.go == -1);
  }

  TEST_CASE("F8 asks for a recording, F9 lets it hurry, Insert gives it the keys") {
    app::WindowState state;
    state.live.is_live = true;
    app::handle(state, *app::asked_by_key("F8"));
    CHECK(state.record);
    app::handle(state, *app::asked_by_key("F9"));
    CHECK(state.live.fast);
    app::handle(state, *app::asked_by_key("Insert"));
    CHECK(state.live.program_keys);
    state.frame = 7;
    app::let_pass(state, 1);
    CHECK(state.frame == 7);
  }

  TEST_CASE("keys have the names that X11 knows them by") {
    CHECK(app::x11_keysym(SDLK_a) == 'a');
    CHECK(app::x11_keysym(SDLK_F1) == 0xffbe);
    CHECK(app::x11_keysym(SDLK_F12) == 0xffc9);
    CHECK(app::x11_keysym(SDLK_UP) == 0xff52);
    CHECK(app::x11_keysym(SDLK_KP_5) == 0xffb5);
    CHECK(app::x11_keysym(SDLK_KP_0) == 0xffb0);
    CHECK(app::x11_keysym(SDLK_DELETE) == 0xffff);
    CHECK(app::x11_keysym(SDLK_AUDIOPLAY) == 0);
    CHECK(app::is_function_key("F12"));
    CHECK_FALSE(app::is_function_key("F"));
  }
}
