// docs/debugging.md, followed to the letter: every command of its first part is run, ends as the page says,
// and says what the page shows.

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <vector>

#include "program.h"

namespace {

using tests::contents, tests::Folder, tests::mentions;

struct Step {
  std::string command;
  int status = 0;
  std::vector<std::string> shown;  // lines that it says
};

std::string trimmed(std::string text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Blocks that are indented by four spaces: a command, and indented by eight what it says. "# exit 1" behind
/// a command: how it ends.
std::vector<Step> steps_of(const std::string& page) {
  std::vector<Step> steps;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## One number")) break;
    if (line.starts_with("        ")) {
      if (!steps.empty()) steps.back().shown.push_back(trimmed(line));
    } else if (line.starts_with("    ")) {
      const auto mark = line.find("# exit ");
      Step step{trimmed(line.substr(0, mark)), mark == std::string::npos ? 0 : line[mark + 7] - '0', {}};
      steps.push_back(std::move(step));
    }
  }
  return steps;
}

/// Numbers of times and blanks apart.
std::string plain(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (c != ' ') out += c;
  return out;
}

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("the walk from two polygons that flicker to the cause works as its page says") {
    const auto steps = steps_of(contents(OTTER_DOCS "/debugging.md"));
    REQUIRE(steps.size() >= 10);
    const Folder folder;
    for (const auto& step : steps) {
      CAPTURE(step.command);
      const auto line = "cd '" + folder.path.string() + "' && PATH='" OTTER_BIN "':$PATH && " + step.command +
                        " > .out 2> .err < /dev/null";
      const int status = std::system(line.c_str());
      const auto out = contents(folder.path / ".out"), err = contents(folder.path / ".err");
      CAPTURE(out);
      CAPTURE(err);
      REQUIRE(WIFEXITED(status));
      CHECK(WEXITSTATUS(status) == step.status);
      CHECK(err.empty());
      for (const auto& shown : step.shown) {
        CAPTURE(shown);
        CHECK(mentions(plain(out), plain(shown)));
      }
    }
    // The page's claim: the wall hides the picture in one frame and not in the other.
    CHECK(folder.has("even.png"));
    CHECK(contents(folder.path / "even.png") != contents(folder.path / "odd.png"));
  }
}
