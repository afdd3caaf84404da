#include "load/x3d/x3d.h"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "files.h"
#include "load/faces.h"

namespace {

using scene::Blend, scene::Face, scene::Material, scene::Mesh, scene::Rgb8, scene::World;
using tests::refusal;

constexpr const char* triangle = "<TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet>";

base::Result<load::LoadedScene> parse(const std::string& inside, const std::filesystem::path& folder = ".") {
  return load::parse_x3d("<X3D><Scene>\n" + inside + "\n</Scene></X3D>", {"s.x3d", folder});
}
load::LoadedScene read(const std::string& inside, const std::filesystem::path& folder = ".") {
  auto loaded = parse(inside, folder);
  if (!loaded) FAIL(loaded.error().text);
  return std::move(*loaded);
}
std::string shape(const std::string& geometry, const std::string& appearance = "") {
  return "<Shape>" + geometry + "<Appearance>" + appearance + "</Appearance></Shape>";
}
Mesh mesh_of(const std::string& geometry, const std::string& appearance = "") {
  const auto loaded = read(shape(geometry, appearance));
  REQUIRE(loaded.scene.world.meshes.size() == 1);
  CHECK(loaded.warnings.empty());
  return loaded.scene.world.meshes[0];
}
Material material_of(const World& world) {
  return world.materials.at(world.meshes.at(0).faces.at(0).material);
}
Rgb8 colour_of(const World& world) { return world.meshes.at(0).faces.at(0).colour[0]; }

// Where a point of the first instance is.
glm::vec3 placed(const World& world, const glm::vec3& p, std::size_t instance = 0) {
  return glm::vec3(world.instances.at(instance).model * glm::vec4(p, 1));
}
bool is_near(const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 1e-4F; }

// Sum over all faces of twice the area as seen from +z: what a splitting must keep.
double area_of(const Mesh& mesh) {
  double sum = 0;
  for (const Face& f : mesh.faces) {
    const auto at = [&](std::size_t i) { return glm::dvec3(mesh.positions[f.vertex[i]]); };
    sum += glm::cross(at(1) - at(0), at(2) - at(0)).z;
    if (f.is_quad()) sum += glm::cross(at(2) - at(0), at(3) - at(0)).z;
  }
  return sum / 2;
}

TEST_SUITE("loaders") {
  // ---- the tree

  TEST_CASE("X3D: a Transform scales, then turns, then moves, about its centre") {
    CHECK(is_near(placed(read("<Transform translation='5 0 0' rotation='0 0 1 1.5707963' scale='2 1 1'>" +
                              shape(triangle) + "</Transform>")
                             .scene.world,
                         {1, 0, 0}),
                  {5, 2, 0}));
    CHECK(is_near(placed(read("<Transform center='1 0 0' rotation='0 0 1 3.1415927'>" + shape(triangle) +
                              "</Transform>")
                             .scene.world,
                         {0, 0, 0}),
                  {2, 0, 0}));
    // Stretched by 3 along the diagonal: its points are 3 times as far, those across it stay.
    const auto stretched = read("<Transform scaleOrientation='0 0 1 0.78539816' scale='3 1 1'>" +
                                shape(triangle) + "</Transform>");
    CHECK(is_near(placed(stretched.scene.world, {1, 1, 0}), {3, 3, 0}));
    CHECK(is_near(placed(stretched.scene.world, {1, -1, 0}), {1, -1, 0}));
  }

  TEST_CASE("X3D: nested Transforms multiply, Groups do not") {
    const auto loaded = read("<Transform translation='1 0 0'><Group><Transform scale='2 2 2'>" +
                             shape(triangle) + "</Transform></Group></Transform>");
    CHECK(is_near(placed(loaded.scene.world, {1, 1, 1}), {3, 2, 2}));
  }

  TEST_CASE("X3D: rotations of any angle are taken, more than a turn and negative ones too") {
    const auto turned = [](const char* angle) {
      return placed(
          read(std::string("<Transform rotation='0 0 2 ") + angle + "'>" + shape(triangle) + "</Transform>")
              .scene.world,
          {1, 0, 0});
    };
    CHECK(is_near(turned("-1.5707963"), {0, -1, 0}));
    CHECK(is_near(turned("7.8539816"), {0, 1, 0}));
  }

  TEST_CASE("X3D: USE draws a DEF again, and its mesh is stored once") {
    const auto loaded = read("<Transform translation='1 0 0'><Shape DEF='S'>" + std::string(triangle) +
                             "</Shape></Transform><Shape USE='S'/>");
    CHECK(loaded.scene.world.meshes.size() == 1);
    REQUIRE(loaded.scene.world.instances.size() == 2);
    CHECK(is_near(placed(loaded.scene.world, {0, 0, 0}, 1), {0, 0, 0}));
  }

  TEST_CASE("X3D: appearances, materials and coordinates may be USEd") {
    const auto loaded =
        read("<NavigationInfo headlight='false'/>" +
             shape("<TriangleSet><Coordinate DEF='C' point='0 0 0 1 0 0 0 1 0'/></TriangleSet>",
                   "<Material DEF='M' emissiveColor='1 0 0'/>") +
             shape("<TriangleSet><Coordinate USE='C'/></TriangleSet>", "<Material USE='M'/>"));
    REQUIRE(loaded.scene.world.meshes.size() == 2);
    CHECK(loaded.scene.world.meshes[1].faces[0].colour[0] == Rgb8{255, 0, 0});
  }

  TEST_CASE("X3D: a node that contains its own USE is refused, however deep, with file and line") {
    CHECK(refusal(parse("<Group DEF='A'>\n<Transform>\n<Group USE='A'/></Transform></Group>")) ==
          "s.x3d:4: Group: USE='A' stands inside the node it names");
    CHECK(refusal(parse("<Group DEF='A'><Group DEF='B'><Group USE='A'/></Group></Group><Group USE='B'/>"))
              .find("USE='A'") != std::string::npos);
  }

  TEST_CASE("X3D: a USE that no DEF has is a warning") {
    const auto loaded = read("<Shape USE='gone'/>" + shape(triangle));
    CHECK(loaded.scene.world.instances.size() == 1);
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(loaded.warnings[0] == "s.x3d:2: USE='gone' names no DEF; left out");
  }

  TEST_CASE("X3D: a Switch draws its choice alone") {
    const std::string three = shape(triangle) + "<Transform translation='7 0 0'>" + shape(triangle) +
                              "</Transform>" + shape(triangle);
    const auto loaded = read("<Switch whichChoice='1'>" + three + "</Switch>");
    REQUIRE(loaded.scene.world.instances.size() == 1);
    CHECK(is_near(placed(loaded.scene.world, {0, 0, 0}), {7, 0, 0}));
    CHECK(read("<Switch>" + three + "</Switch>").scene.world.instances.empty());
  }

  TEST_CASE("X3D: every unsupported kind of node is named once, and the rest is drawn") {
    const auto loaded = read("<Fog/><Fog/><Script/>" + shape("<Text string='a'/>") + shape(triangle));
    REQUIRE(loaded.warnings.size() == 3);
    CHECK(loaded.warnings[0] == "s.x3d:2: node 'Fog' is not supported and left out");
    CHECK(loaded.scene.world.instances.size() == 1);
  }

  // ---- appearance and light

  TEST_CASE("X3D: without a Material a surface is white, not lit, and opaque") {
    const auto loaded = read("<Shape>" + std::string(triangle) + "</Shape>");
    CHECK(colour_of(loaded.scene.world) == Rgb8{255, 255, 255});
    CHECK(!material_of(loaded.scene.world).lit);
    CHECK(material_of(loaded.scene.world).blend == Blend::opaque);
  }

  TEST_CASE("X3D: a Material is lit in its diffuse colour by the headlight, which is on unless turned off") {
    const auto loaded = read(shape(triangle, "<Material diffuseColor='1 0.5 0'/>"));
    CHECK(colour_of(loaded.scene.world) == Rgb8{255, 128, 0});
    CHECK(material_of(loaded.scene.world).lit);
    REQUIRE(loaded.scene.world.lights.size() == 1);
    CHECK(loaded.scene.world.lights[0].at_camera);
    CHECK(loaded.scene.world.lights[0].direction == glm::vec3(0, 0, -1));
    CHECK(read("<NavigationInfo headlight='false'/>" + shape(triangle)).scene.world.lights.empty());
    CHECK(read("<NavigationInfo type='\"NONE\"'/>" + shape(triangle)).scene.world.lights.size() == 1);
  }

  TEST_CASE("X3D: with no light a surface shows what it emits, and black if that is nothing") {
    const std::string dark = "<NavigationInfo headlight='false'/>";
    auto loaded = read(dark + shape(triangle, "<Material emissiveColor='0 0 1'/>"));
    CHECK(colour_of(loaded.scene.world) == Rgb8{0, 0, 255});
    CHECK(!material_of(loaded.scene.world).lit);
    loaded = read(dark + shape(triangle, "<Material/>"));
    CHECK(colour_of(loaded.scene.world) == Rgb8{0, 0, 0});
  }

  TEST_CASE(
      "X3D: a surface that is lit and emits has light of its own, its emissive through its diffuse colour") {
    const auto loaded =
        read(shape(triangle, "<Material diffuseColor='0.5 0.5 0' emissiveColor='0.25 0 0.7'/>"));
    const Material m = material_of(loaded.scene.world);
    CHECK(m.lit);
    CHECK(m.self_light.x == doctest::Approx(0.5));
    CHECK(m.self_light.y == 0);
    CHECK(m.self_light.z == doctest::Approx(7));
    CHECK(colour_of(loaded.scene.world) == Rgb8{128, 128, 26});
    CHECK(!material_of(
               read(shape(triangle, "<Material diffuseColor='0 0 0' emissiveColor='1 1 1'/>")).scene.world)
               .lit);
  }

  TEST_CASE("X3D: transparency between 0 and 1 is the average blend, 1 is not drawn") {
    CHECK(material_of(read(shape(triangle, "<Material transparency='0.3'/>")).scene.world).blend ==
          Blend::average);
    CHECK(material_of(read(shape(triangle, "<Material transparency='0.9'/>")).scene.world).blend ==
          Blend::average);
    CHECK(read(shape(triangle, "<Material transparency='1'/>")).scene.world.instances.empty());
  }

  TEST_CASE(
      "X3D: a DirectionalLight shines its way through its Transform, times its intensity; off means off") {
    const auto loaded = read(
        "<NavigationInfo headlight='false'/><Transform rotation='0 1 0 1.5707963'>"
        "<DirectionalLight direction='0 0 -2' color='1 0.5 0' intensity='0.5'/></Transform>"
        "<DirectionalLight on='false'/>" +
        shape(triangle));
    REQUIRE(loaded.scene.world.lights.size() == 1);
    CHECK(is_near(loaded.scene.world.lights[0].direction, {-1, 0, 0}));
    CHECK(is_near(loaded.scene.world.lights[0].colour, {0.5F, 0.25F, 0}));
  }

  TEST_CASE("X3D: the Background is its first sky colour") {
    CHECK(read("<Background skyColor='0 1 0.5'/>" + shape(triangle)).scene.world.background ==
          Rgb8{0, 255, 128});
  }

  TEST_CASE(
      "X3D: an ImageTexture is read from the first url that can be had, and replaces the diffuse colour") {
    const tests::Folder folder;
    folder.write("p.png", tests::png(4, 2, 1, 2, 3));
    const auto loaded = read(
        shape(triangle, "<Material diffuseColor='1 0 0'/><ImageTexture url=' \"none.png\" \"p.png\" '/>"),
        folder.path());
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(loaded.warnings[0] == "s.x3d: texture 'none.png' is left out: there is no such file");
    REQUIRE(material_of(loaded.scene.world).texture == 0);
    CHECK(loaded.scene.world.textures[0].repeats);
    CHECK(colour_of(loaded.scene.world) == Rgb8{128, 128, 128});
    const auto clamped =
        read(shape(triangle, "<ImageTexture url='p.png' repeatS='false' repeatT='false'/>"), folder.path());
    CHECK(!clamped.scene.world.textures[0].repeats);
  }

  TEST_CASE("X3D: a texture with partly transparent texels blends") {
    const tests::Folder folder;
    folder.write("p.png", tests::png(4, 2, 1, 2, 3, 100));
    const auto loaded = read(shape(triangle, "<ImageTexture url='p.png'/>"), folder.path());
    CHECK(material_of(loaded.scene.world).blend == Blend::average);
  }

  TEST_CASE(
      "X3D: a texture without coordinates covers the bounding box, along its longest side from left to "
      "right") {
    const tests::Folder folder;
    folder.write("p.png", tests::png(4, 2, 1, 2, 3));
    const auto loaded = read(shape("<IndexedFaceSet coordIndex='0 1 2 3'><Coordinate point='1 1 0 5 1 0 5 3 "
                                   "0 1 3 0'/></IndexedFaceSet>",
                                   "<ImageTexture url='p.png'/>"),
                             folder.path());
    const Face& f = loaded.scene.world.meshes[0].faces[0];
    CHECK(f.uv[0] == glm::vec2(0, 1));
    CHECK(f.uv[2] == glm::vec2(1, 0.5F));
  }

  TEST_CASE("X3D: a TextureTransform moves, turns about its centre and scales the coordinates") {
    const tests::Folder folder;
    folder.write("p.png", tests::png(4, 2, 1, 2, 3));
    const auto uv = [&](const std::string& fields) {
      return read(shape("<TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/><TextureCoordinate point='1 0 0 "
                        "0 0 1'/></TriangleSet>",
                        "<ImageTexture url='p.png'/><TextureTransform " + fields + "/>"),
                  folder.path())
          .scene.world.meshes[0]
          .faces[0]
          .uv[0];
    };
    CHECK(uv("scale='2 3'") == glm::vec2(2, 1));
    CHECK(uv("translation='0.5 0.25'") == glm::vec2(1.5F, 0.75F));
    CHECK(glm::length(uv("rotation='1.5707963'") - glm::vec2(0, 0)) < 1e-5F);
  }

  // ---- geometry

  TEST_CASE(
      "X3D: TriangleSet takes points by threes, TriangleStripSet turns every second triangle, TriangleFanSet "
      "opens") {
    CHECK(mesh_of(triangle).faces.size() == 1);
    const std::string square = "<Coordinate point='0 0 0 1 0 0 0 1 0 1 1 0'/>";
    CHECK(area_of(mesh_of("<TriangleStripSet stripCount='4'>" + square + "</TriangleStripSet>")) ==
          doctest::Approx(1));
    CHECK(
        area_of(mesh_of(
            "<TriangleFanSet fanCount='4'><Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0'/></TriangleFanSet>")) ==
        doctest::Approx(1));
  }

  TEST_CASE("X3D: the indexed sets draw what their runs of indices say") {
    const std::string square = "<Coordinate point='0 0 0 1 0 0 0 1 0 1 1 0'/>";
    for (const char* geometry :
         {"IndexedTriangleStripSet index='0 1 2 3 -1'", "IndexedTriangleStripSet index='0 1 2 -1 2 1 3'",
          "IndexedTriangleSet index='0 1 2 2 1 3'", "IndexedTriangleFanSet index='0 1 3 2 -1'",
          "IndexedQuadSet index='0 1 3 2'", "IndexedFaceSet coordIndex='0 1 3 2 -1'",
          "IndexedFaceSet coordIndex='0 1 2 -1 -1 2 1 3'"}) {
      CAPTURE(geometry);
      const std::string name(geometry, std::string(geometry).find(' '));
      CHECK(area_of(mesh_of(
                std::string("<").append(geometry).append(">").append(square).append("</").append(name).append(
                    ">"))) == doctest::Approx(1));
    }
  }

  TEST_CASE("X3D: polygons of an IndexedFaceSet may have any number of corners and be concave") {
    const Mesh arrow = mesh_of(
        "<IndexedFaceSet coordIndex='0 1 2 3'><Coordinate point='0 0 0 4 -3 0 0 5 0 -4 -3 "
        "0'/></IndexedFaceSet>");
    CHECK(arrow.faces.size() == 2);
    CHECK(area_of(arrow) == doctest::Approx(20));
  }

  TEST_CASE("X3D: ccw='false' turns every face round") {
    CHECK(area_of(mesh_of("<IndexedFaceSet ccw='false' coordIndex='0 2 1'><Coordinate point='0 0 0 1 0 0 0 2 "
                          "0'/></IndexedFaceSet>")) == doctest::Approx(1));
  }

  TEST_CASE("X3D: colours per vertex and per face, by an index of their own or the coordinates'") {
    const std::string rest =
        "<Coordinate point='0 0 0 1 0 0 0 1 0 1 1 0'/><Color color='1 0 0 0 1 0 0 0 1 1 1 "
        "1'/></IndexedFaceSet>";
    const auto colours = [&](const std::string& fields) {
      return mesh_of("<IndexedFaceSet coordIndex='0 1 2 -1 2 1 3' " + fields + ">" + rest).faces;
    };
    const Rgb8 red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255}, white{255, 255, 255};
    CHECK(colours("")[1].colour[2] == white);
    CHECK(colours("colorIndex='3 3 3 -1 0 1 2'")[1].colour[1] == green);
    CHECK(colours("colorPerVertex='false'")[0].colour[2] == red);
    CHECK(colours("colorPerVertex='false'")[1].colour[0] == green);
    CHECK(colours("colorPerVertex='false' colorIndex='2 0'")[0].colour[0] == blue);
  }

