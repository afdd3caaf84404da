// otter play: a program of the console's SDK, built to run here.

#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "base/read_file.h"

namespace app {
namespace {

struct PlayOptions {
  std::string program;
  std::vector<std::string> rest;
};

// What src/sdk/start.cpp puts into every program.
constexpr std::string_view mark = "otter program of the console's SDK";

constexpr std::uint64_t most = std::uint64_t{1} << 30;  // bytes of an executable

base::Result<void> check_program(const std::string& path) {
  const auto bytes = base::read_file(path, most);
  if (!bytes) return tl::make_unexpected(bytes.error());
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  if (text.find(mark) != std::string_view::npos) return {};
  return base::fail(path + ": expected a program built by otter_add_program or with otter-sdk.cmake");
}

// The program has the window and every option itself: this process becomes it.
base::Result<int> play(const PlayOptions& options) {
  if (auto checked = check_program(options.program); !checked) return tl::make_unexpected(checked.error());
  const auto path = std::filesystem::absolute(options.program).string();
  std::vector<std::string> words{path};
  words.insert(words.end(), options.rest.begin(), options.rest.end());
  std::vector<char*> arguments;
  for (auto& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(path.c_str(), arguments.data());
  return base::fail(path + ": cannot be run: " + std::strerror(errno));
}

}  // namespace

Action add_play(Arguments arguments) {
  const auto options = std::make_shared<PlayOptions>();
  arguments.positional("program", "PROGRAM", options->program,
                       "a program built by otter_add_program; PROGRAM --help lists all that may follow",
                       Presence::required);
  arguments.rest(options->rest);
  return [options] { return play(*options); };
}

}  // namespace app
