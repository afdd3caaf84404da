// The program: one command line, a table of subcommands.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/progress.h"
#include "app/target.h"
#include "base/message.h"
#include "commit.h"

namespace {

using app::Action;

constexpr int bad_usage = static_cast<int>(base::Exit::bad_input);
constexpr int failed = static_cast<int>(base::Exit::failed);

int complain(const std::string& where, const std::string& text, int status) {
  base::complain(where, text);
  return status;
}

// A full disk shows when the last of standard output is written.
int end_output(const std::string& where, int status) {
  std::cout.flush();
  const bool is_written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good();
  return is_written ? status : complain(where, "standard output: cannot be written", failed);
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
    return end_output("otter", program.exit(help_or_version));
  } catch (const CLI::ParseError& error) {
    const std::string name = &chosen(program) == &program ? "otter" : "otter " + chosen(program).get_name();
    return complain(name, app::one_line(error) + " (see " + name + " --help)", bad_usage);
  }
  for (const auto& entry : actions) {
    const CLI::App* sub = entry.first;
    if (!sub->parsed()) continue;
    const std::string name = "otter " + sub->get_name();
    const bool has_window = sub->get_name() == "run";
    // The display server's end is told by Xlib; whoever reads standard output no more ends this program at
    // once and silently, as it ends any other in a pipeline.
    if (has_window) std::signal(SIGPIPE, SIG_IGN);
    const auto status = app::guard_outputs(*sub).and_then([&] {
      const auto busy = has_window ? nullptr : std::make_unique<app::Busy>(name);
      return entry.second();
    });
    if (!status) return complain(name, status.error().text, static_cast<int>(status.error().exit));
    return end_output(name, *status);
  }
  return bad_usage;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond the allowed size is an error to report
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    return complain("otter", "not enough memory for this input", failed);
  } catch (const std::exception& error) {
    return complain("otter", error.what(), failed);
  }
}