  TEST_CASE("X3D: texture coordinates by an index of their own or the coordinates'") {
    const tests::Folder folder;
    folder.write("p.png", tests::png(4, 2, 1, 2, 3));
    const auto uv = [&](const std::string& fields) {
      return read(shape("<IndexedFaceSet coordIndex='0 1 2' " + fields +
                            "><Coordinate point='0 0 0 1 0 0 0 1 0'/>"
                            "<TextureCoordinate point='0 0 1 0 0 1'/></IndexedFaceSet>",
                        "<ImageTexture url='p.png'/>"),
                  folder.path())
          .scene.world.meshes[0]
          .faces[0]
          .uv[1];
    };
    CHECK(uv("") == glm::vec2(1, 1));
    CHECK(uv("texCoordIndex='1 2 0 -1'") == glm::vec2(0, 0));
  }

  TEST_CASE("X3D: faces are flat unless creaseAngle allows, and given normals are taken") {
    const std::string roof = "<Coordinate point='0 0 0 1 0 0 1 1 1 0 1 1 1 2 0 0 2 0'/>";
    const std::string lit = "<Material/>";
    const auto normals = [&](const std::string& fields) {
      return mesh_of("<IndexedFaceSet coordIndex='0 1 2 3 -1 3 2 4 5' " + fields + ">" + roof +
                         "</IndexedFaceSet>",
                     lit)
          .normals;
    };
    CHECK(normals("").empty());
    bool has_smooth_ridge = false;
    for (const glm::vec3& n : normals("creaseAngle='1.6'")) has_smooth_ridge |= is_near(n, {0, 0, 1});
    CHECK(has_smooth_ridge);
    for (const glm::vec3& n : normals("creaseAngle='1.5'")) CHECK(!is_near(n, {0, 0, 1}));
    const Mesh given = mesh_of(
        "<TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/><Normal vector='3 0 0 0 1 0 0 0 "
        "1'/></TriangleSet>",
        lit);
    REQUIRE(given.normals.size() == 3);
    CHECK(given.normals[0] == glm::vec3(1, 0, 0));
  }

