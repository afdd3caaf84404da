#include "demos/parts.h"

namespace demos {

using glm::vec2;
using glm::vec3;
using scene::Face;

namespace {

std::uint32_t add_point(scene::Mesh& mesh, vec3 p) {
  mesh.positions.push_back(p);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

Face quad_of(const std::array<std::uint32_t, 4>& vertices, Look look, vec2 low, vec2 high) {
  Face face;
  face.vertex = vertices;
  face.uv = {vec2(low.x, high.y), vec2(high.x, high.y), vec2(high.x, low.y), vec2(low.x, low.y)};
  face.colour.fill(look.colour);
  face.material = look.material;
  return face;
}

}  // namespace

void add_quad(scene::Mesh& mesh, const std::array<vec3, 4>& corners, Look look, vec2 repeat) {
  std::array<std::uint32_t, 4> vertices{};
  for (std::size_t i = 0; i < 4; ++i) vertices[i] = add_point(mesh, corners[i]);
  mesh.faces.push_back(quad_of(vertices, look, {0, 0}, repeat));
}

void add_box(scene::Mesh& mesh, vec3 centre, vec3 half, Look look) {
  std::array<std::uint32_t, 8> corner{};  // bit 0: +x, bit 1: +y, bit 2: +z
  for (std::uint32_t i = 0; i < 8; ++i) {
    const vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corner[i] = add_point(mesh, centre + sign * half);
  }
  // Lower left, lower right, upper right, upper left, as seen from outside.
  constexpr std::array<std::array<std::size_t, 4>, 6> sides{
      {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7}, {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}}};
  for (const auto& side : sides) {
    mesh.faces.push_back(
        quad_of({corner[side[0]], corner[side[1]], corner[side[2]], corner[side[3]]}, look, {0, 0}, {1, 1}));
  }
}

void add_grid(scene::Mesh& mesh, vec3 corner, vec3 across, vec3 along, int columns, int rows, Look look,
              vec2 repeat) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto part = [](int i, int n) { return static_cast<float>(i) / static_cast<float>(n); };
  for (int r = 0; r <= rows; ++r)
    for (int c = 0; c <= columns; ++c)
      add_point(mesh, corner + across * part(c, columns) + along * part(r, rows));
  const auto at = [&](int c, int r) { return first + static_cast<std::uint32_t>(r * (columns + 1) + c); };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const vec2 low = vec2(part(c, columns), 1 - part(r + 1, rows)) * repeat;
      const vec2 high = vec2(part(c + 1, columns), 1 - part(r, rows)) * repeat;
      mesh.faces.push_back(
          quad_of({at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)}, look, low, high));
    }
  }
}

std::uint32_t place(scene::World& world, std::uint32_t mesh, const glm::mat4& model) {
  world.instances.push_back({mesh, model});
  return static_cast<std::uint32_t>(world.instances.size() - 1);
}

}  // namespace demos
