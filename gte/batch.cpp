#include "gte/batch.h"

#include <cassert>
#include <string_view>

#include "gte/batch_doors.h"

namespace gte {
namespace {

const Doors* const doors = &plain_doors;

void measure(S3_12 scale, std::span<const ScreenXy> sxy, std::span<const std::uint16_t> sz,
             std::span<const std::uint32_t> indices, std::size_t corners, const FaceOut& out) {
  assert(sxy.size() == sz.size() && indices.size() % corners == 0);
  Registers r;
  r.zsf3 = r.zsf4 = scale;
  for (std::size_t face = 0; face < indices.size() / corners; ++face) {
    const std::uint32_t* corner = indices.data() + face * corners;
    for (std::size_t k = 0; k < corners; ++k) {
      assert(corner[k] < sxy.size());
      if (k < 3) r.sxy[k] = sxy[corner[k]];
      r.sz[4 - corners + k] = sz[corner[k]];
    }
    if (out.mac0 != nullptr || out.nclip_flag != nullptr) {
      nclip(r);
      put(out.mac0, face, r.mac[0]);
      put(out.nclip_flag, face, r.flag);
    }
    if (out.otz == nullptr && out.avsz_flag == nullptr) continue;
    corners == 3 ? avsz3(r) : avsz4(r);
    put(out.otz, face, r.otz);
    put(out.avsz_flag, face, r.flag);
  }
}

}  // namespace

void project(const Registers& setup, std::span<const Vertex> in, const ProjectOut& out, Command c) {
  doors->project(setup, in, out, c);
}

void project_triangles(const Registers& setup, std::span<const Vertex> in, const TriangleOut& out,
                       Command c) {
  assert(in.size() % 3 == 0);
  doors->project_triangles(setup, in, out, c);
}

void measure_triangles(const Registers& setup, std::span<const ScreenXy> sxy,
                       std::span<const std::uint16_t> sz, std::span<const std::uint32_t> indices,
                       const FaceOut& out) {
  measure(setup.zsf3, sxy, sz, indices, 3, out);
}

void measure_quads(const Registers& setup, std::span<const ScreenXy> sxy, std::span<const std::uint16_t> sz,
                   std::span<const std::uint32_t> indices, const FaceOut& out) {
  measure(setup.zsf4, sxy, sz, indices, 4, out);
}

void light(const Registers& setup, Light kind, std::span<const Vertex> normals, std::span<const Colour> rgbc,
           std::span<const std::int16_t> ir0, const ColourOut& out, Command c) {
  assert(rgbc.empty() || rgbc.size() == normals.size());
  assert(ir0.empty() || ir0.size() == normals.size());
  doors->light(setup, kind, normals, rgbc, ir0, out, c);
}

void cue(const Registers& setup, std::span<const Colour> rgbc, std::span<const std::int16_t> ir0,
         const ColourOut& out, Command c) {
  assert(ir0.empty() || ir0.size() == rgbc.size());
  doors->cue(setup, rgbc, ir0, out, c);
}

void cue_triples(const Registers& setup, std::span<const Colour> rgb, std::span<const std::int16_t> ir0,
                 const ColourOut& out, Command c) {
  assert(rgb.size() % 3 == 0 && (ir0.empty() || ir0.size() == rgb.size() / 3));
  doors->cue_triples(setup, rgb, ir0, out, c);
}

void multiply(const Registers& setup, Command c, std::span<const Vertex> in, const VectorOut& out) {
  doors->multiply(setup, c, in, out);
}

const char* batch_target() { return doors->name; }

std::span<const char* const> batch_targets() {
  static constexpr std::array<const char*, 1> names{"scalar"};
  return names;
}

bool use_batch_target(const char* name) { return std::string_view(name) == "scalar"; }

}  // namespace gte
