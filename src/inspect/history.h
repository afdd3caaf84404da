#pragma once
// The history of one pixel in words.

#include <string>
#include <vector>

#include "inspect/report.h"

namespace inspect {

/// One line per event that touched the pixel at x, y of the report's picture, then what it shows, what it
/// should show, and why. Empty if x, y is outside the picture.
std::vector<std::string> pixel_history(const Report& report, const gpu::Trace& trace, int x, int y);

}  // namespace inspect
