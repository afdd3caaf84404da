#pragma once
// The plots of the HTML page.

#include <string>
#include <string_view>

#include "cost/sweep.h"

namespace cost {

/// Colours as gnuplot is told them; in the page each becomes the style variable of its name, so that plots
/// follow a dark or light page.
namespace theme {
inline constexpr std::string_view ink = "#1d2330", soft = "#5c6675", line = "#dfe3ea", up = "#2f6fb3",
                                  down = "#c2541b", front = "#1f8a4c";
}

/// Time against error of one axis, swept both ways; filled where nothing of the same sweep is both faster and
/// better. Empty if gnuplot cannot be run.
std::string axis_plot(const SceneResult& scene, const Axis& axis);
/// The combinations and their Pareto front, numbered from the fastest.
std::string front_plot(const SceneResult& scene);
/// Axes of many settings have numbers beside their dots instead of names: those of the table.
bool numbered(const Axis& axis);
/// Its number on its axis, from 1.
std::string setting_number(const Row& row);

}  // namespace cost
