// The batch door without SIMD: what the functions of batch.h mean, said with the single commands.

#include <algorithm>
#include <cassert>

#include "gte/batch_doors.h"
#include "gte/divide.h"

namespace gte {
namespace plain {
namespace {

/// The sum behind SZ3 before its >> 12: sf = 1 shows its upper 32 bits of 44 in MAC3, sf = 0 the lower 32.
std::uint32_t z_20_12(Registers before, Command c) {
  constexpr std::uint32_t sf = 1u << 19;
  Registers low = before;
  rtps(before, c.word | sf);
  rtps(low, c.word & ~sf);
  const std::int64_t z = std::int64_t{before.mac[3]} * 4096 + (low.mac[3] & 0xfff);
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(z, 0, 0xffffffff));
}

std::uint32_t fraction(std::int32_t offset, std::uint32_t q, std::int16_t ir) {
  return static_cast<std::uint32_t>((offset + std::int64_t{q} * ir) >> 8) & 0xffu;
}

void project(const Registers& setup, std::span<const Vertex> in, const ProjectOut& out, Command c) {
  Registers r = setup;
  for (std::size_t i = 0; i < in.size(); ++i) {
    r.v[0] = in[i];
    rtps(r, c);
    put(out.sxy, i, r.sxy[2]);
    put(out.sz, i, r.sz[3]);
    put(out.flag, i, r.flag);
    put(out.ir0, i, r.ir[0]);
    if (out.z_20_12 != nullptr) out.z_20_12[i] = z_20_12(r, c);
    if (out.fraction_x == nullptr && out.fraction_y == nullptr) continue;
    const std::uint32_t q = divide(r.h, r.sz[3]).value;
    put(out.fraction_x, i, fraction(r.ofx.raw, q, r.ir[1]));
    put(out.fraction_y, i, fraction(r.ofy.raw, q, r.ir[2]));
  }
}

void project_triangles(const Registers& setup, std::span<const Vertex> in, const TriangleOut& out,
                       Command c) {
  assert(in.size() % 3 == 0);
  Registers r = setup;
  for (std::size_t i = 0; i < in.size() / 3; ++i) {
    std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, r.v.begin());
    rtpt(r, c);
    for (std::size_t k = 0; k < 3; ++k) {
      put(out.sxy, 3 * i + k, r.sxy[k]);
      put(out.sz, 3 * i + k, r.sz[k + 1]);
    }
    put(out.flag, i, r.flag);
    put(out.ir0, i, r.ir[0]);
    nclip(r);
    put(out.mac0, i, r.mac[0]);
    avsz3(r);
    put(out.otz, i, r.otz);
    put(out.avsz3_flag, i, r.flag);
  }
}

void light(const Registers& setup, Light kind, std::span<const Vertex> normals, std::span<const Colour> rgbc,
           std::span<const std::int16_t> ir0, const ColourOut& out, Command c) {
  const auto run = kind == Light::ncs ? ncs : kind == Light::nccs ? nccs : ncds;
  Registers r = setup;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    r.v[0] = normals[i];
    if (!rgbc.empty()) r.rgbc = rgbc[i];
    if (!ir0.empty()) r.ir[0] = ir0[i];
    run(r, c);
    put(out.rgb, i, r.rgb[2]);
    put(out.flag, i, r.flag);
  }
}

void cue(const Registers& setup, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
         const ColourOut& out, Command c) {
  Registers r = setup;
  for (std::size_t i = 0; i < rgbc.size(); ++i) {
    r.rgbc = rgbc[i];
    if (!ir0.empty()) r.ir[0] = ir0[i];
    dpcs(r, c);
    put(out.rgb, i, r.rgb[2]);
    put(out.flag, i, r.flag);
  }
}

void cue_triples(const Registers& setup, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out, Command c) {
  assert(rgb.size() % 3 == 0);
  Registers r = setup;
  for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
    std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, r.rgb.begin());
    if (!ir0.empty()) r.ir[0] = ir0[i];
    dpct(r, c);
    for (std::size_t k = 0; k < 3; ++k) put(out.rgb, 3 * i + k, r.rgb[k]);
    put(out.flag, i, r.flag);
  }
}

void multiply(const Registers& setup, Command c, std::span<const Vertex> in, const VectorOut& out) {
  Registers r = setup;
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (c.v() == 3) {
      r.ir = {r.ir[0], in[i].x, in[i].y, in[i].z};
    } else {
      r.v[c.v()] = in[i];
    }
    mvmva(r, c);
    for (std::size_t k = 0; k < 3; ++k) {
      put(out.mac[k], i, r.mac[k + 1]);
      put(out.ir[k], i, r.ir[k + 1]);
    }
    put(out.flag, i, r.flag);
  }
}

}  // namespace
}  // namespace plain

constinit const ProjectDoors plain_project_doors{plain::project, plain::project_triangles};
constinit const LightDoors plain_light_doors{plain::light, plain::cue, plain::cue_triples, plain::multiply};

}  // namespace gte
