#include "app/window/selection.h"

#include <imgui.h>

#include <array>
#include <vector>

#include "gpu/primitive.h"

namespace app {
namespace {

constexpr ImU32 outline_colour = IM_COL32(0xff, 0xff, 0xff, 255);
constexpr ImU32 source_colour = IM_COL32(0x7a, 0xcc, 0x7f, 255);
constexpr ImU32 pin_colour = IM_COL32(0xff, 0x4c, 0xb0, 255);

ImVec2 screen_at(const VramMapping& mapping, double x, double y) {
  return {static_cast<float>(mapping.to_x(x)), static_cast<float>(mapping.to_y(y))};
}

class Clipped {
 public:
  explicit Clipped(Rect clip) : list_(ImGui::GetBackgroundDrawList()) {
    list_->PushClipRect({static_cast<float>(clip.x), static_cast<float>(clip.y)},
                        {static_cast<float>(clip.x + clip.width), static_cast<float>(clip.y + clip.height)},
                        true);
  }
  ~Clipped() { list_->PopClipRect(); }
  Clipped(const Clipped&) = delete;
  Clipped& operator=(const Clipped&) = delete;
  ImDrawList* operator->() const { return list_; }

 private:
  ImDrawList* list_;
};

void outlined(const Clipped& list, ImVec2 low, ImVec2 high, ImU32 fill, ImU32 colour) {
  list->AddRectFilled(low, high, fill);
  list->AddRect({low.x - 1, low.y - 1}, {high.x + 1, high.y + 1}, IM_COL32(0, 0, 0, 255));
  list->AddRect(low, high, colour);
}

void shape(const Clipped& list, const gpu::Primitive& p, const VramMapping& mapping, ImU32 fill) {
  std::array<ImVec2, 4> corners;
  for (std::size_t i = 0; i < p.vertex_count && i < 4; ++i) {
    const auto& v = p.vertices[i];
    corners[i] =
        screen_at(mapping, v.x + 0.5 * (p.kind == gpu::Kind::line), v.y + 0.5 * (p.kind == gpu::Kind::line));
  }
  switch (p.kind) {
    case gpu::Kind::polygon: {
      list->AddTriangleFilled(corners[0], corners[1], corners[2], fill);
      if (p.is_quad()) list->AddTriangleFilled(corners[1], corners[2], corners[3], fill);
      const std::vector<int> round = p.is_quad() ? std::vector{0, 1, 3, 2} : std::vector{0, 1, 2};
      for (const float width : {3.0F, 1.0F}) {
        for (std::size_t i = 0; i < round.size(); ++i) {
          const auto from = static_cast<std::size_t>(round[i]);
          const auto to = static_cast<std::size_t>(round[(i + 1) % round.size()]);
          list->AddLine(corners[from], corners[to], width > 2 ? IM_COL32(0, 0, 0, 200) : outline_colour,
                        width);
        }
      }
      break;
    }
    case gpu::Kind::line:
      list->AddLine(corners[0], corners[1], IM_COL32(0, 0, 0, 200), 4);
      list->AddLine(corners[0], corners[1], outline_colour, 2);
      break;
    case gpu::Kind::rectangle:
    case gpu::Kind::fill:
    case gpu::Kind::copy:
    case gpu::Kind::upload: {
      const auto& v = p.vertices[0];
      outlined(list, corners[0], screen_at(mapping, v.x + p.width, v.y + p.height), fill, outline_colour);
      break;
    }
  }
}

}  // namespace

double Pulse::of(std::optional<std::size_t> selected, double now) {
  constexpr double seconds = 1.5;
  if (selected != selected_) {
    selected_ = selected;
    begin_ = now;
  }
  const double since = now - begin_;
  if (since > seconds || !selected_) return 0;
  return 0.5 - 0.5 * std::cos(since * 4 * 2 * 3.14159265 / seconds);
}

void draw_selection(const debug::FrameView& view, const debug::Row& row, const VramMapping& mapping,
                    Rect clip, double pulse) {
  const Clipped list(clip);
  const ImU32 fill = IM_COL32(0xf2, 0xa3, 0x3a, static_cast<int>(60 + 140 * pulse));
  for (auto draw = row.first_draw; draw < row.first_draw + row.draws; ++draw) {
    shape(list, view.trace().draws[draw], mapping, fill);
  }
}

void draw_pin(std::uint32_t pixel, const VramMapping& mapping, Rect clip) {
  const Clipped list(clip);
  const double x = pixel % gpu::Vram::width, y = pixel / gpu::Vram::width;
  outlined(list, screen_at(mapping, x, y), screen_at(mapping, x + 1, y + 1), IM_COL32(0, 0, 0, 0),
           pin_colour);
}

void draw_sources(const debug::FrameView& view, const debug::Row& row, const VramMapping& mapping,
                  Rect clip) {
  const auto* p = view.primitive(row);
  if (p == nullptr || !p->is_textured()) return;
  const Clipped list(clip);
  const auto format = p->state.texel_format();
  const int columns = format == gpu::TexelFormat::clut4 ? 64 : format == gpu::TexelFormat::clut8 ? 128 : 256;
  const int x = p->state.page_x(), y = p->state.page_y();
  outlined(list, screen_at(mapping, x, y), screen_at(mapping, x + columns, y + 256),
           IM_COL32(0x7a, 0xcc, 0x7f, 30), source_colour);
  if (format == gpu::TexelFormat::direct15) return;
  const int entries = format == gpu::TexelFormat::clut4 ? 16 : 256;
  const int clut_x = static_cast<int>(ot::gp0::clut::X16::get(p->clut)) * 16;
  const int clut_y = static_cast<int>(ot::gp0::clut::Y::get(p->clut));
  outlined(list, screen_at(mapping, clut_x, clut_y), screen_at(mapping, clut_x + entries, clut_y + 1),
           IM_COL32(0x7a, 0xcc, 0x7f, 60), source_colour);
}

}  // namespace app
