#include "inspect/maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "gpu/rules.h"
#include "inspect/truth.h"

namespace inspect {
namespace {

using gpu::Vram;

constexpr base::Rgba paper{24, 24, 28}, ink{235, 235, 235};
constexpr int legend_row = 14, text_scale = 2;

// 5 bits to 8 as the scan-out does.
base::Rgba widen(std::uint16_t pixel) {
  const auto channel = [pixel](int shift) {
    const int v = pixel >> shift & 31;
    return static_cast<std::uint8_t>(v << 3 | v >> 2);
  };
  return {channel(0), channel(5), channel(10)};
}

base::Rgba dimmed(base::Rgba c) {
  const auto grey = static_cast<std::uint8_t>(20 + (c.r * 3 + c.g * 6 + c.b) / 10 * 2 / 5);
  return {grey, grey, grey};
}

// Calls f(x, y of the picture, VRAM pixel).
template <class F>
void for_each_pixel(const Rectangle& picture, F&& f) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      f(x, y, static_cast<std::uint32_t>(Vram::offset(picture.x + x, picture.y + y)));
    }
  }
}

base::Picture with_legend(const Rectangle& picture, int rows) {
  return {picture.width, picture.height + rows * legend_row + (rows > 0 ? 4 : 0), paper};
}

void legend_entry(base::Picture& image, int x, int y, base::Rgba colour, const std::string& text) {
  for (int row = 0; row < 10; ++row) {
    for (int column = 0; column < 10; ++column) {
      if (x + column < image.width && y + row < image.height) image.at(x + column, y + row) = colour;
    }
  }
  draw_text(image, x + 14, y, text, ink, text_scale);
}

}  // namespace

base::Rgba colour_of(Cause cause) {
  constexpr std::array<base::Rgba, cause_count> colours{{{80, 200, 255},
                                                         {255, 150, 0},
                                                         {255, 60, 220},
                                                         {255, 230, 40},
                                                         {255, 50, 50},
                                                         {255, 110, 90},
                                                         {90, 240, 90},
                                                         {170, 120, 255}}};
  return colours[static_cast<std::size_t>(cause)];
}

base::Picture heatmap(const Report& report, std::span<const std::uint16_t> vram) {
  std::vector<Cause> shown;
  for (std::size_t c = 0; c < cause_count; ++c) {
    if (report.causes[c] != 0) shown.push_back(static_cast<Cause>(c));
  }
  base::Picture image = with_legend(report.picture, static_cast<int>(shown.size()) + 1);
  for_each_pixel(report.picture,
                 [&](int x, int y, std::uint32_t pixel) { image.at(x, y) = dimmed(widen(vram[pixel])); });
  for (const WrongPixel& wrong : report.wrong) {
    const int x = static_cast<int>(wrong.pixel % Vram::width) - report.picture.x;
    const int y = static_cast<int>(wrong.pixel / Vram::width) - report.picture.y;
    if (x < 0 || y < 0 || x >= report.picture.width || y >= report.picture.height) continue;
    const auto cause = wrong.causes.first();
    image.at(x, y) = cause ? colour_of(*cause) : base::Rgba{255, 255, 255};
  }
  int y = report.picture.height + 4;
  draw_text(image, 4, y,
            std::to_string(report.wrong_pixels()) + " wrong of " + std::to_string(report.pixels_drawn), ink,
            text_scale);
  for (const Cause cause : shown) {
    y += legend_row;
    legend_entry(image, 4, y, colour_of(cause),
                 std::to_string(report.count(cause)) + " " + std::string(name(cause)));
  }
  return image;
}

std::span<const base::Rgba> overdraw_colours() {
  static constexpr std::array<base::Rgba, 9> ramp{{{0, 0, 0},
                                                   {20, 40, 120},
                                                   {20, 90, 180},
                                                   {10, 150, 150},
                                                   {40, 180, 60},
                                                   {190, 200, 30},
                                                   {245, 160, 20},
                                                   {240, 90, 20},
                                                   {230, 20, 30}}};
  return ramp;
}

base::Picture overdraw(const Report& report, const gpu::Trace& trace) {
  const auto ramp = overdraw_colours();
  std::vector<std::uint32_t> writes(Vram::size);
  for (const gpu::Event& event : trace.history) {
    if (trace.draws[event.draw].kind <= gpu::Kind::line) ++writes[event.pixel];
  }
  base::Picture image = with_legend(report.picture, 1);
  std::uint64_t sum = 0;
  for_each_pixel(report.picture, [&](int x, int y, std::uint32_t pixel) {
    sum += writes[pixel];
    image.at(x, y) = ramp[std::min<std::size_t>(writes[pixel], ramp.size() - 1)];
  });
  int x = 4;
  const int y = report.picture.height + 4;
  for (std::size_t n = 0; n < ramp.size(); ++n, x += 26) {
    legend_entry(image, x, y, ramp[n], n + 1 == ramp.size() ? "8+" : std::to_string(n));
  }
  return image;
}

