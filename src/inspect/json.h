#pragma once
// The report as JSON, schema otter.inspect/1.

#include <string>
#include <vector>

#include "inspect/report.h"

namespace inspect {

/// One object, ending in a newline. Pixel positions are relative to the picture; draws are numbers from 0
/// with the bucket beside them, null where there is none.
std::string to_json(const Report& report);

/// Several frames: the sums under the names of a single frame, then `frames`, one object each.
std::string to_json(const std::vector<Report>& reports);

}  // namespace inspect
