// Three hundred packets of every kind, drawn by the GPU alone.

#include <array>
#include <cstdint>
#include <cstdio>
#include <random>
#include <vector>

#include "gpu/gpu.h"
#include "ot/packet.h"
#if WITH_EXTRA
#include "inspect/report.h"
#endif

namespace {

std::vector<std::uint32_t> make_list() {
  std::mt19937 random{1};
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random()) % n; };
  const auto place = [&] {
    return ot::Xy{static_cast<std::int16_t>(below(320)), static_cast<std::int16_t>(below(240))};
  };
  const auto byte = [&] { return static_cast<std::uint8_t>(below(256)); };
  std::vector<std::uint32_t> list{0xe1000600, 0xe3000000, 0xe403bd3f, 0xe5000000};
  std::array<std::uint32_t, 16> words{};
  const auto add = [&](const auto& packet) {
    list.insert(list.end(), words.begin(),
                words.begin() + static_cast<std::ptrdiff_t>(encode(packet, words)));
  };
  add(ot::Fill{{10, 20, 30}, 0, 0, 320, 240});
  for (std::uint32_t i = 0; i < 100; ++i) {
    ot::Polygon polygon{.quad = i % 2 != 0,
                        .gouraud = i / 2 % 2 != 0,
                        .textured = i / 4 % 2 != 0,
                        .semi_transparent = i / 8 % 2 != 0,
                        .raw = i / 16 % 2 != 0};
    for (std::size_t k = 0; k < 4; ++k) {
      polygon.xy[k] = place();
      polygon.rgb[k] = {byte(), byte(), byte()};
      polygon.uv[k] = {byte(), byte()};
    }
    polygon.texpage =
        ot::texpage_of(640, 0, static_cast<ot::Blend>(1 + i % 4), static_cast<ot::TexelFormat>(1 + i % 3));
    add(polygon);
    add(ot::Rectangle{
        .textured = i % 3 == 0, .xy = place(), .rgb = {byte(), byte(), byte()}, .width = 30, .height = 20});
    add(ot::Line{.gouraud = i % 2 == 0, .xy = {place(), place()}, .rgb = {{{1, 2, 3}, {200, 100, 50}}}});
  }
  return list;
}

gpu::Gpu gpu_under_test;
std::vector<std::uint32_t> list;

}  // namespace

extern "C" [[gnu::noinline]] void measured() { gpu_under_test.gp0(list); }

int main([[maybe_unused]] int count, char** /*arguments*/) {
  list = make_list();
  gpu_under_test.gp0(list);  // what is set up on first use
#if WITH_EXTRA
  if (count > 1) {  // linked and used, though not now
    gpu::Trace trace;
    trace.keep_history = true;
    gpu_under_test.set_trace(&trace);
    gpu_under_test.gp0(list);
    gpu_under_test.set_trace(nullptr);
    std::fputs(inspect::to_text(inspect::inspect(trace, {})).c_str(), stdout);
  }
#endif
  measured();
  std::printf("%u\n", gpu_under_test.vram().at(160, 120));
}
