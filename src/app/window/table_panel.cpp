#include "app/window/table_panel.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "app/commands/describe.h"
#include "app/window/panel_frame.h"
#include "inspect/history.h"

namespace app {
namespace {

using debug::Row;

const ImVec4 accent{0.949F, 0.639F, 0.227F, 1};
const ImVec4 wrong_colour{1, 0.3F, 0.69F, 1};
const ImVec4 fault_colour{1, 0.42F, 0.353F, 1};

const char* c_str(const std::string& text) { return text.c_str(); }

template <class Choice>
void combo(const char* label, std::optional<Choice>& value, std::initializer_list<const char*> names,
           float width) {
  std::string items("any");
  items.push_back('\0');
  for (const auto* name : names) {
    items += name;
    items.push_back('\0');
  }
  int chosen = value ? static_cast<int>(*value) + 1 : 0;
  ImGui::SetNextItemWidth(width);
  if (!ImGui::Combo(label, &chosen, items.c_str())) return;
  value = chosen == 0 ? std::nullopt : std::optional(static_cast<Choice>(chosen - 1));
}

void draw_filter(LensState& lens, const debug::FrameView& view, float scale) {
  auto& filter = lens.filter;
  ImGui::SetNextItemWidth(-60 * scale);
  ImGui::InputTextWithHint("##search", "search: words, origin, F:K", &filter.text);
  ImGui::SameLine();
  if (ImGui::Button("clear")) filter = {};
  combo("kind", filter.kind, {"polygon", "rectangle", "line", "fill", "copy", "upload"}, 90 * scale);
  ImGui::SameLine();
  combo("blend", filter.blend, {"opaque", "average", "add", "subtract", "add 1/4"}, 90 * scale);
  ImGui::Checkbox("drawing", &filter.only_drawing);
  ImGui::SameLine();
  ImGui::Checkbox("still seen", &filter.only_seen);
  ImGui::SameLine();
  ImGui::Checkbox("wrong", &filter.only_wrong);
  ImGui::SameLine();
  ImGui::Checkbox("suspect", &filter.only_faulty);
  if (lens.pinned) {
    bool is_here = filter.rectangle.has_value();
    if (ImGui::Checkbox("wrote the pinned pixel", &is_here)) {
      const auto x = static_cast<int>(*lens.pinned % gpu::Vram::width);
      const auto y = static_cast<int>(*lens.pinned / gpu::Vram::width);
      filter.rectangle = is_here ? std::optional(inspect::Rectangle{x, y, 1, 1}) : std::nullopt;
    }
  }
  const auto row = lens.selected ? view.row_of_item(*lens.selected) : std::nullopt;
  const auto* drawn = row ? view.primitive(view.rows()[*row]) : nullptr;
  const bool is_textured = drawn != nullptr && drawn->is_textured();
  const auto same = [](const char* label, std::optional<std::uint32_t>& value, bool has, std::uint32_t own) {
    if (!has && !value) return;
    bool on = value.has_value();
    ImGui::SameLine(0, 8);
    if (ImGui::Checkbox(label, &on)) value = on ? std::optional(own) : std::nullopt;
  };
  if (!is_textured && !filter.page && !filter.clut && !filter.bucket) return;
  ImGui::TextDisabled("as selected:");
  same("page", filter.page, is_textured, is_textured ? drawn->state.draw_mode : 0);
  same("CLUT", filter.clut, is_textured, is_textured ? drawn->clut : 0);
  if (row) same("bucket", filter.bucket, view.clip().buckets != 0, view.rows()[*row].bucket);
}

// Bars from bucket 0, the nearest, to the last; a click opens the fullest of a bar.
void draw_histogram(LensState& lens, const debug::FrameView& view, float scale) {
  if (view.clip().buckets == 0) return;
  const float width = std::max(ImGui::GetContentRegionAvail().x, 40.0F), height = 64 * scale;
  const auto bars = histogram(view, static_cast<std::size_t>(std::max(width / (3 * scale), 4.0F)));
  if (bars.empty()) return;
  std::uint32_t most = 1;
  for (const auto& bar : bars) most = std::max(most, bar.commands);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  auto* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(corner, {corner.x + width, corner.y + height}, IM_COL32(0x0b, 0x0b, 0x10, 255));
  const float each = width / static_cast<float>(bars.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    const auto& bar = bars[i];
    if (bar.commands == 0) continue;
    const float x = corner.x + each * static_cast<float>(i);
    const float high = std::max(height * static_cast<float>(bar.commands) / static_cast<float>(most), 2.0F);
    const bool is_open = lens.open_bucket && *lens.open_bucket >= bar.first && *lens.open_bucket <= bar.last;
    list->AddRectFilled({x, corner.y + height - high}, {x + std::max(each - 1, 1.0F), corner.y + height},
                        is_open ? IM_COL32(0xf2, 0xa3, 0x3a, 255) : IM_COL32(0x6c, 0x8c, 0xc8, 255));
  }
  ImGui::InvisibleButton("histogram", {width, height});
  if (ImGui::IsItemHovered()) {
    const float across = (ImGui::GetIO().MousePos.x - corner.x) / width;
    const auto i = std::min(
        static_cast<std::size_t>(std::max(across, 0.0F) * static_cast<float>(bars.size())), bars.size() - 1);
    ImGui::SetTooltip("buckets %u..%u: %u commands", bars[i].first, bars[i].last, bars[i].commands);
    if (ImGui::IsItemClicked() && bars[i].commands != 0) lens.open_bucket = bars[i].fullest;
  }
  const auto used =
      std::count_if(view.buckets().begin(), view.buckets().end(), [](auto n) { return n != 0; });
  ImGui::TextDisabled("bucket 0, near .. %u, far; %lld used", view.clip().buckets - 1,
                      static_cast<long long>(used));
}

void draw_head(LensState& lens, const debug::FrameView& view, const TableLine& line) {
  ImGui::TableNextColumn();
  const bool is_open = lens.open_bucket == line.group;
  std::string text = is_open ? "v " : "> ";
  if (view.clip().buckets == 0) {
    text += view.groups()[line.group].text;
  } else if (line.group == gpu::no_bucket) {
    text += "before the table: " + std::to_string(line.count);
  } else {
    text += "bucket " + std::to_string(line.group) + ": " + std::to_string(line.count);
  }
  text += "##head" + std::to_string(line.row);
  if (ImGui::Selectable(c_str(text), false, ImGuiSelectableFlags_SpanAllColumns)) {
    lens.open_bucket = is_open ? std::nullopt : std::optional(line.group);
  }
}

void draw_row(WindowState& state, const Lens& lens, std::size_t index) {
  const auto& view = *lens.view();
  const Row& row = view.rows()[index];
  const auto& item = view.item(row);
  const bool is_selected = state.lens.selected == row.item;
  const bool is_undrawn = state.lens.shown && index >= *state.lens.shown;
  const auto text_colour = is_undrawn           ? ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled)
                           : !row.fault.empty() ? fault_colour
                           : is_selected        ? accent
                                                : ImGui::GetStyleColorVec4(ImGuiCol_Text);
  ImGui::PushStyleColor(ImGuiCol_Text, text_colour);
  ImGui::TableNextColumn();
  const auto label = "  " + lens.number(row) + "  " + row.text + "##row" + std::to_string(index);
  if (ImGui::Selectable(c_str(label), is_selected, ImGuiSelectableFlags_SpanAllColumns)) {
    state.lens.selected = row.item;
  }
  if (ImGui::IsItemHovered()) {
    wrapped_tooltip(row.text + (row.fault.empty() ? "" : "\n" + row.fault));
  }
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(item.origin.c_str());
  ImGui::TableNextColumn();
  if (row.draws != 0) ImGui::TextUnformatted(c_str(with_commas(row.written)));
  ImGui::TableNextColumn();
  if (row.draws != 0) ImGui::TextUnformatted(c_str(with_commas(row.seen)));
  ImGui::TableNextColumn();
  if (row.wrong != 0) ImGui::TextColored(wrong_colour, "%s", c_str(with_commas(row.wrong)));
  ImGui::PopStyleColor();
}

void draw_lines(WindowState& state, const Lens& lens, float height, float scale) {
  const auto& view = *lens.view();
  const auto lines = table_lines(view, state.lens);
  constexpr auto flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_Resizable | ImGuiTableFlags_BordersInnerV;
  if (!ImGui::BeginTable("rows", 5, flags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("command", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("origin", ImGuiTableColumnFlags_WidthFixed, 50 * scale);
  ImGui::TableSetupColumn("wrote", ImGuiTableColumnFlags_WidthFixed, 42 * scale);
  ImGui::TableSetupColumn("seen", ImGuiTableColumnFlags_WidthFixed, 42 * scale);
  ImGui::TableSetupColumn("wrong", ImGuiTableColumnFlags_WidthFixed, 36 * scale);
  ImGui::TableHeadersRow();
  static std::optional<std::size_t> followed;  // the selection that was scrolled to
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(lines.size()));
  if (state.lens.selected && state.lens.selected != followed) {
    const auto line = std::find_if(lines.begin(), lines.end(), [&](const TableLine& one) {
      return !one.is_head && view.rows()[one.row].item == *state.lens.selected;
    });
    if (line != lines.end()) {
      const auto at = static_cast<float>(line - lines.begin()) * ImGui::GetTextLineHeightWithSpacing();
      ImGui::SetScrollY(std::max(at - height / 2, 0.0F));
    }
  }
  followed = state.lens.selected;
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const auto& line = lines[static_cast<std::size_t>(i)];
      ImGui::TableNextRow();
      line.is_head ? draw_head(state.lens, view, line) : draw_row(state, lens, line.row);
    }
  }
  ImGui::EndTable();
}

// The words of the item as they are now, to be written into.
std::vector<std::uint32_t>& words_to_edit(debug::Edits& edits, const debug::Clip& clip, std::size_t item) {
  return edits.words.try_emplace(item, clip.items[item].words).first->second;
}

void draw_words(LensState& lens, const debug::FrameView& view, std::size_t item, float scale) {
  auto now = view.clip().items[item];
  if (const auto changed = lens.edits.words.find(item); changed != lens.edits.words.end())
    now.words = changed->second;
  int n = 0;
  for (const auto word : debug::vertex_words(now)) {
    const auto corner = debug::corner_of(now.words[word]);
    std::array<int, 2> xy{corner.x, corner.y};
    ImGui::SetNextItemWidth(150 * scale);
    if (ImGui::InputInt2(c_str("vertex " + std::to_string(n++)), xy.data())) {
      words_to_edit(lens.edits, view.clip(), item)[word] =
          debug::with_corner(now.words[word], {xy[0], xy[1]});
    }
  }
  n = 0;
  for (const auto word : debug::colour_words(now)) {
    const auto bits = now.words[word];
    std::array<float, 3> rgb{static_cast<float>(bits & 255) / 255, static_cast<float>(bits >> 8 & 255) / 255,
                             static_cast<float>(bits >> 16 & 255) / 255};
    ImGui::SetNextItemWidth(150 * scale);
    if (ImGui::ColorEdit3(c_str("colour " + std::to_string(n++)), rgb.data(), ImGuiColorEditFlags_Uint8)) {
      const auto byte = [&rgb](std::size_t i) {
        return static_cast<std::uint32_t>(rgb[i] * 255 + 0.5F) & 255;
      };
      words_to_edit(lens.edits, view.clip(), item)[word] =
          (bits & 0xff000000) | byte(0) | byte(1) << 8 | byte(2) << 16;
    }
  }
}

void draw_what_if(LensState& lens, const debug::FrameView& view, std::size_t item, float scale) {
  bool is_hidden = lens.edits.hidden.contains(item);
  if (ImGui::Checkbox("hidden", &is_hidden)) {
    is_hidden ? void(lens.edits.hidden.insert(item)) : void(lens.edits.hidden.erase(item));
  }
  ImGui::SameLine();
  bool is_alone = lens.edits.solo.contains(item);
  if (ImGui::Checkbox("alone", &is_alone)) {
    is_alone ? void(lens.edits.solo.insert(item)) : void(lens.edits.solo.erase(item));
  }
  if (view.clip().buckets != 0) {
    const auto changed = lens.edits.buckets.find(item);
    int bucket = static_cast<int>(changed != lens.edits.buckets.end() ? changed->second
                                                                      : view.clip().items[item].bucket);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(100 * scale);
    if (ImGui::InputInt("bucket", &bucket)) {
      lens.edits.buckets[item] =
          static_cast<std::uint32_t>(std::clamp(bucket, 0, static_cast<int>(view.clip().buckets) - 1));
    }
  }
  static int target = 1;
  ImGui::SetNextItemWidth(100 * scale);
  ImGui::InputInt("##target", &target);
  const auto& items = view.clip().items;
  const auto found = std::find_if(items.begin(), items.end(), [](const auto& one) {
    return static_cast<int>(one.number) == target && !one.is_rest;
  });
  const auto move = [&](bool is_behind) {
    if (found == items.end()) return;
    lens.edits.moves.push_back({item, static_cast<std::size_t>(found - items.begin()), is_behind});
  };
  ImGui::SameLine();
  if (ImGui::Button("move before")) move(false);
  ImGui::SameLine();
  if (ImGui::Button("behind")) move(true);
  ImGui::SameLine();
  ImGui::TextDisabled("command K");
  draw_words(lens, view, item, scale);
}

void draw_details(WindowState& state, Lens& lens, float scale, TableAsks& asks) {
  auto& own = state.lens;
  auto& view = *lens.view();
  if (!own.edits.is_empty()) {
    if (ImGui::Button("undo all changes")) own.edits = {};
    ImGui::SameLine();
    asks.exports = ImGui::Button("export the change as a dump");
  }
  if (!own.selected) {
    ImGui::TextDisabled("Click a command here, or a pixel of the picture.");
  } else if (const auto row = view.row_of_item(*own.selected)) {
    const Row& one = view.rows()[*row];
    const auto& item = view.item(one);
    ImGui::TextColored(accent, "%s", c_str(lens.number(one)));
    ImGui::SameLine();
    ImGui::TextWrapped("%s", one.text.c_str());
    std::string about = item.origin;
    if (view.clip().is_list_in_ram && !(item.address == 0 && item.origin.empty())) {
      std::array<char, 24> address{};
      std::snprintf(address.data(), address.size(), "tag %06Xh", item.address);
      about += (about.empty() || about.starts_with(address.data() + 4) ? std::string() : "  ");
      if (!about.starts_with(address.data() + 4)) about += address.data();
    }
    if (item.key) about += "  key " + std::to_string(*item.key);
    if (const auto* drawn = view.primitive(one)) {
      if (drawn->has_depth) {
        std::uint32_t near = ~0U, far = 0;
        for (std::size_t v = 0; v < drawn->vertex_count; ++v) {
          near = std::min(near, drawn->vertices[v].z);
          far = std::max(far, drawn->vertices[v].z);
        }
        about += "  z " + std::to_string(near >> 12) + ".." + std::to_string(far >> 12);
      }
      if (drawn->is_textured()) about += "  " + debug::page_text(drawn->state.draw_mode);
      about += "  wrote " + with_commas(one.written) + ", seen " + with_commas(one.seen);
    }
    if (!about.empty()) ImGui::TextWrapped("%s", about.c_str());
    if (!one.fault.empty()) ImGui::TextColored(fault_colour, "%s", one.fault.c_str());
    draw_what_if(own, view, *own.selected, scale);
  } else {
    ImGui::TextWrapped("%s", c_str("left out: " + view.clip().items[*own.selected].text()));
    draw_what_if(own, view, *own.selected, scale);
  }
  if (!own.pinned) return;
  ImGui::Separator();
  const auto& report = lens.report();
  const int x = static_cast<int>(*own.pinned % gpu::Vram::width) - report.picture.x;
  const int y = static_cast<int>(*own.pinned / gpu::Vram::width) - report.picture.y;
  for (const auto& line : inspect::pixel_history(report, view.trace(), x, y))
    ImGui::TextWrapped("%s", line.c_str());
  if (ImGui::Button("unpin")) own.pinned.reset();
}

void draw_lint(const debug::FrameView& view) {
  if (view.trace().is_full)
    ImGui::TextColored(fault_colour, "%s", c_str("counts are short: " + view.trace().limit_text()));
  for (const auto& note : view.clip().notes) ImGui::TextWrapped("%s", note.c_str());
  for (const auto& lint : view.clip().lint) {
    if (lint.text.starts_with("not available")) continue;
    ImGui::TextColored(fault_colour, "%s", c_str(lint.kind + " " + lint.at));
    if (ImGui::IsItemHovered()) wrapped_tooltip(lint.text);
  }
}

}  // namespace

TableAsks draw_table_panel(WindowState& state, Lens& lens, const Docked& docked, float scale) {
  TableAsks asks;
  if (begin_panel(state, docked) && lens.view() != nullptr) {
    draw_filter(state.lens, *lens.view(), scale);
    ImGui::TextDisabled("%s", c_str(to_text(shares_of(lens.view()->clip()))));
    draw_lint(*lens.view());
    draw_histogram(state.lens, *lens.view(), scale);
    const float room = ImGui::GetContentRegionAvail().y;
    draw_lines(state, lens, std::max(room * 0.5F, 60 * scale), scale);
    ImGui::BeginChild("details");
    draw_details(state, lens, scale, asks);
    ImGui::EndChild();
  }
  end_panel();
  return asks;
}

}  // namespace app
