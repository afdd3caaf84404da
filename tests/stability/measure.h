#pragma once
// One line of docs/stability.md: a hard case, what could go wrong, the bound
// promised and the worst value seen.
//
//   Measure worst{"Raster", "fan of 1,000 triangles", "a doubly blended seam", "every pixel once", "times",
//   1}; for (...) worst.see(times_drawn);
//
// When it goes out of scope the line is recorded and the bound is checked. Inputs come from
// fixed seeds, so the whole page is a function of the code: `tests_stability --write
// docs/stability.md` writes it, `--check` compares.

#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace stability {

struct Line {
  std::string section, name, risk, bound, unit;
  double limit = 0;
  double worst = 0;
  std::uint64_t inputs = 0;
  std::string test;  ///< the doctest case that reproduces it
};

std::vector<Line>& lines();

class Measure {
 public:
  Measure(std::string section, std::string name, std::string risk, std::string bound, std::string unit,
          double limit)
      : line_{std::move(section),
              std::move(name),
              std::move(risk),
              std::move(bound),
              std::move(unit),
              limit,
              0,
              0,
              {}} {}
  Measure(const Measure&) = delete;
  Measure& operator=(const Measure&) = delete;
  ~Measure() {
    CHECK_MESSAGE(line_.inputs > 0, line_.name, ": no input was tried");
    CHECK_MESSAGE(line_.worst <= line_.limit, line_.name, ": ", line_.bound);
    line_.test = doctest::getContextOptions()->currentTest->m_name;
    lines().push_back(line_);
  }

  /// One input gave this value (an error, a count of bad pixels); `inputs` when the
  /// value is over several inputs.
  void see(double value, std::uint64_t inputs = 1) {
    if (!(value <= line_.worst)) line_.worst = value;  // a NaN sticks, and fails the bound
    line_.inputs += inputs;
  }

 private:
  Line line_;
};

}  // namespace stability
