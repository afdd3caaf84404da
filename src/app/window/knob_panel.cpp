#include "app/window/knob_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "app/commands/describe.h"
#include "app/window/knob_choices.h"
#include "app/window/panel_frame.h"

namespace app {
namespace {

const ImVec4 changed_colour{0.949F, 0.639F, 0.227F, 1};

void combo(scene::Knobs& knobs, const scene::KnobInfo& knob, const char* label) {
  const auto value = knob.get(knobs);
  if (!ImGui::BeginCombo(label, value.c_str(), ImGuiComboFlags_HeightLarge)) return;
  for (const auto& choice : knob_choices(knob)) {
    if (ImGui::Selectable(choice.c_str(), choice == value)) knob.set(knobs, choice);
  }
  ImGui::EndCombo();
}

void check_box(scene::Knobs& knobs, const scene::KnobInfo& knob, const char* label) {
  bool on = knob.get(knobs) == "on";
  if (ImGui::Checkbox(label, &on)) knob.set(knobs, on ? "on" : "off");
}

void whole_number(scene::Knobs& knobs, const scene::KnobInfo& knob, const KnobRange& range,
                  const char* label) {
  int value = 0;
  const auto text = knob.get(knobs);
  std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_wide = range.high > 1000;
  const auto flags =
      ImGuiSliderFlags_AlwaysClamp | (is_wide ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
  const bool moved =
      ImGui::SliderInt(label, &value, static_cast<int>(range.low), static_cast<int>(range.high), "%d", flags);
  if (moved) knob.set(knobs, std::to_string(value));
}

void distance(scene::Knobs& knobs, const scene::KnobInfo& knob, const KnobRange& range, const char* label) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%s", knob.get(knobs).c_str());
  const bool entered =
      ImGui::InputText(label, text.data(), text.size(),
                       ImGuiInputTextFlags_CharsScientific | ImGuiInputTextFlags_EnterReturnsTrue);
  if (!entered && !ImGui::IsItemDeactivatedAfterEdit()) return;
  double value = 0;
  const std::string_view typed(text.data());
  const auto [end, error] = std::from_chars(typed.data(), typed.data() + typed.size(), value);
  if (error != std::errc()) return;
  value = std::clamp(value, range.low, range.high);
  std::snprintf(text.data(), text.size(), "%.9g", value);
  knob.set(knobs, text.data());
}

void widget(scene::Knobs& knobs, const scene::KnobInfo& knob) {
  const std::string label = "##" + std::string(knob.name);
  if (knob.values == "off|on") return check_box(knobs, knob, label.c_str());
  const auto range = knob_range(knob);
  if (!range) return combo(knobs, knob, label.c_str());
  if (range->is_whole) return whole_number(knobs, knob, *range, label.c_str());
  distance(knobs, knob, *range, label.c_str());
}

// `idle`: why the knob does nothing; empty if it does something. A row: the name (in the accent colour when
// not the console's; click: back to the console's), then the widget.
void row(scene::Knobs& knobs, const scene::KnobInfo& knob, const std::string& idle, bool is_disabled) {
  const bool matters = idle.empty();
  static const scene::Knobs console;
  const auto initial = knob.get(console);
  const bool changed = knob.get(knobs) != initial;
  ImGui::TableNextColumn();
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, matters ? 1.0F : 0.45F);
  ImGui::AlignTextToFramePadding();
  const std::string name(knob.name);
  changed ? ImGui::TextColored(changed_colour, "%s", name.c_str()) : ImGui::TextUnformatted(name.c_str());
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%.*s\nthe console: %s%s%s%s", static_cast<int>(knob.help.size()), knob.help.data(),
                      initial.c_str(), changed ? " (click)" : "", matters ? "" : "\n", idle.c_str());
    if (changed && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) knob.set(knobs, initial);
  }
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1);
  ImGui::BeginDisabled(is_disabled);
  widget(knobs, knob);
  ImGui::EndDisabled();
  ImGui::PopStyleVar();
}

}  // namespace

void draw_knob_panel(WindowState& state, const Subject& subject, const std::string& command,
                     const Docked& docked, float scale) {
  if (begin_panel(state, docked)) {
    if (ImGui::Button("all as on the console")) {
      const scene::Knobs console;
      const int frame_width = state.knobs.width;
      const int frame_height = state.knobs.height;
      state.knobs = console;
      state.knobs.width = frame_width;
      state.knobs.height = frame_height;
      state.other = scene::Visibility::zbuffer;
    }
    if (!state.live.is_live) {  // no command draws a frame of a program that runs elsewhere
      ImGui::SameLine();
      if (ImGui::Button("copy command")) {
        ImGui::SetClipboardText(command.c_str());
      }
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", command.c_str());
    }
    if (ImGui::BeginTable("knobs", 2)) {
      ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthFixed, 104 * scale);
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
      for (const auto& knob : scene::knob_table()) {
        const bool matters =
            knob_matters(knob, state.knobs) || (state.compares() && knob_matters(knob, state.other_knobs()));
        const auto idle = subject.why_idle(knob);
        row(state.knobs, knob,
            !idle.empty() ? idle
            : matters     ? ""
                          : "changes nothing in this mode",
            !idle.empty());
      }
      ImGui::EndTable();
    }
    set_visibility(state, state.knobs.visibility);
  }
  end_panel();
}

}  // namespace app
