// Register dumps captured on a console, where OTTER_VECTORS has them.

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <sstream>

#include "gte/check.h"
#include "tests/vectors.h"

TEST_SUITE("gte") {
  TEST_CASE("every captured register dump is reproduced to the bit") {
    const auto path = tests::vector_path("gte/hardware.csv");
    if (!path) return;
    std::ifstream file(*path, std::ios::binary);
    const std::string csv{std::istreambuf_iterator<char>(file), {}};
    std::ostringstream out;
    const gte::CheckOutcome outcome = gte::check_csv(csv, out);
    INFO(out.str());
    CHECK(!outcome.malformed);
    CHECK(outcome.passed == 575);
    CHECK(outcome.failed == 0);
  }
}
