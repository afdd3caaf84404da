#include "app/window/cost_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "app/window/panel_frame.h"

namespace app {
namespace {

const ImVec4 current_colour{0.949F, 0.639F, 0.227F, 1};
const ImVec4 dearer_colour{1, 0.42F, 0.353F, 1};
const ImVec4 cheaper_colour{0.478F, 0.8F, 0.498F, 1};

template <class... Values>
void right_aligned(const ImVec4& colour, const char* pattern, Values... values) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.data()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(room, 0.0F));
  ImGui::TextColored(colour, "%s", text.data());
}

// Only what lies outside the spread of both measurements has a colour.
ImVec4 colour_of(const CostTable& table, const CostLine& line) {
  if (line.is_current) return current_colour;
  const auto order = table.against_current(line);
  if (order > 0) return dearer_colour;
  return order < 0 ? cheaper_colour : ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
}

void draw_numbers(const CostTable& table, const CostLine& line) {
  const auto dim = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
  const auto ms = table.ms(line);
  const auto ratio = table.ratio(line);
  ImGui::TableNextColumn();
  if (!line.error.empty()) {
    right_aligned(dim, "%s", "-");
  } else if (ms) {
    right_aligned(line.is_current ? current_colour : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%.2f", *ms);
  }
  ImGui::TableNextColumn();
  if (const auto spread = table.spread(line); spread && line.error.empty()) {
    right_aligned(dim, "%.2f..%.2f", spread->low, spread->high);
  }
  ImGui::TableNextColumn();
  if (ratio) right_aligned(colour_of(table, line), *ratio < 9.95 ? "x %.2f" : "x %.0f", *ratio);
}

void draw_line(WindowState& state, const CostTable& table, const CostLine& line) {
  ImGui::TableNextColumn();
  const std::string name(line.setting->name);
  const std::string label = (line.is_current ? "> " : "  ") + name + "##" + std::string(line.axis->name);
  ImGui::PushStyleColor(ImGuiCol_Text,
                        line.is_current ? current_colour : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  const bool clicked = ImGui::Selectable(label.c_str(), line.is_current, ImGuiSelectableFlags_SpanAllColumns);
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s%s", options_of(*line.setting).c_str(),
                      line.error.empty() ? "" : ("\n" + line.error).c_str());
  }
  draw_numbers(table, line);
  if (!clicked) return;
  state.knobs = line.knobs;
  set_visibility(state, state.knobs.visibility);
}

void draw_heading(const cost::Axis& axis) {
  ImGui::TableNextRow(ImGuiTableRowFlags_None, ImGui::GetTextLineHeightWithSpacing() * 1.3F);
  ImGui::TableNextColumn();
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ImGui::GetTextLineHeight() * 0.4F);
  ImGui::TextDisabled("%.*s", static_cast<int>(axis.name.size()), axis.name.data());
  for (int column = 1; column < 4; ++column) ImGui::TableNextColumn();
}

void draw_summary(const CostTable& table) {
  const auto now = table.current_ms();
  if (now) {
    ImGui::Text("this frame %.2f ms; with one knob changed:", *now);
  } else {
    ImGui::TextUnformatted("measuring ...");
  }
  if (table.known() < table.all()) {
    ImGui::TextDisabled("measured %zu of %zu", table.known(), table.all());
  } else {
    ImGui::TextDisabled("medians and middle halves of the last %zu; in colour: beyond them",
                        RollingMedian::window);
  }
}

}  // namespace

void draw_cost_panel(WindowState& state, const CostTable& table, const Docked& docked, float scale) {
  if (begin_panel(state, docked)) {
    draw_summary(table);
    if (ImGui::BeginTable("cost", 4, ImGuiTableFlags_ScrollY)) {
      ImGui::TableSetupColumn("setting", ImGuiTableColumnFlags_WidthStretch);
      ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthFixed, 50 * scale);
      ImGui::TableSetupColumn("spread", ImGuiTableColumnFlags_WidthFixed, 88 * scale);
      ImGui::TableSetupColumn("ratio", ImGuiTableColumnFlags_WidthFixed, 56 * scale);
      std::string_view heading;
      for (const auto& line : table.lines()) {
        if (line.axis->name != heading) draw_heading(*line.axis);
        heading = line.axis->name;
        ImGui::TableNextRow();
        draw_line(state, table, line);
      }
      ImGui::EndTable();
    }
  }
  end_panel();
}

}  // namespace app
