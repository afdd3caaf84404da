#include "app/window/dock.h"

#include <algorithm>
#include <cmath>

namespace app {
namespace {

constexpr double title_height = 28, least_height = 170, least_width = 120;
constexpr int edge_width = 6;

std::size_t at(Side side) { return static_cast<std::size_t>(side); }
std::size_t at(Panel panel) { return static_cast<std::size_t>(panel); }

std::vector<Panel> column(const Dock& dock, Side side) {
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < panel_count; ++i) {
    const auto panel = static_cast<Panel>(i);
    if (dock.side[i] == side && dock.is_open(panel)) panels.push_back(panel);
  }
  return panels;
}

// Those of a column that are not folded: as many of the last opened as have room, one at least.
std::vector<Panel> unfolded(const Dock& dock, const std::vector<Panel>& panels, double height, double scale) {
  std::vector<Panel> shown;
  double left = height - static_cast<double>(panels.size()) * title_height * scale;
  for (auto panel = dock.open.rbegin(); panel != dock.open.rend(); ++panel) {
    if (std::find(panels.begin(), panels.end(), *panel) == panels.end()) continue;
    left -= (least_height - title_height) * scale;
    if (!shown.empty() && left < 0) break;
    shown.push_back(*panel);
  }
  return shown;
}

void stack(const Dock& dock, Side side, Rect place, double scale, std::vector<Docked>& out) {
  const auto panels = column(dock, side);
  const auto shown = unfolded(dock, panels, place.height, scale);
  const int folded = static_cast<int>(panels.size() - shown.size());
  const int title = std::min(static_cast<int>(title_height * scale),
                             place.height / std::max(static_cast<int>(panels.size()), 1));
  const int room = std::max(place.height - folded * title, 0);
  int y = place.y;
  int begun = 0;
  for (const auto panel : panels) {
    const bool is_shown = std::find(shown.begin(), shown.end(), panel) != shown.end();
    const int count = static_cast<int>(shown.size());
    const int height = is_shown ? room * (begun + 1) / count - room * begun / count : title;
    if (is_shown) ++begun;
    out.push_back({panel, {place.x, y, place.width, height}, !is_shown});
    y += height;
  }
}

}  // namespace

std::optional<Panel> panel_named(std::string_view name) {
  const auto found = std::find(panel_names.begin(), panel_names.end(), name);
  if (found == panel_names.end()) return std::nullopt;
  return static_cast<Panel>(found - panel_names.begin());
}

base::Result<void> raise_panels(const std::vector<std::string>& names, Dock& dock) {
  for (const auto& name : names) {
    if (const auto panel = panel_named(name)) {
      dock.raise(*panel);
      continue;
    }
    std::string all;
    for (const auto known : panel_names) all.append(all.empty() ? "" : ", ").append(known);
    return base::fail("--panel: expected some of " + all + ", got '" + name + "'");
  }
  return {};
}

bool Dock::is_open(Panel panel) const { return std::find(open.begin(), open.end(), panel) != open.end(); }

void Dock::raise(Panel panel) {
  close(panel);
  open.push_back(panel);
}

void Dock::close(Panel panel) { std::erase(open, panel); }

void Dock::move_over(Panel panel) {
  auto& where = side[at(panel)];
  where = where == Side::left ? Side::right : Side::left;
}

DockLayout lay_out(const Dock& dock, Rect area, double scale) {
  DockLayout layout;
  std::array<int, side_count> wide{};
  for (std::size_t i = 0; i < side_count; ++i) {
    if (!column(dock, static_cast<Side>(i)).empty()) wide[i] = static_cast<int>(dock.width[i] * scale);
  }
  const int asked = wide[0] + wide[1];
  const int room = std::max(area.width - area.width / 3, 0);
  if (asked > room) {
    for (auto& width : wide) width = static_cast<int>(std::int64_t{width} * room / asked);
  }
  layout.picture = {area.x + wide[0], area.y, std::max(area.width - wide[0] - wide[1], 1), area.height};
  const int right_edge = area.x + area.width;
  if (wide[0] > 0) {
    layout.edges[0] = Rect{area.x + wide[0] - edge_width / 2, area.y, edge_width, area.height};
    stack(dock, Side::left, {area.x, area.y, wide[0], area.height}, scale, layout.panels);
  }
  if (wide[1] > 0) {
    layout.edges[1] = Rect{right_edge - wide[1] - edge_width / 2, area.y, edge_width, area.height};
    stack(dock, Side::right, {right_edge - wide[1], area.y, wide[1], area.height}, scale, layout.panels);
  }
  return layout;
}

void drag_edge(Dock& dock, Side side, int x, Rect area, double scale) {
  const int width = side == Side::left ? x - area.x : area.x + area.width - x;
  const double most = std::max(area.width / scale, least_width);
  dock.width[at(side)] = std::clamp(std::round(width / scale), least_width, most);
}

}  // namespace app
