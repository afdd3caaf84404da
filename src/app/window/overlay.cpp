#include "app/window/overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/commands/describe.h"

namespace app {
namespace {

constexpr ImU32 text_colour = IM_COL32(0xe8, 0xe6, 0xdf, 255);
constexpr ImU32 dim_colour = IM_COL32(0x8d, 0x8b, 0x98, 255);
constexpr ImU32 accent_colour = IM_COL32(0xf2, 0xa3, 0x3a, 255);
constexpr ImU32 mark_colour = IM_COL32(0xff, 0x4c, 0xb0, 255);
constexpr ImU32 error_colour = IM_COL32(0xff, 0x6b, 0x5a, 255);
constexpr ImU32 bar_colour = IM_COL32(0x14, 0x14, 0x1c, 255);
constexpr ImU32 box_colour = IM_COL32(0x14, 0x14, 0x1c, 0xd8);

ImVec2 at(int x, int y) { return {static_cast<float>(x), static_cast<float>(y)}; }

// A label on a dark box, so that it reads over any picture. `align`: 0 left of x, 1 right of it.
void draw_label(const std::string& text, float x, float y, float align, ImU32 colour) {
  auto* list = ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float left = x - align * size.x;
  list->AddRectFilled({left - 6, y - 3}, {left + size.x + 6, y + size.y + 3}, box_colour);
  list->AddText({left, y}, colour, text.c_str());
}

ImU32 colour_of(Tone tone) {
  constexpr std::array colours{text_colour, dim_colour, accent_colour, mark_colour};
  return colours[static_cast<std::size_t>(tone)];
}

void key_cell(std::string_view text) {
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(accent_colour), "%.*s", static_cast<int>(text.size()),
                     text.data());
}

void wrapped(std::string_view text) {
  ImGui::TextWrapped("%.*s", static_cast<int>(text.size()), text.data());
}

}  // namespace

int status_height(float scale, std::size_t rows) {
  return static_cast<int>(15 * scale) * static_cast<int>(rows) + 8;
}

void draw_status(const std::vector<std::vector<StatusPiece>>& rows, Rect bar, float scale) {
  auto* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled(at(bar.x, bar.y), at(bar.x + bar.width, bar.y + bar.height), bar_colour);
  list->AddLine(at(bar.x, bar.y), at(bar.x + bar.width, bar.y), IM_COL32(0x3a, 0x3a, 0x4a, 255));
  const float letter = ImGui::CalcTextSize("0").x;
  float y = static_cast<float>(bar.y) + 5;
  for (const auto& row : rows) {
    float x = static_cast<float>(bar.x) + 10;
    for (const auto& piece : row) {
      list->AddText({x, y}, colour_of(piece.tone), piece.text.c_str());
      x += letter * static_cast<float>(piece.text.size() + 2);
    }
    y += std::floor(15 * scale);
  }
}

void draw_captions(const WindowState& state, Rect picture, float scale) {
  const float y = static_cast<float>(picture.y) + 8 * scale;
  const auto left = static_cast<float>(picture.x) + 10 * scale;
  const auto right = static_cast<float>(picture.x + picture.width) - 10 * scale;
  if (state.split) {
    const auto here = describe(state.knobs);
    const auto there = describe(state.other_knobs());
    const float both = ImGui::CalcTextSize((here + there).c_str()).x + 40 * scale;
    const bool has_room = static_cast<float>(picture.width) > both;  // side by side, or one below the other
    draw_label(here, left, y, 0, text_colour);
    draw_label(there, right, has_room ? y : y + ImGui::GetTextLineHeight() + 8, 1, text_colour);
  } else if (state.differences) {
    draw_label(describe(state.knobs) + "  against  " + describe(state.other_knobs()), left, y, 0,
               mark_colour);
  }
}

void draw_divider(const WindowState& state, Rect picture) {
  auto* list = ImGui::GetBackgroundDrawList();
  const int x = picture.x + static_cast<int>(state.divider * picture.width);
  const int middle = picture.y + picture.height / 2;
  list->AddRectFilled(at(x - 1, picture.y), at(x + 1, picture.y + picture.height), accent_colour);
  list->AddRectFilled(at(x - 5, middle - 18), at(x + 5, middle + 18), accent_colour);
  for (const int dy : {-6, 0, 6}) {
    list->AddLine(at(x - 2, middle + dy), at(x + 3, middle + dy), bar_colour);
  }
}

void draw_help(WindowState& state, Rect area, float scale) {
  ImGui::SetNextWindowPos(at(area.x + area.width / 2, area.y + area.height / 2), ImGuiCond_Always,
                          {0.5F, 0.5F});
  ImGui::SetNextWindowSizeConstraints({0, 0}, at(area.width, area.height));
  constexpr auto flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Keys", &state.help, flags) && ImGui::BeginTable("keys", 2)) {
    const float keys = 230 * scale;
    const float room = static_cast<float>(area.width) - keys - 60 * scale;  // of a small window
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, keys);
    ImGui::TableSetupColumn("does", ImGuiTableColumnFlags_WidthFixed,
                            std::clamp(room, 60 * scale, 460 * scale));
    for (const auto& row : bindings()) {
      ImGui::TableNextColumn();
      key_cell(row.key);
      if (!row.other_key.empty()) {
        ImGui::SameLine();
        key_cell(row.other_key);
      }
      if (!row.button.empty()) {
        ImGui::SameLine();
        ImGui::TextDisabled("(%.*s)", static_cast<int>(row.button.size()), row.button.data());
      }
      ImGui::TableNextColumn();
      wrapped(row.does);
    }
    for (const auto& gesture : gestures()) {
      ImGui::TableNextColumn();
      key_cell(gesture.how);
      ImGui::TableNextColumn();
      wrapped(gesture.does);
    }
    ImGui::EndTable();
    ImGui::TextDisabled("In brackets: the game controller.");
  }
  ImGui::End();
}

void draw_reason(const std::string& text, Rect picture) {
  if (text.empty()) return;
  const float room = std::max(static_cast<float>(picture.width) - 40, 80.0F);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, room);
  const float x = static_cast<float>(picture.x) + (static_cast<float>(picture.width) - size.x) / 2;
  const float y = static_cast<float>(picture.y) + (static_cast<float>(picture.height) - size.y) / 2;
  auto* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled({x - 10, y - 8}, {x + size.x + 10, y + size.y + 8}, box_colour);
  list->AddText(ImGui::GetFont(), ImGui::GetFontSize(), {x, y}, text_colour, text.c_str(), nullptr, room);
}

void draw_message(const std::string& text, bool is_error, Rect area, float scale) {
  if (text.empty()) return;
  const auto x = static_cast<float>(area.x) + static_cast<float>(area.width) / 2;
  const auto y = static_cast<float>(area.y + area.height) - 30 * scale;
  draw_label(text, x, y, 0.5F, is_error ? error_colour : text_colour);
}

}  // namespace app
