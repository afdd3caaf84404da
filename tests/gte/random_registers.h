#pragma once
// Random registers and vertices, from tame to hostile.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "gte/registers.h"
#include "tests/random.h"

namespace tests {

/// How far from an ordinary scene.
enum class Kind { tame, wide, edge, beyond, hostile, count };

/// Registers of a kind: tame = a rotation, a translation in front of the eye, sane offsets; wide = any matrix
/// within the 32-bit bound; edge = matrices whose rows meet the bound or miss it by one; beyond =
/// any matrix and translation, sane offsets; hostile = anything.
inline gte::Registers registers(Random& random, Kind kind) {
  gte::Registers r;
  for (unsigned i = 0; i < 64; ++i) gte::write(r, i, random.hostile_word());
  if (kind == Kind::hostile) return r;
  if (kind != Kind::beyond) {
    const std::int32_t largest = kind == Kind::tame ? 4096 : 10922;
    for (gte::Matrix* m : {&r.rt, &r.llm, &r.lcm}) {
      for (auto& row : *m) {
        for (auto& element : row) element.raw = static_cast<std::int16_t>(random.between(-largest, largest));
        if (kind == Kind::edge && random.below(2) == 0) {
          const std::int32_t a = random.between(0, 32768), b = random.between(32767 - (32768 - a), 32768);
          const auto sign = [&](std::int32_t v) {
            return static_cast<std::int16_t>(v == 32768 || random.below(2) ? -v : v);
          };
          row = {gte::S3_12{sign(a)}, gte::S3_12{sign(b)},
                 gte::S3_12{sign(std::max(0, random.between(65534, 65537) - a - b))}};
        }
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      r.tr[i] = kind == Kind::edge ? random.between(-3, 3) : random.between(-20000, 20000);
      r.bk[i].raw = random.between(-4096, 4096);
      r.fc[i].raw = random.between(-4096, 8192);
    }
    if (kind == Kind::tame) r.tr[2] = random.between(2000, 30000);
  }
  r.ofx.raw = random.between(0, 512 << 16);
  r.ofy.raw = random.between(0, 480 << 16);
  r.h = static_cast<std::uint16_t>(random.between(1, kind == Kind::tame ? 1000 : 65535));
  r.dqa.raw = static_cast<std::int16_t>(random.between(-8192, 8192));
  r.dqb.raw = random.between(-0x2000000, 0x2000000);
  if (random.below(4) == 0) r.dqa.raw = 0;
  r.zsf3.raw = static_cast<std::int16_t>(random.between(-10923, 10923));
  r.zsf4.raw = static_cast<std::int16_t>(random.between(-8192, 8192));
  return r;
}

inline gte::Vertex vertex(Random& random, Kind kind) {
  const auto any = [&] { return static_cast<std::int16_t>(random.hostile_word()); };
  const auto tame = [&] { return static_cast<std::int16_t>(random.between(-2000, 2000)); };
  if (kind == Kind::tame) return {tame(), tame(), tame(), any()};
  return {any(), any(), any(), any()};
}

inline std::vector<gte::Vertex> vertices(Random& random, Kind kind, std::size_t count) {
  std::vector<gte::Vertex> v(count);
  for (auto& each : v) each = vertex(random, kind);
  return v;
}

}  // namespace tests