  TEST_CASE("X3D: solids have the fields and sizes of the specification") {
    const auto high = [](const std::string& geometry) {
      load::Bounds bounds;
      for (const glm::vec3& p : mesh_of(geometry).positions) bounds.include(p);
      return bounds.high;
    };
    CHECK(is_near(high("<Box/>"), {1, 1, 1}));
    CHECK(is_near(high("<Box size='1 2 3'/>"), {0.5F, 1, 1.5F}));
    CHECK(is_near(high("<Sphere radius='3'/>"), {3, 3, 3}));
    CHECK(is_near(high("<Cone bottomRadius='2' height='6'/>"), {2, 3, 2}));
    CHECK(is_near(high("<Cylinder radius='2' height='6'/>"), {2, 3, 2}));
    CHECK(mesh_of("<Cylinder top='false' bottom='false'/>").faces.size() == 32);
    CHECK(mesh_of("<Cone bottom='false'/>").faces.size() == 32);
  }

  TEST_CASE("X3D: closed surfaces show their front only, open ones both sides, unless solid says otherwise") {
    const auto sides = [](const std::string& geometry) {
      return material_of(read(shape(geometry)).scene.world).double_sided;
    };
    const std::string points = "<Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet>";
    CHECK(sides("<TriangleSet>" + points));
    CHECK(!sides("<TriangleSet solid='true'>" + points));
    CHECK(!sides("<Sphere/>"));
    CHECK(sides("<Sphere solid='false'/>"));
  }

