// The program: one command line, a table of subcommands.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/target.h"
#include "commit.h"

namespace {

using app::Action;

constexpr int bad_usage = static_cast<int>(base::Exit::bad_input);
constexpr int failed = static_cast<int>(base::Exit::failed);

int complain(const std::string& where, const std::string& text, int status) {
  std::fprintf(stderr, "%s: %s\n", where.c_str(), text.c_str());
  return status;
}

// The subcommand on the command line, if any: errors and help are about it.
const CLI::App& chosen(const CLI::App& program) {
  const auto subcommands = program.get_subcommands();
  return subcommands.empty() ? program : *subcommands.front();
}

std::string command_names() {
  std::string names;
  for (const auto& command : app::commands) names.append(names.empty() ? "" : ", ").append(command.name);
  return names;
}

bool is_command(std::string_view name) {
  const auto has_name = [name](const app::Command& command) { return command.name == name; };
  return std::any_of(app::commands.begin(), app::commands.end(), has_name);
}

std::string version() {
#ifdef __clang__
  const std::string compiler = "Clang " + std::to_string(__clang_major__) + "." +
                               std::to_string(__clang_minor__) + "." + std::to_string(__clang_patchlevel__);
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  return std::string("otter " OTTER_VERSION " (commit " OTTER_COMMIT ", ") + compiler + ", target " +
         std::string(app::target()) + ")";
}

int run(int argc, char** argv) {
  if (const auto target = app::choose_target(); !target) {
    return complain("otter", target.error().text, bad_usage);
  }
  CLI::App program("Otter draws 3D the way the first PlayStation did: an ordering table, and no depth.",
                   "otter");
  program.set_version_flag("--version", version());
  program.set_help_flag("-h,--help", "print this help");
  program.footer("otter COMMAND --help tells more, with examples.");
  program.get_formatter()->column_width(34);

  std::vector<std::pair<CLI::App*, Action>> actions;
  for (const auto& command : app::commands) {
    CLI::App* sub = program.add_subcommand(command.name, command.help);
    sub->footer(std::string("Examples:\n") + command.examples);
    actions.emplace_back(sub, command.add(app::Arguments(*sub)));
  }

  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty() || (first[0] != '-' && !is_command(first))) {
    const auto what = first.empty() ? std::string("no command") : first + ": no such command";
    return complain("otter", what + "; expected one of " + command_names() + " (see otter --help)",
                    bad_usage);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return program.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    const std::string name = &chosen(program) == &program ? "otter" : "otter " + chosen(program).get_name();
    return complain(name, app::one_line(error) + " (see " + name + " --help)", bad_usage);
  }
  for (const auto& [sub, action] : actions) {
    if (!sub->parsed()) continue;
    const auto status = action();
    if (!status)
      return complain("otter " + sub->get_name(), status.error().text, static_cast<int>(status.error().exit));
    // A full disk or a closed pipe shows when the last of stdout is written.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      return complain("otter " + sub->get_name(), "standard output: cannot be written", failed);
    }
    return *status;
  }
  return bad_usage;
}

}  // namespace

int main(int argc, char** argv) {
  // A pipe that was closed and a file beyond the allowed size are errors to report, not the end of the
  // program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return complain("otter", "not enough memory for this input", failed);
  } catch (const std::exception& error) {
    return complain("otter", error.what(), failed);
  }
}
