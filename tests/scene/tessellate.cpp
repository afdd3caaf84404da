#include "scene/tessellate.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

using scene::Face;
using scene::Mesh;

namespace {

const std::vector<scene::Material> one_texture{{.texture = 0}, {}};

std::vector<scene::StoredTexture> stored(int size, bool windowed) {
  scene::StoredTexture t;
  t.u = t.v = {.texels = size, .origin = 0, .windowed = windowed, .repeats = true};
  return {t};
}

std::uint32_t point(Mesh& mesh, float x, float y, float z) {
  mesh.positions.emplace_back(x, y, z);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void add(Mesh& mesh, std::array<std::uint32_t, 4> vertices, float u, float v, std::uint32_t material = 0) {
  Face face;
  face.vertex = vertices;
  face.uv = {glm::vec2(0, 0), {u, 0}, {u, v}, {0, v}};
  face.material = material;
  mesh.faces.push_back(face);
}

// A sheet of quads and triangles over 3 x 2 cells, bent, every cell with its own texture repeats.
Mesh sheet(unsigned seed, bool shared) {
  std::mt19937 random(seed);
  Mesh mesh;
  std::array<glm::vec3, 12> grid;
  for (std::size_t i = 0; i < grid.size(); ++i)
    grid[i] = {static_cast<float>(i % 4) + 0.1F, static_cast<float>(i / 4) * 1.3F,
               static_cast<float>(random() % 1000) / 2000.0F};
  for (const auto& p : grid) point(mesh, p.x, p.y, p.z);
  const auto at = [&](std::uint32_t c, std::uint32_t r) {
    const std::uint32_t i = r * 4 + c;
    return shared ? i : point(mesh, grid[i].x, grid[i].y, grid[i].z);
  };
  for (std::uint32_t r = 0; r < 2; ++r) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const auto repeats = [&] { return static_cast<float>(random() % 500) / 60.0F; };
      const float u = repeats();
      if (random() % 2 == 0) {
        add(mesh, {at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)}, u, repeats(),
            random() % 4 == 0 ? 1 : 0);
      } else {
        add(mesh, {at(c, r), at(c + 1, r), at(c + 1, r + 1), scene::none}, u, repeats());
        add(mesh, {at(c, r), at(c + 1, r + 1), at(c, r + 1), scene::none}, u, repeats());
      }
    }
  }
  return mesh;
}

using Edge = std::array<float, 6>;

// Edges by position that have a face on one side only.
std::set<Edge> open_edges(const Mesh& mesh) {
  std::map<Edge, int> count;
  for (const auto& face : mesh.faces) {
    const std::size_t n = face.corners();
    for (std::size_t k = 0; k < n; ++k) {
      const glm::vec3 a = mesh.positions[face.vertex[k]];
      const glm::vec3 b = mesh.positions[face.vertex[(k + 1) % n]];
      const bool forward = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
      const Edge edge = forward ? Edge{a.x, a.y, a.z, b.x, b.y, b.z} : Edge{b.x, b.y, b.z, a.x, a.y, a.z};
      count[edge] += forward ? 1 : -1;
    }
  }
  std::set<Edge> open;
  for (const auto& [edge, sum] : count)
    if (sum != 0) open.insert(edge);
  return open;
}

double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 2; k < (face.is_quad() ? 4U : 3U); ++k) {
      const glm::dvec3 o(mesh.positions[face.vertex[0]]);
      const glm::dvec3 a = glm::dvec3(mesh.positions[face.vertex[k - 1]]) - o;
      const glm::dvec3 n = glm::cross(a, glm::dvec3(mesh.positions[face.vertex[k]]) - o);
      sum += std::sqrt(glm::dot(n, n)) / 2;
    }
  }
  return sum;
}

}  // namespace

