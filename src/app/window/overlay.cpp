#include "app/window/overlay.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>

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

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

const char* pace_name(Pace pace) {
  switch (pace) {
    case Pace::vsync:
      return "vsync";
    case Pace::hz60:
      return "60 Hz";
    case Pace::hz50:
      return "50 Hz";
  }
  return "";
}

// Writes pieces side by side; a piece that no longer fits before `end` is left out.
struct Line {
  ImDrawList* list;
  float x, y, end;
  void add(const std::string& text, ImU32 colour) {
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    if (x + width > end) {
      end = x;  // nothing after the first piece left out, or the order would lie
      return;
    }
    list->AddText({x, y}, colour, text.c_str());
    x += width + 2 * ImGui::CalcTextSize(" ").x;
  }
};

void key_cell(std::string_view text) {
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(accent_colour), "%.*s", static_cast<int>(text.size()),
                     text.data());
}

void wrapped(std::string_view text) {
  ImGui::TextWrapped("%.*s", static_cast<int>(text.size()), text.data());
}

}  // namespace

int status_height(float scale) { return static_cast<int>(13 * scale) + 10; }

void draw_status(const WindowState& state, const Status& status, Rect bar, float scale) {
  auto* list = ImGui::GetBackgroundDrawList();
  list->AddRectFilled(at(bar.x, bar.y), at(bar.x + bar.width, bar.y + bar.height), bar_colour);
  list->AddLine(at(bar.x, bar.y), at(bar.x + bar.width, bar.y), IM_COL32(0x3a, 0x3a, 0x4a, 255));
  const float y = static_cast<float>(bar.y) + 5;
  const std::string help = "F1 help";
  const float help_x = static_cast<float>(bar.x + bar.width) - 10 - ImGui::CalcTextSize(help.c_str()).x;
  list->AddText({help_x, y}, dim_colour, help.c_str());

  Line line{list, static_cast<float>(bar.x) + 10, y, help_x - 12 * scale};
  line.add(status.scene, accent_colour);
  line.add(describe(state.knobs), text_colour);
  line.add(with_commas(status.stats.primitives) + " primitives", dim_colour);
  if (status.different) line.add(with_commas(*status.different) + " differ", mark_colour);
  line.add(format("GTE %.2f  OT %.2f  raster %.2f ms", status.stats.gte_ms, status.stats.ot_ms,
                  status.stats.raster_ms),
           text_colour);
  line.add(state.paused ? format("paused at frame %lld", static_cast<long long>(state.frame))
                        : format("%.0f/s %s", status.frames_per_second, pace_name(state.pace)),
           state.paused ? accent_colour : dim_colour);
}

void draw_captions(const WindowState& state, Rect picture, float scale) {
  const float y = static_cast<float>(picture.y) + 8 * scale;
  const auto left = static_cast<float>(picture.x) + 10 * scale;
  const auto right = static_cast<float>(picture.x + picture.width) - 10 * scale;
  if (state.split) {
    draw_label(describe(state.knobs), left, y, 0, text_colour);
    draw_label(describe(state.other_knobs()), right, y, 1, text_colour);
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

void draw_message(const std::string& text, bool is_error, Rect area, float scale) {
  if (text.empty()) return;
  const auto x = static_cast<float>(area.x) + static_cast<float>(area.width) / 2;
  const auto y = static_cast<float>(area.y + area.height) - 30 * scale;
  draw_label(text, x, y, 0.5F, is_error ? error_colour : text_colour);
}

}  // namespace app
