#include "app/window/vram_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "display/scanout.h"

namespace app {
namespace {

constexpr ImU32 display_colour = IM_COL32(0xf2, 0xa3, 0x3a, 255);
constexpr ImU32 drawing_colour = IM_COL32(0x4c, 0xc8, 0xff, 255);
constexpr ImU32 label_colour = IM_COL32(0x14, 0x14, 0x1c, 0xd8);

struct View {
  Rect place;
  [[nodiscard]] ImVec2 at(int x, int y) const {
    return {static_cast<float>(place.x) +
                static_cast<float>(x) * static_cast<float>(place.width) / display::vram_width,
            static_cast<float>(place.y) +
                static_cast<float>(y) * static_cast<float>(place.height) / display::vram_height};
  }
};

void outline(const View& view, int x, int y, int width, int height, ImU32 colour, const char* name,
             float name_y) {
  auto* list = ImGui::GetBackgroundDrawList();
  const ImVec2 low = view.at(x, y);
  const ImVec2 high = view.at(x + width, y + height);
  list->AddRect(low, high, colour);
  const ImVec2 size = ImGui::CalcTextSize(name);
  const float top = low.y + name_y * (size.y + 6) + 2;
  list->AddRectFilled({low.x + 2, top}, {low.x + 10 + size.x, top + size.y + 4}, label_colour);
  list->AddText({low.x + 6, top + 2}, colour, name);
}

// 15 x 15 pixels round the mouse, enlarged, with the value of the middle one.
void magnifier(const gpu::Vram& vram, int x, int y, float scale) {
  constexpr int reach = 7;
  const float cell = 9 * scale;
  ImGui::BeginTooltip();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  auto* list = ImGui::GetWindowDrawList();
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const auto colour = display::expand(vram.at(x + dx, y + dy));
      const ImVec2 low{corner.x + static_cast<float>(dx + reach) * cell,
                       corner.y + static_cast<float>(dy + reach) * cell};
      list->AddRectFilled(low, {low.x + cell, low.y + cell}, IM_COL32(colour.r, colour.g, colour.b, 255));
      if (dx == 0 && dy == 0) list->AddRect(low, {low.x + cell, low.y + cell}, display_colour);
    }
  }
  const float size = cell * (2 * reach + 1);
  ImGui::Dummy({size, size});
  const unsigned value = vram.at(x, y);
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

void draw_vram_marks(const gpu::Gpu& gpu, Rect where, float scale) {
  const View view{where};
  const auto area = display::area_of(gpu.display());
  outline(view, area.x, area.y, area.width, area.height, display_colour, "shown", 0);
  const auto& state = gpu.state();
  outline(view, state.left(), state.top(), state.right() - state.left() + 1, state.bottom() - state.top() + 1,
          drawing_colour, "drawn to", 1);
  // Where there is no mouse ImGui says -FLT_MAX, which no int can hold: its place is judged first.
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const float across = (mouse.x - static_cast<float>(where.x)) / static_cast<float>(where.width),
              down = (mouse.y - static_cast<float>(where.y)) / static_cast<float>(where.height);
  if (across < 0 || across >= 1 || down < 0 || down >= 1 || ImGui::GetIO().WantCaptureMouse) return;
  magnifier(gpu.vram(), static_cast<int>(across * display::vram_width),
            static_cast<int>(down * display::vram_height), scale);
}

}  // namespace app
