#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "stability/measure.h"

namespace stability {

std::vector<Line>& lines() {
  static std::vector<Line> all;
  return all;
}

namespace {

std::string number(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

// The part of the page that the tests own; what stands below the marker is written by hand.
constexpr const char* marker = "<!-- end of the generated part -->\n";

std::string page() {
  auto all = lines();
  std::stable_sort(all.begin(), all.end(), [](const Line& a, const Line& b) {
    return std::stoi(a.section) < std::stoi(b.section);  // "6. Depth"
  });
  std::ostringstream text;
  text << "# What stays stable, and how far it was tried\n\n"
          "Every line is a test. `build/release/bin/tests_stability -tc=\"NAME\"` repeats one,\n"
          "`build/release/bin/tests_stability --write docs/stability.md` writes this table, and the test "
          "suite fails when\n"
          "the table and the tests disagree. Inputs come from fixed seeds.\n";
  std::string section;
  for (const auto& line : all) {
    if (line.section != section) {
      section = line.section;
      text << "\n## " << section
           << "\n\n| case | what could go wrong | promised | worst seen | inputs | test |\n"
           << "| --- | --- | --- | --- | --- | --- |\n";
    }
    text << "| " << line.name << " | " << line.risk << " | " << line.bound << " | " << number(line.worst)
         << " " << line.unit << " | " << line.inputs << " | `" << line.test << "` |\n";
  }
  text << "\n" << marker;
  return text.str();
}

std::string read(const char* path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

int write_page(const char* path) {
  const auto old = read(path);
  const auto tail = old.find(marker);
  const auto text = page() + (tail == std::string::npos ? "" : old.substr(tail + std::string(marker).size()));
  std::ofstream file(path, std::ios::binary);
  file << text;
  return file.good() ? 0 : 1;
}

int check_page(const char* path) {
  if (read(path).starts_with(page())) return 0;
  std::cout << path << ": differs from what the tests measure; run with --write " << path << "\n";
  return 1;
}

}  // namespace
}  // namespace stability

int main(int count, char** arguments) {
  doctest::Context context(count, arguments);
  const int failed = context.run();
  if (failed != 0 || context.shouldExit()) return failed;
  for (int i = 1; i + 1 < count; ++i) {
    if (std::string_view(arguments[i]) == "--write") return stability::write_page(arguments[i + 1]);
    if (std::string_view(arguments[i]) == "--check") return stability::check_page(arguments[i + 1]);
  }
  return 0;
}