  TEST_CASE("X3D: lines and points in space are drawn") {
    const std::string points = "<Coordinate point='0 0 0 1 0 0 0 1 0'/>";
    CHECK(mesh_of("<PointSet>" + points + "</PointSet>").lines.size() == 3);
    CHECK(mesh_of("<LineSet vertexCount='3'>" + points + "</LineSet>").lines.size() == 2);
    const Mesh lines = mesh_of("<IndexedLineSet coordIndex='0 1 -1 1 2 0'>" + points + "</IndexedLineSet>",
                               "<Material emissiveColor='0 1 0'/>");
    REQUIRE(lines.lines.size() == 3);
    CHECK(lines.lines[0].colour[0] == Rgb8{0, 255, 0});
  }

  // ---- 2D

  TEST_CASE("X3D: 2D nodes are drawn in their emissive colour, never lit, from both sides") {
    const auto loaded = read(
        shape("<TriangleSet2D vertices='0 0 1 0 0 1 5 5 6 5 5 6'/>", "<Material emissiveColor='0 0 1'/>"));
    CHECK(loaded.scene.world.meshes[0].faces.size() == 2);
    CHECK(colour_of(loaded.scene.world) == Rgb8{0, 0, 255});
    CHECK(!material_of(loaded.scene.world).lit);
    CHECK(material_of(loaded.scene.world).double_sided);
  }

