#include "app/window/inspect_panel.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/commands/describe.h"
#include "app/window/panel_frame.h"
#include "inspect/maps.h"

namespace app {
namespace {

// A square of a colour, with text to come behind it.
void swatch(base::Rgba colour) {
  const float size = ImGui::GetTextLineHeight();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + size, corner.y + size},
                                            IM_COL32(colour.r, colour.g, colour.b, 255));
  ImGui::Dummy({size, size});
  ImGui::SameLine();
}

// What the colours of a map mean. Those of errors stand beside their counts.
void draw_legend(Map map, float scale) {
  switch (map) {
    case Map::none:
    case Map::truth:
      break;
    case Map::errors:
      ImGui::TextDisabled("grey: as it should be; in colour: wrong, by cause");
      break;
    case Map::overdraw: {
      const auto colours = inspect::overdraw_colours();
      ImGui::TextDisabled("times drawn:");
      for (std::size_t n = 0; n < colours.size(); ++n) {
        ImGui::SameLine(static_cast<float>(n % 3) * 60 * scale + 100 * scale);
        swatch(colours[n]);
        ImGui::Text("%zu%s", n, n + 1 == colours.size() ? "+" : "");
        if (n % 3 == 2 && n + 1 != colours.size()) ImGui::NewLine();
      }
      break;
    }
    case Map::owners:
      ImGui::TextDisabled("a colour a draw, that which is seen; black: nobody");
      break;
    case Map::depth:
      ImGui::TextDisabled("white: nearest, grey: farther, as 1/z; black: no depth");
      break;
  }
}

// Wrong pixels by cause, each in the colour it has on the map.
void draw_causes(const inspect::Report& report, float scale) {
  ImGui::Text("%s of %s pixels are wrong", with_commas(report.wrong_pixels()).c_str(),
              with_commas(report.pixels_drawn).c_str());
  for (std::size_t i = 0; i < inspect::cause_count; ++i) {
    const auto cause = static_cast<inspect::Cause>(i);
    const auto colour = inspect::colour_of(cause);
    const auto name = inspect::name(cause);
    if (report.count(cause) == 0) continue;
    swatch(colour);
    ImGui::TextColored(ImColor(colour.r, colour.g, colour.b), "%.*s", static_cast<int>(name.size()),
                       name.data());
    ImGui::SameLine(160 * scale);
    ImGui::TextUnformatted(with_commas(report.count(cause)).c_str());
  }
}

void draw_slider(WindowState& state, const Inspection& inspection) {
  const int draws = inspection.draws();
  int shown = state.first_draws < 0 ? draws : std::min(state.first_draws, draws);
  if (ImGui::Button("-")) --shown;
  ImGui::SameLine();
  if (ImGui::Button("+")) ++shown;
  ImGui::SameLine();
  if (ImGui::Button("all")) shown = draws;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  ImGui::SliderInt("##draws", &shown, 0, draws, "the first %d draws", ImGuiSliderFlags_AlwaysClamp);
  shown = std::clamp(shown, 0, draws);
  state.first_draws = shown == draws ? -1 : shown;
  ImGui::TextDisabled("of %d; the last of them:", draws);
  ImGui::TextWrapped("%s", inspection.draw_text(shown - 1).c_str());
}

// Nothing was watched: says why, and offers the way back.
void draw_unwatched(WindowState& state, const Inspection& inspection) {
  std::string names;
  for (const auto* knob : inspection.unwatched()) names.append(names.empty() ? "" : ", ").append(knob->name);
  ImGui::TextWrapped(
      "This frame has more samples than the console has pixels (%s), and nobody notes who wrote which.",
      names.c_str());
  if (!ImGui::Button("inspect it with these as on the console")) return;
  const scene::Knobs console;
  for (const auto* knob : inspection.unwatched()) knob->set(state.knobs, knob->get(console));
}

void draw_watched(WindowState& state, const Inspection& inspection, float scale) {
  int map = static_cast<int>(state.map);
  ImGui::SetNextItemWidth(150 * scale);
  if (ImGui::Combo("show (E)", &map, map_names.data(), static_cast<int>(map_names.size()))) {
    state.map = static_cast<Map>(map);
  }
  if (state.map == Map::none) draw_slider(state, inspection);
  draw_legend(state.map, scale);
  if (state.paused || state.map == Map::errors) draw_causes(inspection.report(), scale);
  if (!state.paused) ImGui::TextDisabled("Space pauses: then the mouse tells a pixel's history.");
}

}  // namespace

void draw_inspect_panel(WindowState& state, const Inspection& inspection, const Docked& docked, float scale) {
  if (begin_panel(state, docked)) {
    inspection.unwatched().empty() ? draw_watched(state, inspection, scale)
                                   : draw_unwatched(state, inspection);
  }
  end_panel();
}

void draw_history(const Inspection& inspection, Rect picture, int width, int height) {
  const auto& io = ImGui::GetIO();
  if (io.WantCaptureMouse || !ImGui::IsMousePosValid(&io.MousePos) || width <= 0 || height <= 0) return;
  const float pixel_width = static_cast<float>(picture.width) / static_cast<float>(width);
  const float pixel_height = static_cast<float>(picture.height) / static_cast<float>(height);
  const int x = static_cast<int>(std::floor((io.MousePos.x - static_cast<float>(picture.x)) / pixel_width));
  const int y = static_cast<int>(std::floor((io.MousePos.y - static_cast<float>(picture.y)) / pixel_height));
  if (x < 0 || y < 0 || x >= width || y >= height) return;
  const ImVec2 low{static_cast<float>(picture.x) + static_cast<float>(x) * pixel_width,
                   static_cast<float>(picture.y) + static_cast<float>(y) * pixel_height};
  ImGui::GetBackgroundDrawList()->AddRect({low.x - 1, low.y - 1},
                                          {low.x + pixel_width + 1, low.y + pixel_height + 1},
                                          IM_COL32(0xff, 0xff, 0xff, 255));
  const auto lines = inspection.history(x, y);
  constexpr std::size_t most = 16;
  const std::size_t from = lines.size() > most ? lines.size() - most : 0;
  ImGui::BeginTooltip();
  if (from != 0) ImGui::TextDisabled("... %zu lines before these", from);
  for (std::size_t i = from; i < lines.size(); ++i) ImGui::TextUnformatted(lines[i].c_str());
  ImGui::EndTooltip();
}

}  // namespace app
