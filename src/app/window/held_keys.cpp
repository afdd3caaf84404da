#include "app/window/held_keys.h"

#include <algorithm>

namespace app {
namespace {

struct Row {
  std::string_view key;
  bool has_tap;  // the key table has the key too
  Motion motion;
};

constexpr std::array table{
    Row{"Left", false, {.orbit_x = -1}},  Row{"Right", false, {.orbit_x = 1}},
    Row{"Up", false, {.orbit_y = 1}},     Row{"Down", false, {.orbit_y = -1}},
    Row{"W", false, {.fly = {0, 0, -1}}}, Row{"S", false, {.fly = {0, 0, 1}}},
    Row{"A", false, {.fly = {-1, 0, 0}}}, Row{"D", true, {.fly = {1, 0, 0}}},
    Row{"R", false, {.fly = {0, 1, 0}}},  Row{"F", false, {.fly = {0, -1, 0}}},
};

}  // namespace

std::size_t HeldKeys::index(std::string_view key) {
  static_assert(table.size() == count);
  std::size_t i = 0;
  while (i < count && table[i].key != key) ++i;
  return i;
}

bool HeldKeys::press(std::string_view key, double now) {
  const auto i = index(key);
  if (i == count) return false;
  if (!since_[i]) since_[i] = now;  // not on the keyboard's own repeats
  return true;
}

bool HeldKeys::release(std::string_view key, double now) {
  const auto i = index(key);
  if (i == count || !since_[i]) return false;
  const bool tapped = table[i].has_tap && now - *since_[i] < tap_seconds;
  since_[i].reset();
  return tapped;
}

bool HeldKeys::any() const {
  return std::any_of(since_.begin(), since_.end(), [](const auto& since) { return since.has_value(); });
}

Motion HeldKeys::motion(double now) const {
  Motion sum;
  for (std::size_t i = 0; i < count; ++i) {
    const bool counts = since_[i] && (!table[i].has_tap || now - *since_[i] >= tap_seconds);
    if (!counts) continue;
    sum.orbit_x += table[i].motion.orbit_x;
    sum.orbit_y += table[i].motion.orbit_y;
    sum.fly += table[i].motion.fly;
  }
  return sum;
}

}  // namespace app
