#include "scene/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "scene/angle.h"

namespace scene {
namespace {

constexpr Rgb8 white{128, 128, 128};

std::uint32_t add(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal) {
  mesh.positions.push_back(position);
  mesh.normals.push_back(normal);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

void add_face(Mesh& mesh, std::array<std::uint32_t, 4> corners, std::array<glm::vec2, 4> uv) {
  mesh.faces.push_back({.vertex = corners, .uv = uv, .colour = {white, white, white, white}});
}

struct SinCos {
  double sin, cos;
};
SinCos at_turns(double turns) { return {sin_turns(turns), cos_turns(turns)}; }

// Round the axis as a texture runs: from the back (-z), counter-clockwise seen from above (back, left, front,
// right), so that the picture reads from left to right outside.
std::vector<SinCos> circle(int slices) {
  std::vector<SinCos> points;
  points.reserve(static_cast<std::size_t>(std::max(slices, 0)));
  for (int i = 0; i < slices; ++i) points.push_back(at_turns(static_cast<double>(i) / slices));
  return points;
}

glm::vec3 on_circle(const SinCos& at, double radius, double y) {
  return glm::vec3(-at.sin * radius, y, -at.cos * radius);
}

void add_disc(Mesh& mesh, float radius, float y, bool faces_up, int slices) {
  const std::vector<SinCos> round = circle(slices);
  const glm::vec3 normal{0, faces_up ? 1 : -1, 0};
  const std::uint32_t centre = add(mesh, {0, y, 0}, normal);
  for (int i = 0; i < slices; ++i)
    add(mesh, on_circle(round[static_cast<std::size_t>(i)], radius, y), normal);
  const auto uv = [&](const SinCos& at) {
    return glm::vec2(0.5 - at.sin / 2, faces_up ? 0.5 - at.cos / 2 : 0.5 + at.cos / 2);
  };
  for (int i = 0; i < slices; ++i) {
    int a = i, b = (i + 1) % slices;
    if (!faces_up) std::swap(a, b);
    add_face(mesh,
             {centre, centre + 1 + static_cast<std::uint32_t>(a), centre + 1 + static_cast<std::uint32_t>(b),
              none},
             {glm::vec2{0.5F, 0.5F}, uv(round[static_cast<std::size_t>(a)]),
              uv(round[static_cast<std::size_t>(b)])});
  }
}

}  // namespace

Mesh box(const glm::vec3& size) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.positions.push_back(size * 0.5F * glm::vec3(i & 1U ? 1 : -1, i & 2U ? 1 : -1, i & 4U ? 1 : -1));
  }
  // From the picture's bottom left, counter-clockwise: front, back, right, left, top, bottom.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}}};
  for (const auto& side : sides) add_face(mesh, side, {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}});
  return mesh;
}

Mesh sphere(float radius, int slices, int stacks) {
  Mesh mesh;
  const std::vector<SinCos> round = circle(slices);
  const std::uint32_t top = add(mesh, {0, radius, 0}, {0, 1, 0});
  const std::uint32_t bottom = add(mesh, {0, -radius, 0}, {0, -1, 0});
  for (int stack = 1; stack < stacks; ++stack) {
    const SinCos polar = at_turns(0.5 * stack / stacks);
    for (int i = 0; i < slices; ++i) {
      const glm::vec3 normal = on_circle(round[static_cast<std::size_t>(i)], polar.sin, polar.cos);
      add(mesh, normal * radius, normal);
    }
  }
  const auto ring = [&](int stack, int i) {
    if (stack == 0) return top;
    if (stack == stacks) return bottom;
    return 2U + static_cast<std::uint32_t>((stack - 1) * slices + i % slices);
  };
  const auto uv = [&](int stack, double i) {
    return glm::vec2(i / slices, static_cast<double>(stack) / stacks);
  };
  for (int stack = 0; stack < stacks; ++stack) {
    for (int i = 0; i < slices; ++i) {
      const std::uint32_t a = ring(stack + 1, i), b = ring(stack + 1, i + 1), c = ring(stack, i + 1),
                          d = ring(stack, i);
      if (stack == 0) {
        add_face(mesh, {a, b, top, none}, {uv(1, i), uv(1, i + 1), uv(0, i + 0.5)});
      } else if (stack == stacks - 1) {
        add_face(mesh, {bottom, c, d, none}, {uv(stacks, i + 0.5), uv(stack, i + 1), uv(stack, i)});
      } else {
        add_face(mesh, {a, b, c, d},
                 {uv(stack + 1, i), uv(stack + 1, i + 1), uv(stack, i + 1), uv(stack, i)});
      }
    }
  }
  return mesh;
}

Mesh cylinder(float radius, float height, Parts parts, int slices) {
  Mesh mesh;
  const float half = height / 2;
  if (parts.side) {
    const std::vector<SinCos> round = circle(slices);
    for (int i = 0; i < slices; ++i) {
      const glm::vec3 normal = on_circle(round[static_cast<std::size_t>(i)], 1, 0);
      add(mesh, normal * radius - glm::vec3(0, half, 0), normal);
      add(mesh, normal * radius + glm::vec3(0, half, 0), normal);
    }
    for (int i = 0; i < slices; ++i) {
      const auto a = static_cast<std::uint32_t>(2 * i),
                 b = static_cast<std::uint32_t>(2 * ((i + 1) % slices));
      const float left = static_cast<float>(i) / static_cast<float>(slices);
      const float right = static_cast<float>(i + 1) / static_cast<float>(slices);
      add_face(mesh, {a, b, b + 1, a + 1}, {{{left, 1}, {right, 1}, {right, 0}, {left, 0}}});
    }
  }
  if (parts.top) add_disc(mesh, radius, half, true, slices);
  if (parts.bottom) add_disc(mesh, radius, -half, false, slices);
  return mesh;
}

Mesh cone(float bottom_radius, float height, Parts parts, int slices) {
  Mesh mesh;
  const float half = height / 2;
  if (parts.side) {
    const std::vector<SinCos> round = circle(2 * slices);  // every second point lies in the middle of a face
    // A side's normal leans up by the slope; a point's own normal, so that the side
    // is round and its tip is not.
    const auto normal = [&](int point) {
      const glm::vec3 out = on_circle(round[static_cast<std::size_t>(point)], height, bottom_radius);
      const float length = glm::length(out);
      return length > 0 ? out / length : glm::vec3(0, 1, 0);
    };
    for (int i = 0; i < slices; ++i) {
      add(mesh, on_circle(round[static_cast<std::size_t>(2 * i)], bottom_radius, -half), normal(2 * i));
      add(mesh, {0, half, 0}, normal(2 * i + 1));
    }
    for (int i = 0; i < slices; ++i) {
      const auto a = static_cast<std::uint32_t>(2 * i),
                 b = static_cast<std::uint32_t>(2 * ((i + 1) % slices));
      const float left = static_cast<float>(i) / static_cast<float>(slices);
      const float right = static_cast<float>(i + 1) / static_cast<float>(slices);
      add_face(mesh, {a, b, a + 1, none}, {glm::vec2{left, 1}, {right, 1}, {(left + right) / 2, 0}});
    }
  }
  if (parts.bottom) add_disc(mesh, bottom_radius, -half, false, slices);
  return mesh;
}

void paint(Mesh& mesh, Rgb8 colour) {
  for (Face& face : mesh.faces) face.colour.fill(colour);
}

}  // namespace scene
