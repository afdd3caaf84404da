#include "app/window/vram_panel.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/window/panel_frame.h"
#include "app/window/vram_view.h"
#include "ot/gp0.h"

namespace app {
namespace {

void draw_format(VramState& vram, float scale) {
  int format = static_cast<int>(vram.format);
  ImGui::SetNextItemWidth(130 * scale);
  if (ImGui::Combo("read as", &format, display::vram_format_names.data(),
                   static_cast<int>(display::vram_format_names.size()))) {
    vram.format = static_cast<display::VramFormat>(format);
  }
  const bool has_palette =
      vram.format == display::VramFormat::bits4 || vram.format == display::VramFormat::bits8;
  ImGui::BeginDisabled(!has_palette);
  std::array<int, 2> xy{vram.palette.x, vram.palette.y};
  ImGui::SetNextItemWidth(130 * scale);
  if (ImGui::InputInt2("CLUT at x, y", xy.data())) {
    vram.palette = {std::clamp(xy[0], 0, 1008) / 16 * 16, std::clamp(xy[1], 0, 511)};
  }
  ImGui::EndDisabled();
}

bool draw_view(VramState& vram, float scale) {
  if (ImGui::Button("all of it")) vram = {vram.format, vram.palette, 1, 0, 0, vram.grid};
  ImGui::SameLine();
  ImGui::Checkbox("pages", &vram.grid);
  ImGui::SameLine();
  const bool saves = ImGui::Button("save as PNG");
  auto zoom = static_cast<float>(vram.zoom);
  ImGui::SetNextItemWidth(130 * scale);
  if (ImGui::SliderFloat("zoom", &zoom, 1, 64, "x %.1f", ImGuiSliderFlags_Logarithmic)) {
    vram.zoom = static_cast<double>(zoom);
    pan_vram(vram, 0, 0);
  }
  ImGui::TextDisabled("wheel: nearer; drag: move; click: whose pixel");
  return saves;
}

std::string place_text(const inspect::Rectangle& place) {
  return std::to_string(place.x) + "," + std::to_string(place.y) + "  " + std::to_string(place.width) + "x" +
         std::to_string(place.height);
}

void draw_accesses(WindowState& state, const debug::FrameView& view, std::span<const debug::Access> accesses,
                   float scale) {
  std::vector<const debug::Access*> shown;
  const auto& pinned = state.lens.pinned;
  for (const auto& access : accesses) {
    const bool is_here = !pinned || access.has(static_cast<int>(*pinned % gpu::Vram::width),
                                               static_cast<int>(*pinned / gpu::Vram::width));
    if (is_here) shown.push_back(&access);
  }
  if (pinned) {
    ImGui::Text("this frame at %u, %u:", *pinned % gpu::Vram::width, *pinned / gpu::Vram::width);
    ImGui::SameLine();
    if (ImGui::SmallButton("everywhere")) state.lens.pinned.reset();
  } else {
    ImGui::TextUnformatted("this frame reads and writes:");
  }
  if (!ImGui::BeginTable("accesses", 3, ImGuiTableFlags_ScrollY)) return;
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 60 * scale);
  ImGui::TableSetupColumn("where", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("commands", ImGuiTableColumnFlags_WidthFixed, 70 * scale);
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(shown.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto& access = *shown[static_cast<std::size_t>(i)];
      const auto& row = view.rows()[access.row];
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      const auto name = debug::access_names[static_cast<std::size_t>(access.kind)];
      const auto label = std::string(name) + "##" + std::to_string(i);
      if (ImGui::Selectable(label.c_str(), state.lens.selected == row.item,
                            ImGuiSelectableFlags_SpanAllColumns)) {
        state.lens.selected = row.item;
        show_rectangle(state.vram, access.place.x, access.place.y, access.place.width, access.place.height);
      }
      if (ImGui::IsItemHovered()) wrapped_tooltip(std::to_string(row.number) + ": " + row.text);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(place_text(access.place).c_str());
      ImGui::TableNextColumn();
      if (access.commands == 1) {
        ImGui::Text("K %u", row.number);
      } else {
        ImGui::Text("%zu, K %u", access.commands, row.number);
      }
    }
  }
  ImGui::EndTable();
}

}  // namespace

void show_page_of(VramState& vram, const gpu::Primitive& primitive) {
  const auto format = primitive.state.texel_format();
  const bool is_clut4 = format == gpu::TexelFormat::clut4, is_clut8 = format == gpu::TexelFormat::clut8;
  vram.format = is_clut4   ? display::VramFormat::bits4
                : is_clut8 ? display::VramFormat::bits8
                           : display::VramFormat::bits15;
  if (is_clut4 || is_clut8) {
    vram.palette = {static_cast<int>(ot::gp0::clut::X16::get(primitive.clut)) * 16,
                    static_cast<int>(ot::gp0::clut::Y::get(primitive.clut))};
  }
  show_rectangle(vram, primitive.state.page_x(), primitive.state.page_y(),
                 is_clut4   ? 64
                 : is_clut8 ? 128
                            : 256,
                 256);
}

bool draw_vram_panel(WindowState& state, const debug::FrameView* view,
                     std::span<const debug::Access> accesses, const Docked& docked, float scale) {
  bool saves = false;
  if (begin_panel(state, docked)) {
    draw_format(state.vram, scale);
    saves = draw_view(state.vram, scale);
    const auto row =
        view != nullptr && state.lens.selected ? view->row_of_item(*state.lens.selected) : std::nullopt;
    const auto* drawn = row ? view->primitive(view->rows()[*row]) : nullptr;
    if (drawn != nullptr && drawn->is_textured() &&
        ImGui::Button("page and palette of the command selected")) {
      show_page_of(state.vram, *drawn);
    }
    ImGui::Separator();
    if (view != nullptr) draw_accesses(state, *view, accesses, scale);
  }
  end_panel();
  return saves;
}

}  // namespace app
