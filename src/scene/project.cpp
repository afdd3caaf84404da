#include "scene/project.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "gte/batch.h"
#include "scene/angle.h"

namespace scene {
namespace {

// Screen positions between which a vertex may stay as it is. Whole pixels inside the guard band of clip.cpp,
// so that nothing that counts as projectable needs cutting.
struct Limits {
  explicit Limits(const Projection& p)
      : near_z(p.near_z),
        left(p.width / 2 - static_cast<int>(guard_band.half_width)),
        right(p.width / 2 + static_cast<int>(guard_band.half_width)),
        top(p.height / 2 - static_cast<int>(guard_band.half_height)),
        bottom(p.height / 2 + static_cast<int>(guard_band.half_height)),
        picture_right(p.width + picture_margin),
        picture_bottom(p.height + picture_margin) {}
  int near_z, left, right, top, bottom, picture_right, picture_bottom;
};

// FLAG bits that make a screen position worthless. MAC0 is not among them: where it overflows for x or y, SX2
// or SY2 saturates, and the fog's MAC0 concerns nobody here.
constexpr std::uint32_t worthless =
    gte::flag::error_causes & ~(gte::flag::mac0_positive | gte::flag::mac0_negative);

std::uint8_t code_of(const Limits& l, gte::ScreenXy p, std::uint16_t z, std::uint32_t flag) {
  const bool unprojectable = (flag & worthless) != 0 || z < l.near_z || p.x < l.left || p.x > l.right ||
                             p.y < l.top || p.y > l.bottom;
  const auto sides =
      (p.x < -picture_margin ? outcode::left : 0) | (p.x >= l.picture_right ? outcode::right : 0) |
      (p.y < -picture_margin ? outcode::above : 0) | (p.y >= l.picture_bottom ? outcode::below : 0);
  return static_cast<std::uint8_t>(unprojectable ? outcode::unprojectable : sides);
}

// The accurate transforms: the same formulas in Real, not rounded before the screen.
template <class Real>
struct FloatingMap {
  explicit FloatingMap(const Placement& placement)
      : linear(placement.exact.linear), offset(placement.exact.offset), projection(placement.projection) {}

  [[nodiscard]] glm::vec<3, Real> to_view(glm::vec3 p) const {
    return linear * glm::vec<3, Real>(p) + offset;
  }

  // False where a screen position would mean nothing.
  bool to_screen(glm::vec<3, Real> view, ProjectedPoint& out) const {
    constexpr double farthest = 65535;
    const auto z = static_cast<double>(view.z);
    if (!(z >= projection.near_z) || !(z <= farthest)) return false;
    const Real scale = static_cast<Real>(projection.h) / view.z;
    // 16.16 as the GTE's sums, so that fractions mean the same.
    const auto fixed = [](Real v) { return floor_saturated<std::int32_t>(static_cast<double>(v) * 65536); };
    const int centre_x = projection.width / 2, centre_y = projection.height / 2;  // as OFX and OFY
    const std::int32_t x = fixed(static_cast<Real>(centre_x) + view.x * scale);
    const std::int32_t y = fixed(static_cast<Real>(centre_y) + view.y * scale);
    constexpr std::int32_t limit = 1023 << 16;
    if (x < -limit || x > limit || y < -limit || y > limit) return false;
    out.sxy = {static_cast<std::int16_t>(x >> 16), static_cast<std::int16_t>(y >> 16)};
    out.fraction_x = static_cast<std::uint8_t>(x >> 8 & 0xff);
    out.fraction_y = static_cast<std::uint8_t>(y >> 8 & 0xff);
    out.z_20_12 = round_saturated<std::uint32_t>(z * 4096);
    out.sz = static_cast<std::uint16_t>(out.z_20_12 >> 12);
    return true;
  }

  glm::mat<3, 3, Real> linear;
  glm::vec<3, Real> offset;
  Projection projection;
};

std::int16_t fog_of(const gte::Registers& r, std::uint32_t z_20_12) {
  const double q = r.h * 65536.0 * 4096.0 / std::max<std::uint32_t>(1, z_20_12);
  return round_saturated<std::int16_t>(std::clamp((r.dqb.raw + q * r.dqa.raw) / 4096, 0.0, 4096.0));
}

template <class Real>
void project_in(const Placement& placement, const Wanted& wanted, Projected& out) {
  const FloatingMap<Real> map(placement);
  const Limits limits(placement.projection);
  const auto& positions = placement.model->positions;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    ProjectedPoint p;
    const bool projectable = map.to_screen(map.to_view(positions[i]), p);
    out.code[i] = projectable ? code_of(limits, p.sxy, p.sz, 0) : outcode::unprojectable;
    out.sxy[i] = p.sxy;
    out.sz[i] = p.sz;
    if (wanted.depth) out.z_20_12[i] = p.z_20_12;
    if (wanted.fractions) {
      out.fraction_x[i] = p.fraction_x;
      out.fraction_y[i] = p.fraction_y;
    }
    if (wanted.fog) out.ir0[i] = fog_of(placement.registers, p.z_20_12);
  }
}

void project_gte(const Placement& placement, const Wanted& wanted, Projected& out) {
  gte::ProjectOut arrays;
  arrays.sxy = out.sxy.data();
  arrays.sz = out.sz.data();
  arrays.flag = out.flag.data();
  if (wanted.fog) arrays.ir0 = out.ir0.data();
  if (wanted.depth) arrays.z_20_12 = out.z_20_12.data();
  if (wanted.fractions) {
    arrays.fraction_x = out.fraction_x.data();
    arrays.fraction_y = out.fraction_y.data();
  }
  const auto& vertices = placement.model->vertices;
  gte::project(placement.registers, vertices, arrays);
  const Limits limits(placement.projection);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    out.code[i] = code_of(limits, out.sxy[i], out.sz[i], out.flag[i]);
}

}  // namespace

