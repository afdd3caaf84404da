// Work in proportion to the bytes: what a file names again and again is read once, and what it may look at is
// counted.

#include <doctest/doctest.h>

#include <array>
#include <random>

#include "base/message.h"
#include "files.h"
#include "load/distinct.h"
#include "load/obj.h"
#include "load/pictures.h"
#include "load/x3d/x3d.h"

namespace {

using tests::refusal;

std::string repeated(int count, const std::string& text) {
  std::string all;
  all.reserve(static_cast<std::size_t>(count) * text.size());
  for (int i = 0; i < count; ++i) all += text;
  return all;
}
base::Result<load::LoadedScene> x3d(const std::string& inside) {
  return load::parse_x3d("<X3D><Scene>" + inside + "</Scene></X3D>", {"s.x3d", "."});
}

/// A key that counts how often keys are compared.
struct Counted {
  std::uint64_t value;
  static inline std::uint64_t comparisons = 0;
  bool operator<(const Counted& other) const {
    ++comparisons;
    return value < other.value;
  }
};

}  // namespace

TEST_SUITE("loaders") {
  TEST_CASE("Equal keys are found with n log n comparisons, whatever the keys are") {
    const auto comparisons = [](std::size_t n, auto&& key) {
      std::vector<Counted> keys;
      for (std::size_t i = 0; i < n; ++i) keys.push_back({key(i)});
      Counted::comparisons = 0;
      (void)load::number_distinct(keys);
      return static_cast<double>(Counted::comparisons);
    };
    const auto floods = [](std::size_t i) { return std::uint64_t{i} << 32U | (126271 - i * 34021 % 126271); };
    const auto same = [](std::size_t) { return std::uint64_t{7}; };
    const auto rising = [](std::size_t i) { return std::uint64_t{i}; };
    CHECK(comparisons(40'000, floods) < 2.3 * comparisons(20'000, floods));
    CHECK(comparisons(40'000, same) < 2.3 * comparisons(20'000, same));
    CHECK(comparisons(40'000, rising) < 2.3 * comparisons(20'000, rising));
    CHECK(comparisons(20'000, floods) < 20'000 * 60.0);
  }

  TEST_CASE("Distinct keys are numbered by their first appearance") {
    const auto distinct = load::number_distinct(std::vector<int>{9, 4, 9, 1, 4, 4, 9});
    CHECK(distinct.number == std::vector<std::uint32_t>{0, 1, 0, 2, 1, 1, 0});
    CHECK(distinct.first == std::vector<std::uint32_t>{0, 1, 3});
    std::mt19937 random(3);
    std::vector<std::uint32_t> keys(3000);
    for (auto& key : keys) key = static_cast<std::uint32_t>(random() % 500);
    const auto many = load::number_distinct(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      REQUIRE(keys[many.first[many.number[i]]] == keys[i]);
      REQUIRE(many.first[many.number[i]] <= i);
    }
    for (std::size_t n = 1; n < many.first.size(); ++n) CHECK(many.first[n - 1] < many.first[n]);
  }

  TEST_CASE("X3D: a Switch, a Shape, a light and a Transform that are used again are looked at once") {
    // Each node holds n things and is used n times: looked at each time, that is n * n.
    for (const int n : {3000, 6000}) {
      CAPTURE(n);
      const std::string many = std::to_string(n - 1);
      CHECK(refusal(x3d("<Switch DEF='S' whichChoice='" + many + "'>" + repeated(n, "<Shape><Box/></Shape>") +
                        "</Switch>" + repeated(n, "<Switch USE='S'/>")))
                .empty());
      CHECK(refusal(x3d("<Shape DEF='S'>" + repeated(n, "<a/>") + "<Disk2D/></Shape>" +
                        repeated(n, "<Shape USE='S'/>")))
                .empty());
      CHECK(refusal(x3d("<DirectionalLight DEF='L' " + repeated(n, "a='' ") + "/>" +
                        repeated(n, "<DirectionalLight USE='L'/>") + "<Shape><Box/></Shape>"))
                .find("looks at nodes") == std::string::npos);
    }
  }

  TEST_CASE("X3D: looks are counted, and there are no more of them than a hundred million") {
    std::vector<std::string> warnings;
    const load::Source source{"s.x3d", "."};
    const std::string text = "<A b='' c='' d='1 2 3'/>";
    pugi::xml_document document;
    document.load_string(text.c_str());
    load::x3d::Context context(text, source, warnings);
    const auto node = document.first_child();
    const auto spent = [&](auto&& use) {
      const auto before = context.looks();
      use();
      return context.looks() - before;
    };
    CHECK(spent([&] { (void)context.attribute(node, "d"); }) == 3);
    CHECK(spent([&] { (void)context.attribute(node, "none"); }) == 3);
    CHECK(spent([&] { (void)context.attribute(node, "b"); }) == 1);
    CHECK(context.look(node, 99'000'000));
    CHECK_FALSE(context.look(node, 2'000'000));
    REQUIRE(context.error());
    CHECK(context.error()->text.find("100,000,000 looks") != std::string::npos);
  }

  TEST_CASE(
      "X3D: a node of a thousand attributes that is used a hundred thousand times is refused, not stared "
      "at") {
    const auto many = repeated(4000, "a='' ");
    CHECK(refusal(x3d("<Shape><Box DEF='G' " + many + "/></Shape>" +
                      repeated(20000, "<Shape><Box USE='G'/></Shape>")))
              .find("100,000,000 looks") != std::string::npos);
    // A material is read once.
    CHECK(refusal(x3d("<Shape><Appearance><Material DEF='M' " + many + "/></Appearance><Box/></Shape>" +
                      repeated(2000, "<Shape><Appearance><Material USE='M'/></Appearance><Box/></Shape>")))
              .empty());
  }

  TEST_CASE("MTL: of many definitions of one name the first counts; unknown lines leave nothing behind") {
    std::string text = "newmtl a\nKd 1 0 0\n";
    for (int i = 0; i < 50'000; ++i) text += "newmtl a\nKd 0 1 0\nsomething else\n";
    text += "newmtl b\nkd 1 1 1\nKd 0 0 1\n";
    load::LoadedScene scene;
    const load::Source source{"m.obj", "."};
    load::Pictures pictures(source, scene);
    std::map<std::string, load::ObjMaterial, std::less<>> materials;
    load::parse_mtl(text, pictures, materials);
    REQUIRE(materials.size() == 2);
    CHECK(materials.at("a").diffuse == glm::vec3(1, 0, 0));
    CHECK(materials.at("b").diffuse == glm::vec3(0, 0, 1));
  }

  TEST_CASE("MTL: no more materials are kept than the limit, and their lines are read with any line end") {
    std::string text;
    for (int i = 0; i < 10'000; ++i) text += "newmtl m" + std::to_string(i) + "\r\nKd 0 0 1\r\n";
    load::LoadedScene scene;
    const load::Source source{"m.obj", "."};
    load::Pictures pictures(source, scene);
    std::map<std::string, load::ObjMaterial, std::less<>> materials;
    load::parse_mtl(text, pictures, materials);
    CHECK(materials.size() == load::limits::materials);
    CHECK(materials.at("m7").diffuse == glm::vec3(0, 0, 1));
  }

  TEST_CASE("A picture is read once by whatever names it goes, also when it is damaged") {
    const tests::Folder folder;
    folder.write("good.png", tests::png(4, 4, 255, 0, 0));
    folder.write("bad.png", tests::png(4, 4, 255, 0, 0).substr(0, 60));
    load::LoadedScene scene;
    const load::Source source{"s.x3d", folder.path()};
    load::Pictures pictures(source, scene);
    const auto first = pictures.load("good.png", true);
    REQUIRE(first != scene::none);
    CHECK(pictures.load("./good.png", true) == first);
    CHECK(pictures.load(".//./good.png", true) == first);
    CHECK(scene.scene.world.textures.size() == 1);
    for (const char* name : {"bad.png", "./bad.png", "././bad.png"})
      CHECK(pictures.load(name, true) == scene::none);
    CHECK(scene.warnings.size() == 1);
    CHECK(scene.files.size() == 2);
  }

  TEST_CASE("OBJ: a library named by sixty-four spellings is read once") {
    const tests::Folder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 0 0\n");
    std::string text;
    for (int i = 0; i < 64; ++i) text += "mtllib " + repeated(i, "./") + "m.mtl\n";
    const auto loaded = tests::obj(text + "usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", folder.path());
    REQUIRE(loaded);
    CHECK(loaded->files.size() == 1);
    CHECK(loaded->warnings.empty());
  }

  TEST_CASE("No more than a hundred warnings are kept, of pictures too") {
    load::LoadedScene scene;
    const load::Source source{"s.x3d", "."};
    load::Pictures pictures(source, scene);
    for (int i = 0; i < 300; ++i) (void)pictures.load("no" + std::to_string(i) + ".png", true);
    CHECK(scene.warnings.size() == base::most_warnings);
  }

  TEST_CASE(
      "A picture far larger than any page is kept as exact means of its texels, and its own size is known") {
    // 4,100 x 2 texels: more than 4,096 across, so means of 8 x 8 (here 8 x 2) are kept.
    const auto picture = load::decode_picture(tests::png(4100, 2, 200, 100, 50));
    REQUIRE(picture);
    CHECK(picture->width == 513);
    CHECK(picture->height == 1);
    CHECK(picture->file_width == 4100);
    CHECK(picture->file_height == 2);
    CHECK(picture->pixels.front() == scene::Rgba8{200, 100, 50, 255});
    CHECK(picture->pixels.back() == scene::Rgba8{200, 100, 50, 255});
  }

  TEST_CASE("A polygon of a hundred thousand corners costs what its budget allows and no more") {
    std::string text;
    for (int i = 0; i < 100'000; ++i)
      text += "v " + std::to_string(i) + (i % 2 == 0 ? " 0 0\n" : " 1000 0\n");
    text += "f";
    for (int i = 1; i <= 100'000; ++i) text += " " + std::to_string(i);
    const auto loaded = tests::obj(text + "\n");
    REQUIRE(loaded);
    CHECK(loaded->scene.world.meshes[0].faces.size() == 99'998);
  }
}
