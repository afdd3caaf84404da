#pragma once
// Options that several subcommands share.

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>

#include "scene/knobs.h"

namespace app {

/// Adds every knob of scene::knob_table() as an option in the group "Knobs"; given twice, the last one
/// counts. `knobs` must live until the command line is read. A wrong value ends parsing with the knob's own
/// message. `names`: only these knobs; empty: all.
void add_knobs(CLI::App& sub, scene::Knobs& knobs, std::initializer_list<std::string_view> names = {});

/// The error of reading a command line in one line, naming the option and what was expected.
std::string one_line(const CLI::ParseError& error);

}  // namespace app
