#pragma once
// X3D scenes in the XML encoding: the nodes that course material uses.   [ISO/IEC 19775-1, 19776-1]
//
// Read: Transform, Group (StaticGroup, Anchor, Collision), Switch, DEF and USE; Shape, Appearance, Material,
// UnlitMaterial, ImageTexture, TextureTransform; TriangleSet, TriangleFanSet, TriangleStripSet, QuadSet,
// their Indexed kinds, IndexedFaceSet, LineSet, IndexedLineSet, PointSet with Coordinate, Color, ColorRGBA,
// Normal, TextureCoordinate; Box, Sphere, Cone, Cylinder; TriangleSet2D, Rectangle2D, Disk2D, Circle2D,
// Arc2D, ArcClose2D, Polyline2D, Polypoint2D; Viewpoint (the first), NavigationInfo headlight,
// DirectionalLight, Background (its first sky colour); TimeSensor, ROUTE, ScalarInterpolator,
// PositionInterpolator, OrientationInterpolator, SplinePositionInterpolator, SplineScalarInterpolator. Any
// other node is named once.
//
// Not modelled: specular light, fog, sound, scripts, sensors, prototypes, Inline, DirectionalLight's scope
// (every light shines everywhere), animation of anything but Transform, Viewpoint and DirectionalLight.
//
// Choices that the specification leaves or that we make differently:
//  - transparency between 0 and 1 is the console's average blend, whatever its value; at 1 nothing is drawn.
//  - solid left out: closed surfaces show their front only, all others both sides (the specification would
//  hide
//    the back of open ones too; the course draws them). solid given: as given.
//  - no light at all: colours and textures show as they are where nothing is emitted, not black.
//  - a scene of 2D nodes alone is a picture whose y runs down, mirrored about the Viewpoint's height, as the
//    course draws it. 2D nodes are never lit.
//  - no Viewpoint: (0, 0, 10) as specified; farther off when that does not show all of the scene.

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "load/load.h"
#include "scene/world.h"

namespace load::x3d {

/// What is known while one file is read: its DEF names, what has been said, what may still be spent. The
/// first error stays; after it every field reads as left out, so that a reader need not look after each step.
class Context {
 public:
  Context(std::string_view bytes, const Source& source, std::vector<std::string>& warnings);
  void collect_names(const pugi::xml_node& root);

  void fail(const pugi::xml_node& at, const std::string& text);
  [[nodiscard]] const std::optional<base::Error>& error() const { return error_; }
  /// Each text once.
  void warn(const pugi::xml_node& at, const std::string& text);
  /// Names a node that is not read, each kind once.
  void unsupported(const pugi::xml_node& node);

  /// What is looked at again and again has a price, so that no node that is used a thousand times and holds a
  /// thousand things can stretch the time: false after an error, when 100 million looks are spent.
  bool look(const pugi::xml_node& at, std::size_t count = 1);
  pugi::xml_attribute attribute(const pugi::xml_node& node, const char* name);
  /// The first child element of that kind as it stands; null if there is none.
  pugi::xml_node direct_child(const pugi::xml_node& node, const char* name);
  /// Looks spent: the work that was done on this file.
  [[nodiscard]] std::size_t looks() const { return most_looks - looks_left_; }

  /// The node itself, or what its USE means; null with a warning if no DEF has that name.
  pugi::xml_node resolve(const pugi::xml_node& node);
  /// The first child element of that kind, USE resolved; null if there is none.
  pugi::xml_node child(const pugi::xml_node& node, const char* name);
  [[nodiscard]] pugi::xml_node named(const char* name) const;

  bool flag(const pugi::xml_node& node, const char* field, bool otherwise);
  float scalar(const pugi::xml_node& node, const char* field, float otherwise);
  glm::vec3 vector(const pugi::xml_node& node, const char* field, const glm::vec3& otherwise);
  std::vector<float> floats(const pugi::xml_node& node, const char* field);
  std::vector<glm::vec2> pairs(const pugi::xml_node& node, const char* field);
  std::vector<glm::vec3> triples(const pugi::xml_node& node, const char* field);
  std::vector<std::int32_t> wholes(const pugi::xml_node& node, const char* field);
  /// The strings of an MFString; quotes may be left out if there is one.
  std::vector<std::string> strings(const pugi::xml_node& node, const char* field);

  /// Takes `count` off what is left of a budget; fails and returns false when it is not there.
  bool spend(const pugi::xml_node& at, std::size_t& budget, std::size_t count, const char* of_what);
  std::size_t faces_left = limits::faces;
  std::size_t vertices_left = limits::vertices;
  std::size_t visits_left = limits::elements;
  std::size_t instances_left = limits::instances;
  std::uint64_t split_work_left;

 private:
  [[nodiscard]] std::string place(const pugi::xml_node& at) const;
  std::size_t line_of(const pugi::xml_node& at) const;

  std::string_view bytes_;
  const Source& source_;
  std::vector<std::string>& warnings_;
  std::set<std::string> said_;
  std::map<std::string, pugi::xml_node, std::less<>> names_;
  std::optional<base::Error> error_;
  std::size_t numbers_left_ = 50'000'000;
  static constexpr std::size_t most_looks = 100'000'000;
  std::size_t looks_left_ = most_looks;
};

bool is_element(const pugi::xml_node& node);
/// Elements that draw nothing and need no word: metadata, world information.
bool is_silent(const pugi::xml_node& node);

/// How a surface looks, its appearance read.
struct Look {
  Material material;
  glm::vec3 colour{1.0F};       ///< of every corner, unless a Color node says otherwise
  glm::vec3 line_colour{1.0F};  ///< of lines, points and 2D nodes
  glm::vec2 uv_scale{1.0F}, uv_centre{0.0F}, uv_offset{0.0F};
  double uv_turns = 0;
  bool is_invisible = false;
  [[nodiscard]] glm::vec2 picture_position(const glm::vec2& uv) const;  ///< from bottom left to top left
  [[nodiscard]] Rgb8 stored(const glm::vec3& rgb) const;
};

/// What a geometry node becomes. Faces and lines have material 0; closed[i] tells
/// what `solid` left out means.
struct Geometry {
  Mesh mesh;
  enum class Sides : std::uint8_t { both, front, front_if_closed } sides = Sides::front_if_closed;
  bool is_2d = false;  ///< unlit, drawn in line_colour
};

/// Reads one geometry node; empty after unsupported() if its kind is not known.
std::optional<Geometry> read_geometry(Context& context, const pugi::xml_node& node, const Look& look);
bool is_2d_node(std::string_view name);

/// Polygons before they are split: lists, and corners that point into them.
struct Corner {
  std::uint32_t point = 0, colour = none, uv = none, normal = none;
};
struct Polygons {
  std::vector<glm::vec3> points;
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec3> colours, normals;
  std::vector<Corner> corners;
  std::vector<std::uint32_t> sizes;  ///< corners of each polygon, in order
  double crease = -1;                ///< turns; normals are made up to this angle if not given; below 0: none
};
/// Splits them into the mesh, wound as given.
void add_polygons(Context& context, const pugi::xml_node& node, Polygons& polygons, const Look& look,
                  Mesh& mesh);

/// The 2D nodes; false: it is none of them.
bool read_2d(Context& context, const pugi::xml_node& node, const Look& look, Geometry& geometry);

}  // namespace load::x3d
