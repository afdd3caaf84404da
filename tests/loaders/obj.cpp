#include "load/obj.h"

#include <doctest/doctest.h>

#include <chrono>
#include <sstream>

#include "files.h"
#include "load/faces.h"

namespace {

using scene::Blend, scene::Face, scene::Material, scene::Mesh, scene::none, scene::Rgb8;
using tests::refusal;

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

const Mesh& mesh_of(const load::LoadedScene& loaded) { return loaded.scene.world.meshes.at(0); }
const Material& material_of(const load::LoadedScene& loaded, const Face& face) {
  return loaded.scene.world.materials.at(face.material);
}

TEST_SUITE("loaders") {
  TEST_CASE("OBJ: a triangle has its three corners in order") {
    const auto loaded = tests::obj(corners + "f 1 2 3\n");
    REQUIRE(loaded);
    REQUIRE(mesh_of(*loaded).faces.size() == 1);
    const Face& f = mesh_of(*loaded).faces[0];
    CHECK(!f.is_quad());
    CHECK(mesh_of(*loaded).positions[f.vertex[1]] == glm::vec3(1, 0, 0));
    CHECK(mesh_of(*loaded).positions[f.vertex[2]] == glm::vec3(1, 1, 0));
    CHECK(loaded->warnings.empty());
  }

  TEST_CASE("OBJ: a flat convex quad stays a quad; a pentagon becomes three triangles") {
    CHECK(mesh_of(*tests::obj(corners + "f 1 2 3 4\n")).faces[0].is_quad());
    CHECK(mesh_of(*tests::obj(corners + "v -1 0.5 0\nf 1 2 3 4 5\n")).faces.size() == 3);
  }

  TEST_CASE("OBJ: texture coordinates run from the picture's bottom left, a Face's from its top left") {
    const auto loaded = tests::obj(corners + "vt 0 0\nvt 1 0\nvt 1 0.75\nf 1/1 2/2 3/3\n");
    const Face& f = mesh_of(*loaded).faces[0];
    CHECK(f.uv[0] == glm::vec2(0, 1));
    CHECK(f.uv[2] == glm::vec2(1, 0.25F));
  }

  TEST_CASE("OBJ: negative indices count from the end of what was read so far") {
    const auto loaded = tests::obj(corners + "f -4 -3 -2\n");
    REQUIRE(loaded);
    CHECK(mesh_of(*loaded).positions[mesh_of(*loaded).faces[0].vertex[0]] == glm::vec3(0, 0, 0));
  }

  TEST_CASE("OBJ: corners with normals share a vertex only where position and normal are equal") {
    const auto loaded = tests::obj(corners + "vn 0 0 2\nvn 1 0 0\nf 1//1 2//1 3//1\nf 1//1 3//1 4//2\n");
    const Mesh& mesh = mesh_of(*loaded);
    CHECK(mesh.positions.size() == 4);
    REQUIRE(mesh.normals.size() == 4);
    CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));
  }

  TEST_CASE("OBJ: when some faces have no normals, all are lit by their own") {
    const auto loaded = tests::obj(corners + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3 4\n");
    CHECK(mesh_of(*loaded).normals.empty());
  }

  TEST_CASE("OBJ: lines and points are drawn; a line through three vertices is two segments") {
    const auto loaded = tests::obj(corners + "l 1 2 3\np 4\n");
    REQUIRE(loaded);
    REQUIRE(mesh_of(*loaded).lines.size() == 3);
    const auto& dot = mesh_of(*loaded).lines[2];
    CHECK(dot.vertex[0] == dot.vertex[1]);
  }

  TEST_CASE("OBJ: vertices that nothing joins are drawn as points") {
    CHECK(mesh_of(*tests::obj(corners)).lines.size() == 4);
  }

  TEST_CASE("OBJ: vertices may carry a colour") {
    const auto loaded = tests::obj("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
    CHECK(mesh_of(*loaded).faces[0].colour[1] == Rgb8{0, 255, 0});
  }

  TEST_CASE(
      "OBJ: a back slash before the end of a line continues it, and lines after it keep their numbers") {
    CHECK(tests::obj(corners + "f 1 2 \\\n 3\n"));
    CHECK(refusal(tests::obj(corners + "f 1 2 \\\r\n 3\nf 9 1 2\n")).starts_with("model.obj:7: "));
  }

  TEST_CASE("OBJ: Kd is the colour of a face, and 1 is an unchanged texel under a picture") {
    const tests::Folder folder;
    folder.write("m.mtl", "newmtl plain\nKd 1 0.5 0\nnewmtl worn\nKd 1 1 1\nmap_Kd p.png\n");
    folder.write("p.png", tests::png(3, 5, 10, 20, 30));
    const auto loaded = tests::obj(
        "mtllib m.mtl\n" + corners + "usemtl plain\nf 1 2 3\nusemtl worn\nf 1 3 4\n", folder.path());
    REQUIRE(loaded);
    CHECK(loaded->warnings.empty());
    const Mesh& mesh = mesh_of(*loaded);
    CHECK(mesh.faces[0].colour[0] == Rgb8{255, 128, 0});
    CHECK(mesh.faces[1].colour[0] == Rgb8{128, 128, 128});
    CHECK(material_of(*loaded, mesh.faces[0]).texture == none);
    REQUIRE(material_of(*loaded, mesh.faces[1]).texture == 0);
    CHECK(loaded->scene.world.textures[0].width == 3);
    CHECK(loaded->scene.world.textures[0].repeats);
  }

  TEST_CASE("OBJ: a picture that several materials wear is read once; -clamp on makes it end at its edges") {
    const tests::Folder folder;
    folder.write("m.mtl",
                 "newmtl a\nmap_Kd p.png\nnewmtl b\nmap_Kd p.png\nnewmtl c\nmap_Kd -clamp on p.png\n");
    folder.write("p.png", tests::png(3, 5, 10, 20, 30));
    const auto loaded = tests::obj("mtllib m.mtl\n" + corners + "f 1 2 3\n", folder.path());
    REQUIRE(loaded->scene.world.textures.size() == 2);
    CHECK(loaded->scene.world.textures[0].repeats);
    CHECK(!loaded->scene.world.textures[1].repeats);
  }

  TEST_CASE("OBJ: -s and -o scale and move a picture") {
    const tests::Folder folder;
    folder.write("m.mtl", "newmtl a\nmap_Kd -s 2 4 1 -o 0.5 0 0 p.png\n");
    folder.write("p.png", tests::png(3, 5, 10, 20, 30));
    const auto loaded =
        tests::obj("mtllib m.mtl\nusemtl a\nvt 1 1\n" + corners + "f 1/1 2/1 3/1\n", folder.path());
    CHECK(mesh_of(*loaded).faces[0].uv[0] == glm::vec2(2.5F, -3));
  }

  TEST_CASE(
      "OBJ: any transparency, by d or by Tr, is the average blend; wholly transparent faces are not drawn") {
    const tests::Folder folder;
    folder.write("m.mtl", "newmtl d\nKd 1 1 1\nd 0.2\nnewmtl tr\nTr 0.1\nnewmtl gone\nd 0\n");
    const auto loaded = tests::obj(
        "mtllib m.mtl\n" + corners + "usemtl d\nf 1 2 3\nusemtl tr\nf 1 2 3\nusemtl gone\nf 1 2 3\n",
        folder.path());
    REQUIRE(mesh_of(*loaded).faces.size() == 2);
    for (const Face& f : mesh_of(*loaded).faces) CHECK(material_of(*loaded, f).blend == Blend::average);
  }

  TEST_CASE("OBJ: a picture under a see-through material has bit 15 set everywhere it is seen at all") {
    const tests::Folder folder;
    folder.write("m.mtl", "newmtl glass\nd 0.5\nmap_Kd p.png\n");
    folder.write("p.png", tests::png(2, 2, 9, 9, 9));
    const auto loaded = tests::obj("mtllib m.mtl\nusemtl glass\n" + corners + "f 1 2 3\n", folder.path());
    const Material& m = material_of(*loaded, mesh_of(*loaded).faces[0]);
    for (const auto& pixel : loaded->scene.world.textures[m.texture].pixels) CHECK(pixel.a == 128);
  }

  TEST_CASE("OBJ: faces of closed surfaces show their front only, all others both sides") {
    const std::string tetrahedron =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    const auto loaded = tests::obj(tetrahedron + "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 5 6 7\n");
    CHECK(!material_of(*loaded, mesh_of(*loaded).faces[0]).double_sided);
    CHECK(material_of(*loaded, mesh_of(*loaded).faces[4]).double_sided);
  }

  TEST_CASE("OBJ: the camera sees all of the model at every angle as it turns") {
    auto loaded = tests::obj("v -300 20 5\nv 700 20 5\nv 0 900 5\nv 0 0 -4000\nf 1 2 3\nf 1 2 4\n");
    scene::World& world = loaded->scene.world;
    for (int frame = 0; frame < 960; frame += 37) {
      loaded->scene.animate(world, frame / 60.0);
      for (const glm::vec3& p : mesh_of(*loaded).positions) {
        const glm::vec3 seen =
            glm::vec3(glm::inverse(world.camera.orientation) *
                      (world.instances[0].model * glm::vec4(p, 1) - glm::vec4(world.camera.position, 0)));
        CHECK(-seen.z > world.camera.near_z);
        CHECK(std::abs(seen.x) <= -seen.z * world.camera.tan_half_fov * 1.001F);
        CHECK(std::abs(seen.y) <= -seen.z * world.camera.tan_half_fov * 1.001F);
      }
    }
  }

  TEST_CASE("OBJ: a missing library, material or texture is one warning each, and the rest is drawn") {
    const tests::Folder folder;
    folder.write("m.mtl", "newmtl worn\nKd 0 1 0\nmap_Kd gone.png\n");
    auto loaded =
        tests::obj("mtllib none.mtl\n" + corners + "usemtl a\nf 1 2 3\nusemtl a\nf 1 2 3\n", folder.path());
    REQUIRE(loaded);
    REQUIRE(loaded->warnings.size() == 1);
    CHECK(loaded->warnings[0] ==
          "model.obj:1: material library 'none.mtl' cannot be read (there is no such file); its materials "
          "are drawn grey");
    loaded = tests::obj("mtllib m.mtl\n" + corners + "usemtl worn\nf 1 2 3\nusemtl other\nf 1 2 3\n",
                        folder.path());
    REQUIRE(loaded);
    REQUIRE(loaded->warnings.size() == 2);
    CHECK(loaded->warnings[0] == "model.obj: texture 'gone.png' is left out: there is no such file");
    CHECK(mesh_of(*loaded).faces[0].colour[0] == Rgb8{0, 255, 0});
  }

  TEST_CASE("OBJ: an index out of range is refused with its file and line") {
    CHECK(refusal(tests::obj(corners + "f 1 2 5\n")) == "model.obj:5: index 5, but there are 4 v so far");
    CHECK(refusal(tests::obj(corners + "f 1 2 0\n")) == "model.obj:5: index 0, but there are 4 v so far");
    CHECK(refusal(tests::obj(corners + "f 1 2 -5\n")) == "model.obj:5: index -5, but there are 4 v so far");
    CHECK(refusal(tests::obj(corners + "f 1/1 2/1 3/1\n")) ==
          "model.obj:5: index 1, but there are 0 vt so far");
    CHECK(refusal(tests::obj(corners + "f 1//7 2 3\n")) == "model.obj:5: index 7, but there are 0 vn so far");
    CHECK(refusal(tests::obj(corners + "f 1 2 99999999999\n")) == "model.obj:5: '99999999999' is no index");
    CHECK(refusal(tests::obj(corners + "f 1 2 x\n")) == "model.obj:5: 'x' is no index");
  }

  TEST_CASE("OBJ: coordinates that are no finite, moderate numbers are refused with their file and line") {
    CHECK(refusal(tests::obj("v 0 0 nan\nf 1 1 1\n")) == "model.obj:1: 'nan' is not a finite number");
    CHECK(refusal(tests::obj("v 0 -inf 0\nf 1 1 1\n")) == "model.obj:1: '-inf' is not a finite number");
    CHECK(refusal(tests::obj("v 1e30 0 0\nf 1 1 1\n")) == "model.obj:1: '1e30' is beyond the limit of 1e9");
    CHECK(refusal(tests::obj("v 1e999 0 0\nf 1 1 1\n")) == "model.obj:1: '1e999' is beyond the limit of 1e9");
    CHECK(refusal(tests::obj("v 0 0\nf 1 1 1\n")) == "model.obj:1: 2 numbers, expected 3");
    CHECK(refusal(tests::obj("v 0 0 0x\nf 1 1 1\n")) == "model.obj:1: '0x' is not a number");
  }

  TEST_CASE("OBJ: text without a face, binary bytes and UTF-16 are refused in one line") {
    CHECK(refusal(tests::obj("hello\n")).find("not one face") != std::string::npos);
    CHECK(refusal(tests::obj(std::string("\x7f"
                                         "ELF\0\0\0\1",
                                         8)))
              .find("zero byte") != std::string::npos);
    CHECK(refusal(tests::obj("\xfe\xff")).find("UTF-16") != std::string::npos);
  }

  TEST_CASE("OBJ: a file of ten million faces is refused at the limit") {
    std::string bytes = corners;
    for (int i = 0; i < 10'000'000; ++i) bytes += "f 1 2 3\n";
    const auto begin = std::chrono::steady_clock::now();
    CHECK(refusal(tests::obj(bytes)) == "model.obj:1000003: more than the limit of 1,000,000 faces");
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::seconds(10));
  }

  TEST_CASE("OBJ: a model of 70,000 faces is read whole") {
    std::ostringstream text;
    for (int y = 0; y <= 200; ++y) {
      for (int x = 0; x <= 350; ++x) text << "v " << x << ' ' << y << ' ' << (x * y % 7) * 0.25 << "\n";
    }
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 350; ++x) {
        const int a = y * 351 + x + 1;
        text << "f " << a << ' ' << a + 1 << ' ' << a + 352 << ' ' << a + 351 << "\n";
      }
    }
    const auto loaded = tests::obj(text.str());
    REQUIRE(loaded);
    CHECK(mesh_of(*loaded).faces.size() >= 70'000);
    CHECK(mesh_of(*loaded).positions.size() == 351 * 201);
  }

  TEST_CASE("scene files: missing, empty, a folder and an unknown kind are refused in one line") {
    const tests::Folder folder;
    CHECK(refusal(load::load(folder.path() / "none.obj")).find("no such file") != std::string::npos);
    CHECK(refusal(load::load(folder.write("e.obj", ""))).find("empty") != std::string::npos);
    CHECK(refusal(load::load(folder.write("m.stl", "solid"))).find("OBJ (.obj) or X3D (.x3d)") !=
          std::string::npos);
    std::filesystem::create_directory(folder.path() / "d.obj");
    CHECK(refusal(load::load(folder.path() / "d.obj")).find("not a regular file") != std::string::npos);
  }

  TEST_CASE("scene files: the scene bears its file's name, and the extension may be in capitals") {
    const tests::Folder folder;
    const auto loaded = load::load(folder.write("Model.OBJ", corners + "f 1 2 3\n"));
    REQUIRE(loaded);
    CHECK(loaded->scene.name == "Model.OBJ");
  }
}

}  // namespace