base::Picture ids(const Report& report, const gpu::Trace& trace) {
  base::Picture image = with_legend(report.picture, 0);
  for_each_pixel(report.picture, [&](int x, int y, std::uint32_t pixel) {
    const std::uint32_t writer = trace.last_writer[pixel];
    if (writer == 0) return;
    const std::uint32_t hash = writer * 2654435761U;  // Knuth's multiplicative hash
    const auto channel = [hash](int shift) { return static_cast<std::uint8_t>(64 + (hash >> shift & 0xbf)); };
    image.at(x, y) = {channel(24), channel(16), channel(8)};
  });
  return image;
}

base::Picture truth_image(const Report& report, const gpu::Trace& trace,
                          std::span<const std::uint16_t> vram) {
  const Fragments fragments(trace, report.order);
  Surfaces surfaces(trace);
  base::Picture image = with_legend(report.picture, 0);
  for_each_pixel(report.picture,
                 [&](int x, int y, std::uint32_t pixel) { image.at(x, y) = widen(vram[pixel]); });
  // What lies under the first fragment that is judged, and what was drawn without depth after the last one.
  std::vector<std::uint16_t> under(Vram::size);
  std::vector<std::vector<const gpu::Event*>> over(report.wrong.size());
  std::vector<std::uint32_t> index(Vram::size, nobody);
  for (std::uint32_t i = 0; i < report.wrong.size(); ++i) index[report.wrong[i].pixel] = i;
  std::vector<bool> started(Vram::size);
  for (const gpu::Event& event : trace.history) {
    const std::uint32_t i = index[event.pixel];
    if (i == nobody) continue;
    const gpu::Primitive& p = trace.draws[event.draw];
    if (hides(event, p) != Hides::nothing) {
      started[event.pixel] = false;
      over[i].clear();
    } else if (p.kind == gpu::Kind::polygon && p.has_depth) {
      if (!started[event.pixel]) under[event.pixel] = event.before;
      started[event.pixel] = true;
      over[i].clear();
    } else {
      over[i].push_back(&event);
    }
  }
  for (std::uint32_t i = 0; i < report.wrong.size(); ++i) {
    const std::uint32_t pixel = report.wrong[i].pixel;
    std::uint16_t colour = under[pixel];
    for (const Fragment& f : true_stack(fragments.at(pixel), pixel, surfaces)) {
      colour = f.blends ? gpu::blend_pixel(trace.draws[f.draw].state.blend(), colour, f.colour) : f.colour;
    }
    for (const gpu::Event* event : over[i]) {
      colour = event->blended
                   ? gpu::blend_pixel(trace.draws[event->draw].state.blend(), colour, event->fragment)
                   : event->fragment;
    }
    const int x = static_cast<int>(pixel % Vram::width) - report.picture.x;
    const int y = static_cast<int>(pixel / Vram::width) - report.picture.y;
    if (x >= 0 && y >= 0 && x < report.picture.width && y < report.picture.height)
      image.at(x, y) = widen(colour);
  }
  return image;
}

base::Picture depth_image(const Report& report, const gpu::Trace& trace) {
  const Fragments fragments(trace, report.order);
  Surfaces surfaces(trace);
  std::vector<double> nearness(Vram::size);
  double nearest = 0;
  for_each_pixel(report.picture, [&](int, int, std::uint32_t pixel) {
    const auto stack = true_stack(fragments.at(pixel), pixel, surfaces);
    if (stack.empty() || stack.front().blends) return;
    nearness[pixel] = 1 / surfaces.depth(stack.front(), pixel);
    nearest = std::max(nearest, nearness[pixel]);
  });
  base::Picture image = with_legend(report.picture, 0);
  for_each_pixel(report.picture, [&](int x, int y, std::uint32_t pixel) {
    if (nearness[pixel] <= 0) return;
    // The square root spreads the far half of the scene over more greys.
    const auto grey = static_cast<std::uint8_t>(20 + 235 * std::sqrt(nearness[pixel] / nearest));
    image.at(x, y) = {grey, grey, grey};
  });
  return image;
}

}  // namespace inspect