void Projected::resize(std::size_t vertices, const Wanted& wanted) {
  sxy.resize(vertices);
  sz.resize(vertices);
  flag.resize(vertices);
  code.resize(vertices);
  ir0.resize(wanted.fog ? vertices : 0);
  z_20_12.resize(wanted.depth ? vertices : 0);
  fraction_x.resize(wanted.fractions ? vertices : 0);
  fraction_y.resize(wanted.fractions ? vertices : 0);
}

glm::dvec3 Placement::view_position(std::uint32_t vertex) const {
  switch (transform) {
    case Transform::float32:
      return FloatingMap<float>(*this).to_view(model->positions[vertex]);
    case Transform::float64:
      return FloatingMap<double>(*this).to_view(model->positions[vertex]);
    case Transform::gte:
      break;
  }
  // MAC1..3 of RTPS: no sum can overflow, set_transform saw to that.
  const gte::Vertex& v = model->vertices[vertex];
  glm::dvec3 view;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = registers.rt[i];
    const auto product = [&](std::size_t k, std::int16_t c) { return std::int64_t{row[k].raw} * c; };
    const std::int64_t sum =
        std::int64_t{registers.tr[i]} * 4096 + product(0, v.x) + product(1, v.y) + product(2, v.z);
    view[static_cast<int>(i)] = static_cast<double>(sum >> 12);
  }
  return view;
}

void project(const Placement& placement, const Wanted& wanted, Projected& out) {
  out.resize(placement.model->vertices.size(), wanted);
  switch (placement.transform) {
    case Transform::gte:
      return project_gte(placement, wanted, out);
    case Transform::float32:
      return project_in<float>(placement, wanted, out);
    case Transform::float64:
      return project_in<double>(placement, wanted, out);
  }
}

ProjectedPoint project_point(const Placement& placement, glm::dvec3 view) {
  ProjectedPoint out;
  if (placement.transform == Transform::float32) {
    FloatingMap<float>(placement).to_screen(glm::vec3(view), out);
    return out;
  }
  if (placement.transform == Transform::float64) {
    FloatingMap<double>(placement).to_screen(view, out);
    return out;
  }
  // RTPS with an identity matrix leaves the point as it is; z stands half in the vertex,
  // half in TRZ, to fit 16 bits.
  gte::Registers r = placement.registers;
  r.rt = {};
  for (std::size_t i = 0; i < 3; ++i) r.rt[i][i].raw = 4096;
  r.tr = {0, 0, 32768};
  const gte::Vertex vertex{static_cast<std::int16_t>(view.x), static_cast<std::int16_t>(view.y),
                           static_cast<std::int16_t>(view.z - 32768), 0};
  gte::ProjectOut arrays;
  arrays.sxy = &out.sxy;
  arrays.sz = &out.sz;
  arrays.z_20_12 = &out.z_20_12;
  arrays.fraction_x = &out.fraction_x;
  arrays.fraction_y = &out.fraction_y;
  gte::project(r, {&vertex, 1}, arrays);
  return out;
}

void Shader::use_world_normals(const Model& model, const glm::dmat3& normals_to_world) {
  normals_.clear();
  for (const auto& n : model.colours.exact_normal) {
    glm::dvec3 world = normals_to_world * glm::dvec3(n);
    const double length = std::sqrt(glm::dot(world, world));
    if (length > 0) world /= length;
    const auto fixed = [](double v) { return round_saturated<std::int16_t>(v * 4096); };
    normals_.push_back({fixed(world.x), fixed(world.y), fixed(world.z), 0});
  }
}

void Shader::shade(const Placement& placement, const Projected& projected, bool fogged,
                   std::vector<gte::Colour>& out) {
  const ModelColours& colours = placement.model->colours;
  out.resize(colours.given.size());
  const std::span given(colours.given);
  if (fogged) {
    ir0_.resize(colours.cued);
    for (std::size_t i = 0; i < colours.cued; ++i) ir0_[i] = projected.ir0[colours.vertex[i]];
  }
  const std::span<const std::int16_t> ir0(ir0_);
  const std::span normals =
      normals_.empty() ? std::span(colours.normal) : std::span<const gte::Vertex>(normals_);
  std::size_t begin = 0;
  for (const LitRun& run : colours.lit_runs) {
    gte::Registers registers = placement.registers;
    for (std::size_t c = 0; c < 3; ++c) registers.bk[c].raw += run.self_light[c];
    const std::size_t count = run.end - begin;
    gte::light(registers, fogged ? gte::Light::ncds : gte::Light::nccs, normals.subspan(begin, count),
               given.subspan(begin, count),
               fogged ? ir0.subspan(begin, count) : std::span<const std::int16_t>{},
               {.rgb = out.data() + begin});
    begin = run.end;
  }
  const std::size_t cued = std::max(colours.cued, colours.lit);
  if (fogged && cued > colours.lit) {
    gte::cue(placement.registers, given.subspan(colours.lit, cued - colours.lit),
             ir0.subspan(colours.lit, cued - colours.lit), {.rgb = out.data() + colours.lit});
  }
  const std::size_t done = fogged ? cued : colours.lit;
  std::copy(given.begin() + static_cast<std::ptrdiff_t>(done), given.end(),
            out.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace scene
