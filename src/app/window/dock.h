#pragma once
// Where the panels are: in a column on either side of the picture, never over it. Pure.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/window/layout.h"
#include "base/result.h"

namespace app {

enum class Panel : std::uint8_t { knobs, inspect, cost, table, vram };
inline constexpr std::size_t panel_count = 5;
/// What `--panel` and the settings file call them.
inline constexpr std::array<std::string_view, panel_count> panel_names{"knobs", "inspect", "cost", "table",
                                                                       "vram"};
/// Above the panel.
inline constexpr std::array<std::string_view, panel_count> panel_titles{"Knobs", "Inspect", "Cost",
                                                                        "Ordering table", "VRAM"};
std::optional<Panel> panel_named(std::string_view name);

enum class Side : std::uint8_t { left, right };
inline constexpr std::size_t side_count = 2;

/// What the user has arranged.
struct Dock {
  std::array<Side, panel_count> side{Side::right, Side::left, Side::left, Side::right, Side::left};
  /// Of the columns, in pixels where letters are as designed.
  std::array<double, side_count> width{340, 380};
  std::vector<Panel> open;  ///< the one opened last is the last
  bool operator==(const Dock&) const = default;

  [[nodiscard]] bool is_open(Panel panel) const;
  /// An open one becomes the last.
  void raise(Panel panel);
  void close(Panel panel);
  void toggle(Panel panel) { is_open(panel) ? close(panel) : raise(panel); }
  void move_over(Panel panel);  ///< to the other side
};

/// Opens panels by name, the last in front. Error: a name that is none, and what was expected.
base::Result<void> raise_panels(const std::vector<std::string>& names, Dock& dock);

struct Docked {
  Panel panel = Panel::knobs;
  Rect place;
  bool is_folded = false;  ///< there is room for its title alone: raise() unfolds it
};

struct DockLayout {
  Rect picture;  ///< what the columns leave
  std::vector<Docked> panels;
  std::array<std::optional<Rect>, side_count> edges;  ///< the strip to drag a column's width with
};

/// The panels of a column share its height in the order of the enumeration. Where they would be too low, the
/// ones opened first fold. Columns are as wide as asked for, but leave a third of the area to the picture;
/// everything stays within `area`. `scale`: of letters.
DockLayout lay_out(const Dock& dock, Rect area, double scale);

/// Sets a column's width from where its edge was dragged to.
void drag_edge(Dock& dock, Side side, int x, Rect area, double scale);

}  // namespace app