  TEST_CASE("X3D: filled 2D nodes have the areas of their definitions") {
    CHECK(area_of(mesh_of("<Rectangle2D size='4 3'/>")) == doctest::Approx(12));
    CHECK(area_of(mesh_of("<Disk2D outerRadius='2'/>")) == doctest::Approx(4 * 3.14159).epsilon(0.005));
    CHECK(area_of(mesh_of("<Disk2D innerRadius='1' outerRadius='2'/>")) ==
          doctest::Approx(3 * 3.14159).epsilon(0.005));
    CHECK(area_of(mesh_of("<ArcClose2D radius='2' startAngle='0' endAngle='1.5707963'/>")) ==
          doctest::Approx(3.14159).epsilon(0.005));
    CHECK(area_of(mesh_of("<ArcClose2D closureType='\"CHORD\"' radius='2'/>")) ==
          doctest::Approx(3.14159 - 2).epsilon(0.01));
  }

  TEST_CASE("X3D: drawn 2D nodes are segments of the length of their definitions, and points are dots") {
    const auto length = [](const std::string& geometry) {
      const Mesh mesh = mesh_of(geometry);
      double sum = 0;
      for (const auto& l : mesh.lines)
        sum += double{glm::length(mesh.positions[l.vertex[1]] - mesh.positions[l.vertex[0]])};
      return sum;
    };
    CHECK(length("<Circle2D radius='2'/>") == doctest::Approx(4 * 3.14159).epsilon(0.002));
    CHECK(length("<Arc2D radius='2' startAngle='3.1415927' endAngle='-1.5707963'/>") ==
          doctest::Approx(3.14159).epsilon(0.002));
    CHECK(length("<Polyline2D lineSegments='0 0 3 4 3 5'/>") == doctest::Approx(6));
    CHECK(mesh_of("<Polypoint2D point='1 2 3 4'/>").lines.size() == 2);
  }

