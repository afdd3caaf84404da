#pragma once
// The window of a program: the debugger of recordings over a run that goes on.

#include <string>

#include "base/result.h"
#include "sdk/settings.h"

namespace sdk {

/// Opens the window and returns when it is closed. Writes the pad log that `settings` ask for. Error (exit
/// 2): no display; a panel that does not exist.
base::Result<int> show_in_window(const Settings& settings, const std::string& name);

}  // namespace sdk
