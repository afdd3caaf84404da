#pragma once
// Faces of one instance become primitives: cull, clip, give a key, hand over. Everything that orders or
// stores primitives is a sink behind this; nothing here knows of tables or memory.

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "gte/commands.h"
#include "ot/packet.h"
#include "scene/clip.h"
#include "scene/frame.h"
#include "scene/halve.h"
#include "scene/knobs.h"
#include "scene/model.h"
#include "scene/project.h"
#include "scene/texture.h"

namespace scene {

/// What a material means to its packets.
struct PacketMaterial {
  const StoredTexture* texture = nullptr;  ///< nullptr: untextured
  bool semi_transparent = false;
  bool raw = false;
  bool double_sided = false;
  std::uint16_t texpage = 0;  ///< the texture's with the blend mode, or the blend mode alone
  std::int32_t bias = 0;
};
[[nodiscard]] std::vector<PacketMaterial> packet_materials(std::span<const Material> materials,
                                                           std::span<const StoredTexture> textures);

/// A corner as it goes into a packet.
struct Corner {
  gte::ScreenXy sxy;
  std::uint16_t sz = 0;
  std::uint8_t fraction_x = 0, fraction_y = 0;
  std::uint32_t z_20_12 = 0;
  gte::Colour colour;
  ot::Uv uv;
  TexelRest rest;
};

/// A polygon (3 or 4 corners, quads as a Z) or a line (2).
struct Primitive {
  std::array<Corner, 4> corner;
  std::size_t count = 0;
  const PacketMaterial* material = nullptr;
  bool gouraud = false;
  std::uint32_t otz = 0;  ///< key, 0..65535; bias not added
  std::uint32_t instance = 0;
  std::uint32_t face = 0;  ///< of the scene's mesh; none for lines
};

/// The sort key of depths sz: AVSZ3, AVSZ4 for the average; the nearest or farthest on the same scale. For
/// two (a line) the average is their sum.
[[nodiscard]] std::uint32_t otz_of(std::span<const Corner> corners, Key key);

/// One instance, projected and shaded.
struct Submission {
  const Placement* placement = nullptr;
  const Projected* projected = nullptr;
  std::span<const gte::Colour> colours;
  std::span<const PacketMaterial> materials;
  const Clipper* clipper = nullptr;
  const Halver* halver = nullptr;  ///< nullptr: faces are drawn as they are
  bool mirrored = false;           ///< the instance turns fronts into backs
  Key key = Key::average;
  std::uint32_t instance = 0;
  /// Bits of the fractions that will be drawn. Which way a face turns is judged where its corners will be: a
  /// sliver whose whole pixels are a line may have samples, and left out it would be a crack.
  std::uint8_t fraction_mask = 0;
};

/// Calls sink(const Primitive&) for what is to be drawn, in the order of the faces, then
/// of the lines; counts the rest.
template <class Sink>
class Submitter {
 public:
  Submitter(const Submission& submission, FrameStats& stats, Sink& sink)
      : s_(submission), model_(*submission.placement->model), stats_(stats), sink_(sink) {}

  void submit() {
    stats_.faces += static_cast<std::uint32_t>(model_.faces.size() + model_.lines.size());
    for (const auto& face : model_.faces) submit(face);
    for (const auto& line : model_.lines) submit(line);
  }

 private:
  void submit(const ModelFace& face) {
    const std::size_t n = face.corners();
    const auto& code = s_.projected->code;
    unsigned any = 0;
    unsigned all = 0xff;
    for (std::size_t k = 0; k < n; ++k) {
      any |= code[face.vertex[k]];
      all &= code[face.vertex[k]];
    }
    if ((all & outcode::sides) != 0) return drop(Drop::outside);
    Primitive p;
    p.material = &s_.materials[face.material];
    p.gouraud = face.gouraud;
    p.instance = s_.instance;
    p.face = face.source;
    if ((any & outcode::unprojectable) != 0) {
      ++stats_.clipped;
      return submit_cut(face, p);
    }
    if (s_.halver != nullptr && is_halved(face)) return submit_cut(face, p);
    for (std::size_t k = 0; k < n; ++k) p.corner[k] = corner_of(face, k);
    p.count = n;
    if (n == 3) {
      if (!faces_us(p.corner[0], p.corner[1], p.corner[2], *p.material)) return drop(Drop::back_face);
      return emit(p);
    }
    const bool first = faces_us(p.corner[0], p.corner[1], p.corner[2], *p.material);
    const bool second = faces_us(p.corner[2], p.corner[1], p.corner[3], *p.material);
    if (first && second) return emit(p);
    if (!first && !second) return drop(Drop::back_face);
    // Bent over: one half is seen from behind. NCLIP of the first three corners
    // alone would keep or lose both.
    p.count = 3;
    if (second) p.corner = {p.corner[2], p.corner[1], p.corner[3], Corner{}};
    emit(p);
  }