  TEST_CASE("X3D: a scene of 2D nodes alone is a picture: y runs down from the Viewpoint's height") {
    const std::string flat = "<Viewpoint position='14 11 24'/>" + shape("<Polypoint2D point='3 4'/>");
    CHECK(is_near(placed(read(flat).scene.world, {3, 4, 0}), {3, 18, 0}));
    CHECK(is_near(placed(read(flat + shape("<Box/>")).scene.world, {3, 4, 0}), {3, 4, 0}));
  }

  // ---- camera

  TEST_CASE(
      "X3D: the first Viewpoint is the camera, through its Transform; fieldOfView is over the shorter side") {
    const auto loaded = read(
        "<Transform translation='0 5 0' scale='3 3 3'><Viewpoint position='1 0 0' orientation='0 1 0 "
        "1.5707963' "
        "fieldOfView='1.5707963'/></Transform><Viewpoint position='9 9 9'/>" +
        shape(triangle));
    const scene::Camera& camera = loaded.scene.world.camera;
    CHECK(is_near(camera.position, {3, 5, 0}));
    CHECK(is_near(glm::vec3(camera.orientation * glm::vec4(0, 0, -1, 0)), {-1, 0, 0}));
    CHECK(camera.tan_half_fov == doctest::Approx(1));
  }

