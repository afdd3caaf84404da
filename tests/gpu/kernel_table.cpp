// Which axes are compile-time: the table is the list.

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <type_traits>

#include "gpu/kernels.h"

namespace {

// Everything a kernel is specialised on; anything else a primitive asks for is data in Job.
static_assert(std::is_same_v<decltype(gpu::SurfaceMode::texture), ot::TexelFormat>);
static_assert(std::is_same_v<decltype(gpu::SurfaceMode::shade), gpu::Shade>);
static_assert(std::is_same_v<decltype(gpu::SurfaceMode::dither), bool>);
static_assert(std::is_same_v<decltype(gpu::Mode::blend), ot::Blend>);
static_assert(std::is_same_v<decltype(gpu::Mode::masked), bool>);
static_assert(std::is_same_v<decltype(gpu::Mode::depth), bool>);
static_assert(sizeof(gpu::Mode) == 6, "an axis was added: say so here");
static_assert(gpu::Mode::count == 18 * 6 * 2 && gpu::Mode::count <= 400);

// A kernel is told a job and spans: there is no way for a trace to reach it.
static_assert(std::is_same_v<gpu::Kernel, void (*)(const gpu::Job&, std::span<const gpu::Span>)>);

constexpr bool is_possible(const gpu::SurfaceMode& s) {
  const bool is_textured = s.texture != ot::TexelFormat::none;
  if (s.shade == gpu::Shade::raw && (!is_textured || s.dither)) return false;
  return is_textured || s.shade == gpu::Shade::gouraud || !s.dither;
}
static_assert([] {
  for (const gpu::SurfaceMode& s : gpu::Mode::surfaces) {
    if (!is_possible(s)) return false;
  }
  return true;
}());

}  // namespace

TEST_SUITE("gpu") {
  TEST_CASE("Every possible surface stands in the kernel table once") {
    std::size_t possible = 0;
    for (int texture = 0; texture < 4; ++texture) {
      for (int shade = 0; shade < 3; ++shade) {
        for (const bool dither : {false, true}) {
          const gpu::SurfaceMode s{static_cast<ot::TexelFormat>(texture), static_cast<gpu::Shade>(shade),
                                   dither};
          if (!is_possible(s)) continue;
          ++possible;
          CHECK(gpu::Mode::at(gpu::Mode{s, ot::Blend::opaque, false, false}.index()).surface == s);
        }
      }
    }
    CHECK(possible == gpu::Mode::surfaces.size());
  }

  TEST_CASE("Every dispatch target has a kernel for every mode, no two alike") {
    const std::string before(gpu::target_name());
    for (const std::string_view target : gpu::target_names()) {
      REQUIRE(gpu::use_target(target));
      std::set<gpu::Kernel> distinct(gpu::kernels().begin(), gpu::kernels().end());
      CHECK(distinct.count(nullptr) == 0);
      CHECK(distinct.size() == gpu::Mode::count);
    }
    CHECK_FALSE(gpu::use_target("PDP-11"));
    gpu::use_target(before);
  }
}