TEST_SUITE("scene") {
  TEST_CASE("a point on an edge is the same from both ends") {
    std::mt19937 random(4);
    const auto number = [&] {
      return static_cast<float>(static_cast<int>(random() % 200001) - 100000) / 777.0F;
    };
    for (int i = 0; i < 10000; ++i) {
      const glm::vec3 a(number(), number(), number());
      const glm::vec3 b(number(), number(), number());
      const int n = 2 + i % 15;
      const int k = 1 + i % (n - 1);
      REQUIRE(scene::edge_point(a, b, static_cast<double>(k) / n) ==
              scene::edge_point(b, a, static_cast<double>(n - k) / n));
    }
  }

  TEST_CASE("a mesh without textures is never cut, nor is one whose repeats fit") {
    std::vector<std::string> report;
    Mesh mesh;
    for (int i = 0; i < 4; ++i) point(mesh, static_cast<float>(i % 2), static_cast<float>(i / 2), 0);
    add(mesh, {0, 1, 3, 2}, 3, 3, 1);
    CHECK_FALSE(scene::tessellate(mesh, one_texture, stored(64, true), 8, report));
    mesh.faces[0].material = 0;
    CHECK_FALSE(scene::tessellate(mesh, one_texture, stored(64, true), 1, report));  // 3 * 64 = 192
    CHECK(report.empty());
  }

  TEST_CASE("subdividing by n makes n x n parts of each face and remembers where they come from") {
    std::vector<std::string> report;
    Mesh mesh;
    for (int i = 0; i < 4; ++i) point(mesh, static_cast<float>(i % 2), static_cast<float>(i / 2), 0);
    add(mesh, {0, 1, 3, 2}, 1, 1);
    add(mesh, {0, 1, 3, scene::none}, 1, 1);
    for (const int n : {2, 3, 7, 16}) {
      CAPTURE(n);
      const auto cut = scene::tessellate(mesh, one_texture, stored(64, true), n, report);
      REQUIRE(cut);
      CHECK(cut->mesh.faces.size() == static_cast<std::size_t>(2 * n * n));
      CHECK(std::count(cut->sources.begin(), cut->sources.end(), 1U) == n * n);
      CHECK(area(cut->mesh) == doctest::Approx(1.5));
    }
  }

  TEST_CASE("subdivided neighbours share all vertices of their common edges") {
    for (unsigned seed = 0; seed < 20; ++seed) {
      for (const bool shared : {true, false}) {
        for (const int n : {2, 3, 5, 12}) {
          CAPTURE(seed);
          CAPTURE(n);
          const Mesh mesh = sheet(seed, shared);
          std::vector<std::string> report;
          const auto cut = scene::tessellate(mesh, one_texture, stored(256, false), n, report);
          REQUIRE(cut);
          // The rim of the sheet: 10 cell sides. They may be cut further where a texture repeats; nothing
          // else is open.
          const auto open = open_edges(cut->mesh);
          CHECK(open.size() >= static_cast<std::size_t>(10 * n));
          bool only_rim = true;
          for (const auto& e : open) {
            const auto on = [&](float value, std::size_t axis) {
              return e[axis] == value && e[axis + 3] == value;
            };
            only_rim = only_rim && (on(0.1F, 0) || on(3.1F, 0) || on(0, 1) || on(2 * 1.3F, 1));
          }
          CHECK(only_rim);
        }
      }
    }
  }

  TEST_CASE("neighbours whose textures repeat differently are cut alike on their common edge") {
    for (unsigned seed = 0; seed < 60; ++seed) {
      CAPTURE(seed);
      const Mesh mesh = sheet(seed, seed % 2 == 0);
      std::vector<std::string> report;
      const auto cut =
          scene::tessellate(mesh, one_texture, stored(seed % 3 == 0 ? 100 : 64, seed % 3 != 0), 1, report);
      REQUIRE(cut);
      bool only_rim = true;
      for (const auto& e : open_edges(cut->mesh)) {
        const auto on = [&](float value, std::size_t axis) {
          return e[axis] == value && e[axis + 3] == value;
        };
        only_rim = only_rim && (on(0.1F, 0) || on(3.1F, 0) || on(0, 1) || on(2 * 1.3F, 1));
      }
      CHECK(only_rim);
    }
  }

  TEST_CASE("after cutting every face can say its texture coordinates in 8 bits") {
    for (const bool windowed : {true, false}) {
      const auto textures = stored(64, windowed);
      for (unsigned seed = 0; seed < 30; ++seed) {
        std::vector<std::string> report;
        const auto cut = scene::tessellate(sheet(seed, true), one_texture, textures, 1, report);
        REQUIRE(cut);
        bool fits = true;
        for (const auto& face : cut->mesh.faces) {
          if (face.material != 0) continue;
          for (int axis = 0; axis < 2; ++axis) {
            float low = face.uv[0][axis];
            float high = low;
            for (std::size_t k = 1; k < (face.is_quad() ? 4U : 3U); ++k) {
              low = std::min(low, face.uv[k][axis]);
              high = std::max(high, face.uv[k][axis]);
            }
            fits =
                fits && high - std::floor(low + 1e-4F) <= static_cast<float>(textures[0].u.periods()) + 1e-3F;
          }
        }
        CHECK(fits);
      }
    }
  }

  TEST_CASE("a face that repeats its texture thousands of times is left whole, and a line says so") {
    std::vector<std::string> report;
    Mesh mesh;
    for (int i = 0; i < 4; ++i) point(mesh, static_cast<float>(i % 2), static_cast<float>(i / 2), 0);
    add(mesh, {0, 1, 3, 2}, 1e30F, 2);
    CHECK_FALSE(scene::tessellate(mesh, one_texture, stored(64, true), 1, report));
    CHECK(report.size() == 1);
    mesh.faces[0].uv[1].x = std::nanf("");
    CHECK_FALSE(scene::tessellate(mesh, one_texture, stored(64, true), 1, report));
  }
}