  TEST_CASE("X3D: a small field of view keeps its digits") {
    const auto loaded = read("<Viewpoint fieldOfView='0.06'/>" + shape(triangle));
    CHECK(loaded.scene.world.camera.tan_half_fov == doctest::Approx(0.0300090).epsilon(1e-4));
  }

  TEST_CASE("X3D: without a Viewpoint the camera is at 0 0 10, or where it sees everything") {
    CHECK(is_near(read(shape(triangle)).scene.world.camera.position, {0, 0, 10}));
    const auto wide =
        read("<Transform translation='500 0 0'>" + shape("<Sphere radius='100'/>") + "</Transform>");
    const scene::Camera& camera = wide.scene.world.camera;
    CHECK(camera.position.x == doctest::Approx(500));
    CHECK(camera.position.z * camera.tan_half_fov > 100);
    const auto picture = read(shape("<Rectangle2D size='4 4'/>") + "<Transform translation='100 80 0'>" +
                              shape("<Disk2D/>") + "</Transform>");
    for (std::size_t i = 0; i < 2; ++i) {
      const glm::vec3 seen = placed(picture.scene.world, {0, 0, 0}, i) - picture.scene.world.camera.position;
      CHECK(std::abs(seen.y) < -seen.z * picture.scene.world.camera.tan_half_fov);
    }
  }
}

}  // namespace
