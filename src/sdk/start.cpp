// main() of a program built by otter_add_program: the linker gives the program's own the name __real_main.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "sdk/host.h"
#include "sdk/settings.h"

extern "C" int __real_main(int argc, char** argv);  // NOLINT(bugprone-reserved-identifier)

extern "C" int __wrap_main(int argc, char** argv) {  // NOLINT(bugprone-reserved-identifier)
  const auto name = std::filesystem::path(argv[0]).filename().string();
  int status = static_cast<int>(base::Exit::failed);
  try {
    const auto settings = sdk::parse_settings(argc, argv);
    if (settings) {
      status = sdk::run(*settings, __real_main, name.c_str());
    } else {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), settings.error().text.c_str());
      status = static_cast<int>(settings.error().exit);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
  }
  // The program's thread stands still inside its frames: nothing of it may be destroyed.
  std::fflush(nullptr);
  std::_Exit(status);
}
