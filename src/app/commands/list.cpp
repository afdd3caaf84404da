// otter list: the built-in scenes.

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "demos/demos.h"

namespace app {
namespace {

struct ListOptions {
  bool names = false, is_long = false;
};

std::string padded(std::string_view text, std::size_t width) {
  std::string out(text);
  out.resize(std::max(width, out.size()), ' ');
  return out;
}

base::Result<int> list(const ListOptions& options) {
  std::size_t width = 0;
  for (const auto& demo : demos::all()) width = std::max(width, demo.name.size());
  for (const auto& demo : demos::all()) {
    std::string line(demo.name);
    if (!options.names) line = padded(demo.name, width + 2).append(demo.title);
    if (options.is_long) line.append("\n").append(width + 2, ' ').append(demo.shows).append("\n");
    std::puts(line.c_str());
  }
  return 0;
}

}  // namespace

Action add_list(Arguments arguments) {
  const auto options = std::make_shared<ListOptions>();
  arguments.flag("--names", options->names, "names alone, one a line");
  arguments.flag("--long", options->is_long, "what to look for in each, too");
  arguments.exclude("--long", "--names");
  return [options] { return list(*options); };
}

}  // namespace app
