#include <doctest/doctest.h>

#include <cstdint>

#include "gpu/edge.h"

TEST_SUITE("gpu") {
  TEST_CASE("An edge stepped without division lies on the exact rule's column, for every slope and row") {
    std::int64_t wrong = 0;
    for (int dy = 1; dy < 512; ++dy) {
      for (int dx = -1023; dx < 1024; ++dx) {
        gpu::Edge edge({0, 0}, {dx, dy});
        // The exact column is the ceiling of dx * row / dy: kept as quotient and
        // remainder, no division per row.
        int column = 0, remainder = 0;  // dx * row == column * dy - remainder, 0 <= remainder < dy
        for (int row = 0; row < dy; ++row) {
          wrong += edge.column() != column ? 1 : 0;
          edge.x += edge.step;
          remainder -= dx % dy;
          column += dx / dy;
          if (remainder < 0) {
            remainder += dy;
            ++column;
          } else if (remainder >= dy) {
            remainder -= dy;
            --column;
          }
        }
      }
    }
    CHECK(wrong == 0);
  }

  TEST_CASE("The exact rule is a true ceiling, to the left of zero too") {
    CHECK(gpu::edge_at({0, 0}, {3, 2}, 1) == 2);
    CHECK(gpu::edge_at({0, 0}, {-3, 2}, 1) == -1);
    CHECK(gpu::edge_at({-5, 0}, {-1, 4}, 3) == -2);
    CHECK(gpu::edge_at({-5, -1}, {-9, 7}, 7) == -9);
  }
}
