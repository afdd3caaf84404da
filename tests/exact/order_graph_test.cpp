#include "exact/order_graph.h"

#include <doctest/doctest.h>

#include <random>

using exact::components_in_order;
using exact::Edge;
using Components = std::vector<std::vector<std::uint32_t>>;

TEST_SUITE("inspect") {
  TEST_CASE("components come in drawing order") {
    const std::vector<Edge> edges{{2, 0}, {0, 1}};
    CHECK(components_in_order(3, edges) == Components{{2}, {0}, {1}});
  }

  TEST_CASE("nodes without edges keep their order") {
    CHECK(components_in_order(3, {}) == Components{{0}, {1}, {2}});
  }

  TEST_CASE("a cycle is one component, and what it blocks comes after it") {
    const std::vector<Edge> edges{{1, 2}, {2, 3}, {3, 1}, {3, 0}, {1, 2}};
    CHECK(components_in_order(4, edges) == Components{{1, 2, 3}, {0}});
  }

  TEST_CASE("a hundred thousand nodes in a row need no stack") {
    std::vector<Edge> edges;
    for (std::uint32_t n = 0; n + 1 < 100000; ++n) edges.emplace_back(n + 1, n);
    const auto components = components_in_order(100000, edges);
    CHECK(components.size() == 100000);
    CHECK(components.front() == std::vector<std::uint32_t>{99999});
  }

  TEST_CASE("two nodes are in one component exactly when each reaches the other") {
    std::mt19937 engine(7);
    const auto random = [&](unsigned below) { return static_cast<std::uint32_t>(engine() % below); };
    for (int round = 0; round < 200; ++round) {
      const std::uint32_t count = 2 + random(7);
      std::vector<Edge> edges;
      std::vector<std::vector<bool>> reaches(count, std::vector<bool>(count));
      for (std::uint32_t e = random(12); e > 0; --e) {
        edges.emplace_back(random(count), random(count));
        reaches[edges.back().first][edges.back().second] = true;
      }
      for (std::uint32_t k = 0; k < count; ++k) {
        for (std::uint32_t i = 0; i < count; ++i) {
          for (std::uint32_t j = 0; j < count; ++j) {
            if (reaches[i][k] && reaches[k][j]) reaches[i][j] = true;
          }
        }
      }
      std::vector<std::size_t> place(count);
      const auto components = components_in_order(count, edges);
      for (std::size_t c = 0; c < components.size(); ++c) {
        for (const auto node : components[c]) place[node] = c;
      }
      for (std::uint32_t i = 0; i < count; ++i) {
        for (std::uint32_t j = 0; j < count; ++j) {
          if (i == j) continue;
          CHECK((place[i] == place[j]) == (reaches[i][j] && reaches[j][i]));
          if (reaches[i][j] && !reaches[j][i]) CHECK(place[i] < place[j]);
        }
      }
    }
  }
}
