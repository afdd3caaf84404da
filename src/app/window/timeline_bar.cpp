#include "app/window/timeline_bar.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/commands/describe.h"

namespace app {
namespace {

constexpr ImU32 groove = IM_COL32(0x0b, 0x0b, 0x10, 255);
constexpr ImU32 played = IM_COL32(0x34, 0x34, 0x4a, 255);
constexpr ImU32 looped = IM_COL32(0x4c, 0x5c, 0x8c, 255);
constexpr ImU32 cursor = IM_COL32(0xf2, 0xa3, 0x3a, 255);
constexpr ImU32 difference_colour = IM_COL32(0xff, 0x4c, 0xb0, 255);

// A groove to drag in. Where the mouse is in it, 0..1, while it is held.
std::optional<double> scrubbed(const char* id, ImVec2 size) {
  ImGui::InvisibleButton(id, size);
  if (!ImGui::IsItemActive()) return std::nullopt;
  const double across = static_cast<double>(ImGui::GetIO().MousePos.x - ImGui::GetItemRectMin().x) /
                        std::max(static_cast<double>(size.x), 1.0);
  return std::clamp(across, 0.0, 1.0);
}

struct Groove {
  ImVec2 corner, size;
  [[nodiscard]] float x(double place) const { return corner.x + size.x * static_cast<float>(place); }
  void fill(double from, double to, ImU32 colour) const {
    ImGui::GetWindowDrawList()->AddRectFilled({x(from), corner.y}, {x(to), corner.y + size.y}, colour);
  }
  void line(double place, ImU32 colour) const {
    ImGui::GetWindowDrawList()->AddRectFilled({x(place) - 1, corner.y - 1},
                                              {x(place) + 2, corner.y + size.y + 1}, colour);
  }
};

void draw_frames(WindowState& state, const TimelineMarks& marks, const Groove& where) {
  const auto& recorded = state.recorded;
  const auto count = recorded.last - recorded.first + 1;
  const auto begin = [&](std::int64_t frame) {
    return static_cast<double>(frame - recorded.first) / static_cast<double>(count);
  };
  const auto under = [&](double place) { return frame_at(place, count) + recorded.first - 1; };
  where.fill(0, 1, groove);
  where.fill(0, marks.progress, played);
  if (recorded.from) where.fill(begin(*recorded.from), begin(recorded.last_played() + 1), looped);
  if (marks.first_different && *marks.first_different >= recorded.first)
    where.line(place_of_frame(*marks.first_different - recorded.first + 1, count), difference_colour);
  where.line(place_of_frame(state.frame - recorded.first + 1, count), cursor);
  if (const auto place = scrubbed("frames", where.size)) pause_at(state, under(*place));
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
    const double across = static_cast<double>(ImGui::GetIO().MousePos.x - where.corner.x) / where.size.x;
    ImGui::SetTooltip("frame %lld%s", static_cast<long long>(under(across)),
                      marks.first_different ? "\npink: where the pictures first differ, of those seen" : "");
  }
}

void draw_commands(WindowState& state, const TimelineMarks& marks, const Groove& where) {
  where.fill(0, 1, groove);
  const double shown = marks.commands == 0 || !state.lens.shown
                           ? 1
                           : static_cast<double>(*state.lens.shown) / static_cast<double>(marks.commands);
  where.fill(0, shown, played);
  where.line(shown, cursor);
  if (const auto place = scrubbed("commands", where.size); place && marks.commands != 0) {
    state.paused = true;
    state.lens.shown = commands_at(*place, marks.commands);
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("commands of this frame: only those before are drawn");
}

}  // namespace

std::int64_t frame_at(double place, std::int64_t last) {
  const auto frame = static_cast<std::int64_t>(std::floor(place * static_cast<double>(last))) + 1;
  return std::clamp<std::int64_t>(frame, 1, std::max<std::int64_t>(last, 1));
}

double place_of_frame(std::int64_t frame, std::int64_t last) {
  return (static_cast<double>(frame) - 0.5) / static_cast<double>(std::max<std::int64_t>(last, 1));
}

std::optional<std::size_t> commands_at(double place, std::size_t commands) {
  const auto count = static_cast<std::size_t>(std::round(place * static_cast<double>(commands)));
  if (count >= commands) return std::nullopt;
  return count;
}

int timeline_height(const WindowState& state, float scale) {
  return state.recorded.last == 0 ? 0 : static_cast<int>(62 * scale);
}

void draw_timeline(WindowState& state, const TimelineMarks& marks, Rect bar, float scale) {
  if (state.recorded.last == 0) return;
  ImGui::SetNextWindowPos({static_cast<float>(bar.x), static_cast<float>(bar.y)}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({static_cast<float>(bar.width), static_cast<float>(bar.height)}, ImGuiCond_Always);
  constexpr auto flags =
      ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8, 4});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {6, 3});
  if (ImGui::Begin("timeline", nullptr, flags)) {
    if (ImGui::SmallButton(state.paused ? "play" : "pause")) state.paused = !state.paused;
    ImGui::SameLine();
    if (ImGui::SmallButton("<")) handle(state, {KeyAction::previous_frame});
    ImGui::SameLine();
    if (ImGui::SmallButton(">")) handle(state, {KeyAction::next_frame});
    ImGui::SameLine();
    if (state.live.is_live) {
      if (ImGui::SmallButton(state.live.is_recording ? "end recording (F8)" : "record (F8)"))
        handle(state, {KeyAction::record});
    } else if (ImGui::SmallButton("loop (L)")) {
      handle(state, {KeyAction::loop});
    }
    ImGui::SameLine();
    ImGui::Text("frame %s of %s", with_commas(static_cast<std::uint64_t>(state.frame)).c_str(),
                with_commas(static_cast<std::uint64_t>(state.recorded.last)).c_str());
    if (marks.commands != 0) {
      ImGui::SameLine();
      ImGui::TextDisabled("command %s of %s", with_commas(state.lens.shown.value_or(marks.commands)).c_str(),
                          with_commas(marks.commands).c_str());
    }
    if (marks.progress < 1) {
      ImGui::SameLine();
      ImGui::TextDisabled("indexing %.0f%%", marks.progress * 100);
    }
    const float width = std::max(ImGui::GetContentRegionAvail().x, 20.0F);
    draw_frames(state, marks, {ImGui::GetCursorScreenPos(), {width, 16 * scale}});
    draw_commands(state, marks, {ImGui::GetCursorScreenPos(), {width, 9 * scale}});
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace app
