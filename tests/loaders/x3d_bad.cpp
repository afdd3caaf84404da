#include <doctest/doctest.h>

#include <chrono>

#include "files.h"

namespace {

using tests::refusal;

base::Result<load::LoadedScene> whole(const std::string& bytes) {
  return load::parse_x3d(bytes, {"s.x3d", "."});
}
base::Result<load::LoadedScene> parse(const std::string& inside) {
  return whole("<X3D><Scene>\n" + inside + "\n</Scene></X3D>");
}
std::string shape(const std::string& geometry) { return "<Shape>" + geometry + "</Shape>"; }

TEST_SUITE("loaders") {
  TEST_CASE("X3D: what is not well-formed XML is refused at its line; other XML and binary bytes too") {
    CHECK(refusal(whole("<X3D>\n<Scene>\n<Shape></X3D>")).starts_with("s.x3d:3: not well-formed XML"));
    CHECK(refusal(whole("<svg/>")) == "s.x3d: no <X3D> element; is it an X3D scene in the XML encoding?");
    CHECK(refusal(whole("<X3D/>")) == "s.x3d: no <Scene> in its <X3D>");
    CHECK(refusal(whole("")).starts_with("s.x3d"));
    CHECK(refusal(whole(std::string("\x7f"
                                    "ELF\0\0\1\2",
                                    8)))
              .starts_with("s.x3d"));
  }

  TEST_CASE("X3D: every truncation of a scene is refused or read, and nothing else") {
    const std::string scene =
        "<X3D><Scene><Transform DEF='a' rotation='0 1 0 2'><Shape><IndexedFaceSet coordIndex='0 1 2 -1'>"
        "<Coordinate point='0 0 0 1 0 0 0 1 0'/></IndexedFaceSet></Shape></Transform></Scene></X3D>";
    for (std::size_t size = 0; size < scene.size(); ++size)
      CHECK(!refusal(whole(scene.substr(0, size))).empty());
  }

  TEST_CASE("X3D: numbers that are none, not finite or beyond 1e9 are refused with file, line and node") {
    const auto point = [](const std::string& text) {
      return refusal(parse(shape("<TriangleSet>\n<Coordinate point='" + text + "'/></TriangleSet>")));
    };
    CHECK(point("0 0 nan") == "s.x3d:3: Coordinate: point: 'nan' is not a finite number");
    CHECK(point("0 inf 0") == "s.x3d:3: Coordinate: point: 'inf' is not a finite number");
    CHECK(point("1e30 0 0") == "s.x3d:3: Coordinate: point: '1e30' is beyond the limit of 1e9");
    CHECK(point("0 0 zero") == "s.x3d:3: Coordinate: point: 'zero' is not a number");
    CHECK(point("0 0") == "s.x3d:3: Coordinate: point has 2 numbers, expected triples");
    CHECK(refusal(parse("<Transform translation='1 2'/>")) ==
          "s.x3d:2: Transform: translation has 2 numbers, expected 3");
    CHECK(refusal(parse("<Transform rotation='1 2 3'/>")) ==
          "s.x3d:2: Transform: rotation has 3 numbers, expected 4");
    CHECK(refusal(parse("<NavigationInfo headlight='maybe'/>")) ==
          "s.x3d:2: NavigationInfo: headlight is 'maybe', expected true or false");
    CHECK(refusal(parse("<Viewpoint fieldOfView='4'/>")) ==
          "s.x3d:2: Viewpoint: fieldOfView is not between 0 and pi");
    CHECK(refusal(parse(shape("<Sphere radius='-1'/>"))) == "s.x3d:2: Sphere: radius is below 0");
  }

  TEST_CASE("X3D: indices out of range are refused with file, line and field") {
    const std::string points = "<Coordinate point='0 0 0 1 0 0 0 1 0'/>";
    const auto faces = [&](const std::string& fields, const std::string& more = "") {
      return refusal(parse(shape("<IndexedFaceSet " + fields + ">" + points + more + "</IndexedFaceSet>")));
    };
    CHECK(faces("coordIndex='0 1 3'") == "s.x3d:2: IndexedFaceSet: coordIndex: index 3, but there are 3");
    CHECK(faces("coordIndex='0 1 -2'") == "s.x3d:2: IndexedFaceSet: coordIndex: index -2, but there are 3");
    CHECK(faces("coordIndex='0 1 2147483647'").find("index 2147483647") != std::string::npos);
    CHECK(faces("coordIndex='0 1 2.5'").find("'2.5' is not a whole number") != std::string::npos);
    CHECK(faces("coordIndex='0 1 2' colorIndex='0 1'", "<Color color='1 1 1 0 0 0'/>")
              .find("colorIndex is shorter") != std::string::npos);
    CHECK(faces("coordIndex='0 1 2'", "<Color color='1 1 1 0 0 0'/>")
              .find("colorIndex: index 2, but there are 2") != std::string::npos);
    CHECK(faces("coordIndex='0 1 2' texCoordIndex='0 0 9'", "<TextureCoordinate point='0 0'/>")
              .find("index 9") != std::string::npos);
    CHECK(refusal(parse(shape("<TriangleStripSet stripCount='4'>" + points + "</TriangleStripSet>")))
              .find("4 of 3 points left") != std::string::npos);
    CHECK(refusal(
              parse(shape("<IndexedTriangleStripSet index='0 1 7'>" + points + "</IndexedTriangleStripSet>")))
              .find("index 7") != std::string::npos);
  }

  TEST_CASE("X3D: a geometry without points, or with too few, draws nothing and is no error") {
    CHECK(parse(shape("<TriangleSet/>")));
    CHECK(parse(shape("<IndexedFaceSet coordIndex='0 1 2'/>")));
    CHECK(parse(shape("<TriangleSet><Coordinate point='0 0 0'/></TriangleSet>")));
    CHECK(parse(shape("<IndexedFaceSet coordIndex='0 0'><Coordinate point='0 0 0'/></IndexedFaceSet>")));
    CHECK(parse(shape("<TriangleSet2D vertices='1 2'/>")));
    CHECK(parse("<Shape/>"));
  }

  TEST_CASE("X3D: groups nested beyond the limit are refused, not recursed into") {
    std::string open, close;
    for (int i = 0; i < 200'000; ++i) {
      open += "<Group>";
      close += "</Group>";
    }
    CHECK(refusal(parse(open + close)).find("nested deeper than the limit of 128") != std::string::npos);
  }

  TEST_CASE("X3D: USE upon USE, ten to the ninth shapes from ten lines, is refused in bounded time") {
    std::string bomb = "<Group DEF='G0'><Shape><Sphere/></Shape></Group>";
    for (int i = 1; i < 10; ++i) {
      bomb += "<Group DEF='G" + std::to_string(i) + "'>";
      for (int k = 0; k < 10; ++k) bomb += "<Group USE='G" + std::to_string(i - 1) + "'/>";
      bomb += "</Group>";
    }
    const auto begin = std::chrono::steady_clock::now();
    CHECK(refusal(parse(bomb)).find("over the limit of") != std::string::npos);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(20));
  }

  TEST_CASE("X3D: more elements than the limit are refused before a tree is built") {
    std::string many;
    for (int i = 0; i < 2'100'000; ++i) many += "<A/>";
    CHECK(refusal(parse(many)).find("1,000,000 XML elements") != std::string::npos);
  }

  TEST_CASE("X3D: custom entities are not expanded") {
    CHECK(
        whole("<!DOCTYPE X3D [<!ENTITY a 'aaaaaaaa'><!ENTITY b '&a;&a;&a;'>]><X3D><Scene><Group "
              "DEF='&b;'/></Scene></X3D>"));
  }

  TEST_CASE("X3D: names with control characters do not break the one line of a warning") {
    const auto loaded = parse("<Shape USE='a&#10;b'/>");
    REQUIRE(loaded);
    REQUIRE(!loaded->warnings.empty());
    for (const std::string& line : loaded->warnings) CHECK(line.find('\n') == std::string::npos);
  }
}

}  // namespace
