#pragma once
// The program as its users meet it: run as a process in a folder of its own, judged by exit status, stdout,
// stderr and files.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace tests {

struct Outcome {
  int status;
  std::string out, err;
};

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A fresh folder in which the program runs.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("otter_tests_program_" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// `arguments` as a shell would split them; `environment` before them, as "A=1 -u B".
  [[nodiscard]] Outcome otter(const std::string& arguments, const std::string& environment = "") const {
    const auto line = "cd '" + path.string() + "' && env " + environment + " '" OTTER_PROGRAM "' " +
                      arguments + " > .out 2> .err < /dev/null";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(path / ".out"), contents(path / ".err")};
  }
  void put(const std::string& name, std::string_view bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
  }
  [[nodiscard]] bool has(const std::string& name) const { return std::filesystem::exists(path / name); }
};

inline bool is_one_line(const std::string& text) {
  return !text.empty() && std::count(text.begin(), text.end(), '\n') == 1 && text.back() == '\n';
}

inline bool mentions(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

}  // namespace tests
