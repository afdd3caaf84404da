#include "app/window/panel_frame.h"

#include <imgui.h>

#include <algorithm>
#include <string>

namespace app {
namespace {

bool is_body_open = false;  // of the panel between begin_panel and end_panel

constexpr auto fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                       ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                       ImGuiWindowFlags_NoBringToFrontOnFocus;

void place_next(const Rect& place) {
  ImGui::SetNextWindowPos({static_cast<float>(place.x), static_cast<float>(place.y)}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({static_cast<float>(place.width), static_cast<float>(place.height)},
                           ImGuiCond_Always);
}

// The title, and at its right end the two buttons.
void draw_title(WindowState& state, const Docked& docked, const char* title) {
  const auto panel = docked.panel;
  const ImVec2 corner = ImGui::GetWindowPos();
  const float height = ImGui::GetFrameHeight() + 6;
  const auto width = static_cast<float>(docked.place.width);
  ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + width, corner.y + height},
                                            ImGui::GetColorU32(ImGuiCol_TitleBgActive));
  ImGui::SetCursorPos({10, 3});
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  if (docked.is_folded) {
    ImGui::SameLine();
    ImGui::TextDisabled("...");
    if (ImGui::IsWindowHovered() && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) state.dock.raise(panel);
  }
  const bool is_left = state.dock.side[static_cast<std::size_t>(panel)] == Side::left;
  const float button = ImGui::GetFrameHeight();
  ImGui::SetCursorPos({std::max(width - 2 * button - 8, 0.0F), 3});
  if (ImGui::Button(is_left ? ">" : "<", {button, 0})) state.dock.move_over(panel);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("to the other side");
  ImGui::SameLine(0, 2);
  if (ImGui::Button("x", {button, 0})) state.dock.close(panel);
  ImGui::SetCursorPos({0, height});
}

}  // namespace

bool begin_panel(WindowState& state, const Docked& docked) {
  const std::string title(panel_titles[static_cast<std::size_t>(docked.panel)]);
  place_next(docked.place);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  is_body_open = ImGui::Begin(title.c_str(), nullptr, fixed);
  ImGui::PopStyleVar();
  if (!is_body_open) return false;
  draw_title(state, docked, title.c_str());
  is_body_open = !docked.is_folded;
  if (!is_body_open) return false;
  return ImGui::BeginChild("body", {0, 0}, false, ImGuiWindowFlags_AlwaysUseWindowPadding);
}

void end_panel() {
  if (is_body_open) ImGui::EndChild();
  ImGui::End();
}

void wrapped_tooltip(const std::string& text) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::CalcTextSize("0").x * 60);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void draw_edges(WindowState& state, const DockLayout& layout, Rect area, float scale) {
  for (std::size_t i = 0; i < side_count; ++i) {
    if (!layout.edges[i]) continue;
    const auto side = static_cast<Side>(i);
    place_next(*layout.edges[i]);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    ImGui::Begin(side == Side::left ? "left edge" : "right edge", nullptr,
                 (fixed & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoBackground);
    const ImVec2 size{static_cast<float>(layout.edges[i]->width),
                      static_cast<float>(layout.edges[i]->height)};
    ImGui::InvisibleButton("edge", size);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) {
      drag_edge(state.dock, side, static_cast<int>(ImGui::GetIO().MousePos.x), area, double{scale});
    }
    ImGui::End();
    ImGui::PopStyleVar(2);
  }
}

}  // namespace app
