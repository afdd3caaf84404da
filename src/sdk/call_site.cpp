#include "sdk/call_site.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

extern char** environ;  // NOLINT(readability-redundant-declaration)

namespace sdk {
namespace {

std::string number(CallSite site) {
  return hex(static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(site)));
}

/// What addr2line prints for the arguments; empty if it cannot be run.
std::string ask(const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return {};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0);
  std::vector<char*> words;
  for (const auto& a : arguments) words.push_back(const_cast<char*>(a.c_str()));
  words.push_back(nullptr);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n = 0; failed == 0 && (n = read(ends[0], part.data(), part.size())) > 0;) {
    text.append(part.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  if (failed == 0) waitpid(child, nullptr, 0);
  return text;
}

}  // namespace

std::string hex(std::uint32_t address) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%06Xh", address);
  return text.data();
}

namespace {

/// "FILE:LINE" for each, as addr2line prints it; "??:0" or nothing where it does not know.
std::vector<std::string> lines_of(std::span<const CallSite> sites) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  std::vector<std::string> arguments{"addr2line", "-e", program.string()};
  for (const auto site : sites) {
    // The byte before the return address belongs to the call.
    const auto at = reinterpret_cast<std::uintptr_t>(site);
    std::ostringstream text;
    text << std::hex << (at == 0 ? 0 : at - 1);
    arguments.push_back(text.str());
  }
  std::istringstream answer(ask(arguments));
  std::vector<std::string> lines(sites.size());
  for (auto& line : lines) {
    std::getline(answer, line);
    line = line.substr(0, line.find(' '));  // " (discriminator 2)"
  }
  return lines;
}

bool is_known(const std::string& line) {
  return !line.empty() && line[0] != '?' && line.back() != '?' && !line.ends_with(":0");
}

std::string short_name(const std::string& line, CallSite site) {
  if (is_known(line)) return std::filesystem::path(line).filename().string();
  return site == nullptr ? "unknown place" : number(site);
}

/// Whether the line is of a file beside this one: of the runtime.
bool is_runtime(const std::string& line) {
  static const auto folder = std::filesystem::path(__FILE__).parent_path();
  return std::filesystem::path(line).parent_path() == folder;
}

}  // namespace

std::vector<std::string> describe(std::span<const CallSite> sites) {
  if (sites.empty()) return {};
  const auto lines = lines_of(sites);
  std::vector<std::string> out;
  for (std::size_t i = 0; i < sites.size(); ++i) out.push_back(short_name(lines[i], sites[i]));
  return out;
}

std::string describe_first_in_program(std::span<const CallSite> frames) {
  if (frames.empty()) return "unknown place";
  const auto lines = lines_of(frames);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (is_known(lines[i]) && !is_runtime(lines[i])) return short_name(lines[i], frames[i]);
  }
  return number(frames[0]);
}

}  // namespace sdk