  void submit(const ModelLine& line) {
    Primitive p;
    p.material = &s_.materials[line.material];
    p.gouraud = line.gouraud;
    p.instance = s_.instance;
    p.face = none;
    const auto& code = s_.projected->code;
    const unsigned a = code[line.vertex[0]];
    const unsigned b = code[line.vertex[1]];
    if ((a & b & outcode::sides) != 0) return drop(Drop::outside);
    if (((a | b) & outcode::unprojectable) != 0) {
      ClipPolygon in;
      for (std::size_t k = 0; k < 2; ++k) in.add(clip_vertex(line.vertex[k], line.colour[k], {}, {}));
      if (!clip(in)) return;
      p.corner[0] = corner_of(clipped_.vertex[0]);
      p.corner[1] = corner_of(clipped_.vertex[1]);
    } else {
      for (std::size_t k = 0; k < 2; ++k) p.corner[k] = corner_of(line.vertex[k], line.colour[k]);
    }
    p.count = 2;
    emit(p);
  }

  // The halves of a quad are cut one by one: they need not lie in one plane, and each has its own back.
  void submit_cut(const ModelFace& face, Primitive& p) {
    constexpr std::array<std::array<std::size_t, 3>, 2> halves{{{0, 1, 2}, {2, 1, 3}}};
    bool drawn = false;
    Drop why = Drop::back_face;
    for (std::size_t half = 0; half < (face.is_quad() ? 2U : 1U); ++half) {
      ClipPolygon in;
      for (const auto k : halves[half])
        in.add(clip_vertex(face.vertex[k], face.colour[k], face.uv[k], face.rest[k]));
      const Beyond beyond = s_.clipper->wholly_beyond(in.corners());
      if (beyond != Beyond::nothing) {
        why = beyond == Beyond::near_plane  ? Drop::near_plane
              : beyond == Beyond::far_plane ? Drop::far_plane
                                            : Drop::outside;
        continue;
      }
      s_.clipper->clip(in, clipped_);
      if (clipped_.count < 3) why = Drop::outside;
      drawn = submit_fan(p) || drawn;
    }
    if (!drawn) drop(why);
  }

  bool submit_fan(Primitive& p) {
    bool drawn = false;
    p.count = 3;
    const auto draw = [&](const Corner& a, const Corner& b, const Corner& c) {
      if (!faces_us(a, b, c, *p.material)) return;
      p.corner = {a, b, c, Corner{}};
      emit(p);
      drawn = true;
    };
    const auto& v = clipped_.vertex;
    if (s_.halver != nullptr) {
      const auto piece = [&](const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
        draw(corner_of(a), corner_of(b), corner_of(c));
      };
      for (std::size_t k = 2; k < clipped_.count; ++k) s_.halver->triangle(v[0], v[k - 1], v[k], piece);
      return drawn;
    }
    std::array<Corner, 4 + clip_planes> corners;
    for (std::size_t k = 0; k < clipped_.count; ++k) corners[k] = corner_of(v[k]);
    for (std::size_t k = 2; k < clipped_.count; ++k) draw(corners[0], corners[k - 1], corners[k]);
    return drawn;
  }

  // A quad is drawn as two triangles, so its diagonal counts like its edges.
  [[nodiscard]] bool is_halved(const ModelFace& face) const {
    constexpr std::array<std::array<std::size_t, 2>, 5> edges{{{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}}};
    return std::any_of(edges.begin(), edges.begin() + (face.is_quad() ? 5 : 3), [&](const auto& edge) {
      return s_.halver->halves(s_.placement->view_position(face.vertex[edge[0]]),
                               s_.placement->view_position(face.vertex[edge[1]]));
    });
  }

  bool clip(ClipPolygon& line) {
    const Beyond beyond = s_.clipper->wholly_beyond(line.corners());
    if (beyond == Beyond::near_plane) return drop(Drop::near_plane), false;
    if (beyond == Beyond::far_plane) return drop(Drop::far_plane), false;
    s_.clipper->clip(line, clipped_);
    if (beyond == Beyond::picture || clipped_.count < 2) return drop(Drop::outside), false;
    ++stats_.clipped;
    return true;
  }

