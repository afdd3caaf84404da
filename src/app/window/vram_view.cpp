#include "app/window/vram_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "display/scanout.h"

namespace app {
namespace {

constexpr ImU32 display_colour = IM_COL32(0xf2, 0xa3, 0x3a, 255);
constexpr ImU32 drawing_colour = IM_COL32(0x4c, 0xc8, 0xff, 255);
constexpr ImU32 grid_colour = IM_COL32(0xff, 0xff, 0xff, 40);
constexpr ImU32 label_colour = IM_COL32(0x14, 0x14, 0x1c, 0xd8);

ImVec2 at(const VramMapping& mapping, double x, double y) {
  return {static_cast<float>(mapping.to_x(x)), static_cast<float>(mapping.to_y(y))};
}

void outline(const VramMapping& view, int x, int y, int width, int height, ImU32 colour, const char* name,
             float name_y) {
  auto* list = ImGui::GetBackgroundDrawList();
  const ImVec2 low = at(view, x, y);
  const ImVec2 high = at(view, x + width, y + height);
  list->AddRect(low, high, colour);
  const ImVec2 size = ImGui::CalcTextSize(name);
  const float top = low.y + name_y * (size.y + 6) + 2;
  list->AddRectFilled({low.x + 2, top}, {low.x + 10 + size.x, top + size.y + 4}, label_colour);
  list->AddText({low.x + 6, top + 2}, colour, name);
}

// 15 x 15 pixels round the mouse, enlarged, with the value of the middle one.
void magnifier(std::span<const std::uint16_t> vram, int x, int y, float scale) {
  const auto pixel = [&vram](int column, int row) {
    return vram[static_cast<std::size_t>((row & (display::vram_height - 1)) * display::vram_width +
                                         (column & (display::vram_width - 1)))];
  };
  constexpr int reach = 7;
  const float cell = 9 * scale;
  ImGui::BeginTooltip();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  auto* list = ImGui::GetWindowDrawList();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto colour = display::expand(pixel(x + dx, y + dy));
      const ImVec2 low{corner.x + static_cast<float>(dx + reach) * cell,
                       corner.y + static_cast<float>(dy + reach) * cell};
      list->AddRectFilled(low, {low.x + cell, low.y + cell}, IM_COL32(colour.r, colour.g, colour.b, 255));
      if (dx == 0 && dy == 0) list->AddRect(low, {low.x + cell, low.y + cell}, display_colour);
    }
  }
  const float size = cell * (2 * reach + 1);
  ImGui::Dummy({size, size});
  const unsigned value = pixel(x, y);
  ImGui::Text("%d, %d: %04Xh", x, y, value);
  ImGui::TextDisabled("r %u g %u b %u, bit 15 %u", value & 31U, value >> 5U & 31U, value >> 10U & 31U,
                      value >> 15U);
  ImGui::EndTooltip();
}

}  // namespace

Rect place_vram(Rect area) {
  const double room =
      std::min(area.width / double{display::vram_width}, area.height / double{display::vram_height});
  const double scale = room >= 1 ? std::floor(room) : std::max(room, 0.01);
  const int width = static_cast<int>(display::vram_width * scale);
  const int height = static_cast<int>(display::vram_height * scale);
  return {area.x + (area.width - width) / 2, area.y + (area.height - height) / 2, width, height};
}

VramMapping vram_mapping(const VramState& state, Rect place) {
  return {place, state.x, state.y, display::vram_width / state.zoom, display::vram_height / state.zoom};
}

void pan_vram(VramState& state, double across, double down) {
  const double width = display::vram_width / state.zoom, height = display::vram_height / state.zoom;
  state.x = std::clamp(state.x + across * width, 0.0, display::vram_width - width);
  state.y = std::clamp(state.y + down * height, 0.0, display::vram_height - height);
}

void zoom_vram(VramState& state, double steps, double across, double down) {
  const double before = state.zoom;
  state.zoom = std::clamp(state.zoom * std::pow(1.25, steps), 1.0, 64.0);
  // The same spot at the same place: x + across * width.
  state.x += across * display::vram_width * (1 / before - 1 / state.zoom);
  state.y += down * display::vram_height * (1 / before - 1 / state.zoom);
  pan_vram(state, 0, 0);
}

void show_rectangle(VramState& state, int x, int y, int width, int height) {
  const double wide = std::max(width, 1), high = std::max(height, 1);
  state.zoom = std::clamp(std::min(display::vram_width / wide, display::vram_height / high) * 0.8, 1.0, 64.0);
  state.x = x + wide / 2 - display::vram_width / state.zoom / 2;
  state.y = y + high / 2 - display::vram_height / state.zoom / 2;
  pan_vram(state, 0, 0);
}

void draw_vram_marks(const gpu::Gpu& gpu, std::span<const std::uint16_t> vram, const VramMapping& mapping,
                     bool grid, float scale) {
  const auto& where = mapping.place;
  auto* list = ImGui::GetBackgroundDrawList();
  const ImVec2 corner{static_cast<float>(where.x), static_cast<float>(where.y)};
  const ImVec2 end{corner.x + static_cast<float>(where.width), corner.y + static_cast<float>(where.height)};
  list->PushClipRect(corner, end, true);
  if (grid) {
    for (int x = 64; x < display::vram_width; x += 64) {
      list->AddLine(at(mapping, x, 0), at(mapping, x, display::vram_height), grid_colour);
    }
    list->AddLine(at(mapping, 0, 256), at(mapping, display::vram_width, 256), grid_colour);
  }
  const auto area = display::area_of(gpu.display());
  outline(mapping, area.x, area.y, area.width, area.height, display_colour, "shown", 0);
  const auto& state = gpu.state();
  outline(mapping, state.left(), state.top(), state.right() - state.left() + 1,
          state.bottom() - state.top() + 1, drawing_colour, "drawn to", 1);
  list->PopClipRect();
  // Where there is no mouse ImGui says -FLT_MAX, which no int can hold: its place is judged first.
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const double across = (static_cast<double>(mouse.x) - where.x) / where.width,
               down = (static_cast<double>(mouse.y) - where.y) / where.height;
  if (across < 0 || across >= 1 || down < 0 || down >= 1 || ImGui::GetIO().WantCaptureMouse) return;
  magnifier(vram, static_cast<int>(mapping.x + across * mapping.width),
            static_cast<int>(mapping.y + down * mapping.height), scale);
}

}  // namespace app
