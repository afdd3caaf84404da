#include "scene/angle.h"

#include <array>
#include <glm/geometric.hpp>

namespace scene {
namespace {

constexpr int quarter = 1024;  // table steps in a quarter turn
constexpr int fraction_bits = 30;

// sin x by its series, x and the result with 30 fraction bits: integers only, so
// every compiler makes this table.
constexpr std::int64_t series_sine(std::int64_t x) {
  std::int64_t sum = 0;
  std::int64_t term = x;
  for (std::int64_t n = 1; term != 0; n += 2) {
    sum += term;
    term = -((((term * x) >> fraction_bits) * x) >> fraction_bits) / ((n + 1) * (n + 2));
  }
  return sum;
}

constexpr auto table = [] {
  std::array<std::int32_t, quarter + 1> values{};
  constexpr std::int64_t half_pi = 1686629713;  // pi/2 * 2^30
  for (int i = 0; i <= quarter; ++i)
    values[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(series_sine((half_pi * i + quarter / 2) / quarter));
  values[quarter] = 1 << fraction_bits;
  return values;
}();

double table_sine(int step) {  // any step; 4096 a turn
  const int in_turn = step & (4 * quarter - 1);
  const int in_half = in_turn & (2 * quarter - 1);
  const int index = in_half <= quarter ? in_half : 2 * quarter - in_half;
  const double value = table[static_cast<std::size_t>(index)];
  return in_turn < 2 * quarter ? value : -value;
}

}  // namespace

double sin_turns(double turns) {
  if (!std::isfinite(turns)) return 0;
  const double steps = (turns - std::floor(turns)) * (4 * quarter);
  const int step = static_cast<int>(steps);  // 0..4096
  const double fraction = steps - step;
  const double low = table_sine(step);
  return (low + (table_sine(step + 1) - low) * fraction) / (1 << fraction_bits);
}

double cos_turns(double turns) { return sin_turns(turns - std::floor(turns) + 0.25); }

double turns_of(double y, double x) {
  if (!std::isfinite(x) || !std::isfinite(y) || (x == 0 && y == 0)) return 0;
  // The largest angle of the first half turn that is not beyond the direction, by halving: the cross product
  // of the two directions changes its sign there.
  const bool lower = y < 0;
  const double px = lower ? -x : x;
  const double py = lower ? -y : y;
  double low = 0;
  double width = 0.5;
  for (int i = 0; i < 40; ++i) {
    width /= 2;
    const double middle = low + width;
    if (cos_turns(middle) * py - sin_turns(middle) * px >= 0) low = middle;
  }
  const double turns = low + (lower ? 0.5 : 0);
  return turns < 1 ? turns : 0;
}

glm::mat4 rotation_x(double turns) { return rotation({1, 0, 0}, turns); }
glm::mat4 rotation_y(double turns) { return rotation({0, 1, 0}, turns); }
glm::mat4 rotation_z(double turns) { return rotation({0, 0, 1}, turns); }

glm::mat4 rotation(glm::vec3 axis, double turns) {
  const double length =
      std::sqrt(static_cast<double>(axis.x) * axis.x + static_cast<double>(axis.y) * axis.y +
                static_cast<double>(axis.z) * axis.z);
  if (!(length > 0) || !std::isfinite(length)) return glm::mat4{1.0F};
  const double x = axis.x / length;
  const double y = axis.y / length;
  const double z = axis.z / length;
  const double s = sin_turns(turns);
  const double c = cos_turns(turns);
  const double k = 1 - c;
  const auto column = [](double a, double b, double d) {
    return glm::vec4(static_cast<float>(a), static_cast<float>(b), static_cast<float>(d), 0.0F);
  };
  return {column(c + x * x * k, y * x * k + z * s, z * x * k - y * s),
          column(x * y * k - z * s, c + y * y * k, z * y * k + x * s),
          column(x * z * k + y * s, y * z * k - x * s, c + z * z * k), glm::vec4(0, 0, 0, 1)};
}

glm::mat4 translation(glm::vec3 offset) {
  glm::mat4 m{1.0F};
  m[3] = glm::vec4(offset, 1.0F);
  return m;
}

glm::mat4 scaling(glm::vec3 factors) {
  glm::mat4 m{1.0F};
  m[0][0] = factors.x;
  m[1][1] = factors.y;
  m[2][2] = factors.z;
  return m;
}

glm::mat4 looking(glm::vec3 from, glm::vec3 to, glm::vec3 up) {
  const auto unit = [](glm::vec3 v) {
    const float length = std::sqrt(glm::dot(v, v));
    return length > 0 && std::isfinite(length) ? v / length : glm::vec3{0.0F};
  };
  const glm::vec3 back = unit(from - to);
  if (back == glm::vec3{0.0F}) return glm::mat4{1.0F};
  glm::vec3 right = unit(glm::cross(up, back));
  if (right == glm::vec3{0.0F}) {
    const glm::vec3 other = std::abs(back.x) < 0.9F ? glm::vec3{1, 0, 0} : glm::vec3{0, 0, 1};
    right = unit(glm::cross(other, back));
  }
  return {glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0),
          glm::vec4(0, 0, 0, 1)};
}

}  // namespace scene