  [[nodiscard]] bool faces_us(const Corner& a, const Corner& b, const Corner& c,
                              const PacketMaterial& m) const {
    const std::int64_t area = s_.fraction_mask == 0 ? gte::signed_area(a.sxy, b.sxy, c.sxy)
                                                    : gte::signed_area(fine(a), fine(b), fine(c));
    return m.double_sided ? area != 0 : s_.mirrored ? area < 0 : area > 0;
  }

  // In units of 1/256 pixel.
  struct FineXy {
    std::int64_t x, y;
  };
  [[nodiscard]] FineXy fine(const Corner& c) const {
    return {c.sxy.x * 256 + (c.fraction_x & s_.fraction_mask),
            c.sxy.y * 256 + (c.fraction_y & s_.fraction_mask)};
  }

  [[nodiscard]] Corner corner_of(const ModelFace& face, std::size_t k) const {
    Corner c = corner_of(face.vertex[k], face.colour[k]);
    c.uv = face.uv[k];
    c.rest = face.rest[k];
    return c;
  }

  [[nodiscard]] Corner corner_of(std::uint32_t vertex, std::uint32_t colour) const {
    const Projected& from = *s_.projected;
    Corner c;
    c.sxy = from.sxy[vertex];
    c.sz = from.sz[vertex];
    if (!from.z_20_12.empty()) c.z_20_12 = from.z_20_12[vertex];
    if (!from.fraction_x.empty()) {
      c.fraction_x = from.fraction_x[vertex];
      c.fraction_y = from.fraction_y[vertex];
    }
    c.colour = s_.colours[colour];
    return c;
  }

  [[nodiscard]] ClipVertex clip_vertex(std::uint32_t vertex, std::uint32_t colour, ot::Uv uv,
                                       TexelRest rest) const {
    ClipVertex out;
    const gte::Colour& c = s_.colours[colour];
    out.position = s_.placement->view_position(vertex);
    out.colour = {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
    out.uv = {static_cast<float>(uv.u), static_cast<float>(uv.v)};
    out.exact_uv = {out.uv[0] + static_cast<float>(rest.u) / 8, out.uv[1] + static_cast<float>(rest.v) / 8};
    out.is_projectable = (s_.projected->code[vertex] & outcode::unprojectable) == 0;
    out.vertex = vertex;
    return out;
  }

  Corner corner_of(const ClipVertex& v) {
    const auto rounded = [](float value) { return static_cast<std::uint8_t>(value + 0.5F); };
    Corner c;
    if (v.is_projectable) {
      c = corner_of(v.vertex, 0);
    } else {
      const ProjectedPoint point = project_point(*s_.placement, v.position);
      ++stats_.vertices;
      c.sxy = point.sxy;
      c.sz = point.sz;
      c.z_20_12 = point.z_20_12;
      c.fraction_x = point.fraction_x;
      c.fraction_y = point.fraction_y;
    }
    c.colour = {rounded(v.colour[0]), rounded(v.colour[1]), rounded(v.colour[2]), 0};
    c.uv = {rounded(v.uv[0]), rounded(v.uv[1])};
    c.rest = {texel_rest(static_cast<double>(v.exact_uv[0]), c.uv.u),
              texel_rest(static_cast<double>(v.exact_uv[1]), c.uv.v)};
    return c;
  }

  void emit(Primitive& p) {
    p.otz = otz_of(std::span(p.corner).first(p.count), s_.key);
    sink_(static_cast<const Primitive&>(p));
  }
  void drop(Drop why) { ++stats_.dropped[static_cast<std::size_t>(why)]; }

  const Submission& s_;
  const Model& model_;
  FrameStats& stats_;
  Sink& sink_;
  ClipPolygon clipped_;
};

/// The packet of a polygon, its colours and coordinates filled in.
[[nodiscard]] ot::Polygon polygon_of(const Primitive& p);
[[nodiscard]] ot::Line line_of(const Primitive& p);
[[nodiscard]] ot::DepthAnnotation depth_of(const Primitive& p, std::uint8_t fraction_mask,
                                           bool has_fractions);
/// It has colours or texture coordinates that change across it.
[[nodiscard]] inline bool is_shaded(const Primitive& p) {
  return p.material->texture != nullptr || p.gouraud;
}

}  // namespace scene
