// What a command may write: never over what it reads, never twice, never over what its owner protects.

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/message.h"
#include "base/same_file.h"
#include "base/write_file.h"
#include "program.h"

namespace {

namespace fs = std::filesystem;
using tests::Folder;

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

mode_t mode_of(const fs::path& path) {
  struct stat there {};
  return stat(path.c_str(), &there) == 0 ? there.st_mode & 07777 : 0;
}

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("two options that name one file are refused, by whatever names, and nothing is written") {
    const Folder folder;
    folder.put("old.png", "old");
    fs::create_symlink("old.png", folder.path / "link.png");
    for (const std::string words :
         {"inspect crates --heatmap a.png --ids a.png", "inspect crates --heatmap a.png --ids ./a.png",
          "inspect crates --json old.png --overdraw link.png"}) {
      CAPTURE(words);
      const auto ended = folder.otter(words);
      CHECK(ended.status == 2);
      CHECK(tests::is_one_line(ended.err));
      CHECK(tests::mentions(ended.err, "is the same one"));
      CHECK_FALSE(folder.has("a.png"));
      CHECK(tests::contents(folder.path / "old.png") == "old");
    }
  }

  TEST_CASE(
      "an output that is the input is refused, also by another link to it or as a file the input names") {
    const Folder folder;
    folder.put("m.obj", std::string("mtllib m.mtl\nusemtl a\n") + triangle);
    folder.put("m.mtl", "newmtl a\nKd 1 0 0\n");
    fs::create_symlink("m.obj", folder.path / "soft.png");
    fs::create_hard_link(folder.path / "m.obj", folder.path / "hard.png");
    for (const std::string output : {"m.obj", "soft.png", "hard.png", "m.mtl"}) {
      CAPTURE(output);
      const auto before = tests::contents(folder.path / output);
      const auto ended = folder.otter("render m.obj -o " + output);
      CHECK(ended.status == 2);
      CHECK(tests::is_one_line(ended.err));
      CHECK(tests::contents(folder.path / output) == before);
    }
    CHECK(folder.otter("render m.obj -o picture.png").status == 0);
  }

  TEST_CASE("a file that is replaced keeps its mode") {
    const Folder folder;
    folder.put("x.png", "old");
    fs::permissions(folder.path / "x.png", static_cast<fs::perms>(0640));
    REQUIRE(folder.otter("render crates -o x.png").status == 0);
    CHECK(mode_of(folder.path / "x.png") == 0640);
    CHECK(tests::contents(folder.path / "x.png") != "old");
  }

  TEST_CASE("a read-only file and a hard link are not replaced, and a line says why") {
    const Folder folder;
    folder.put("fixed.png", "fixed");
    fs::permissions(folder.path / "fixed.png", static_cast<fs::perms>(0444));
    folder.put("one.png", "shared");
    fs::create_hard_link(folder.path / "one.png", folder.path / "two.png");
    const auto fixed = folder.otter("render crates -o fixed.png"),
               shared = folder.otter("render crates -o one.png");
    CHECK(fixed.status == 1);
    CHECK(tests::mentions(fixed.err, "read-only"));
    CHECK(tests::contents(folder.path / "fixed.png") == "fixed");
    CHECK(shared.status == 1);
    CHECK(tests::mentions(shared.err, "hard link"));
    CHECK(tests::contents(folder.path / "two.png") == "shared");
  }

  TEST_CASE("help that cannot be written is exit 1") {
    const Folder folder;
    for (const std::string words : {"--help", "render --help", "--version"}) {
      CAPTURE(words);
      CHECK((std::system(("'" OTTER_PROGRAM "' " + words + " > /dev/full 2> /dev/null").c_str()) >> 8) == 1);
    }
  }

  TEST_CASE("control characters of a file's name are escaped in messages, which stay one line") {
    const Folder folder;
    const auto ended = folder.otter("render 'evil\x1b[31m\nname.obj' -o x.png");
    CHECK(ended.status == 2);
    CHECK(tests::is_one_line(ended.err));
    CHECK(ended.err.find('\x1b') == std::string::npos);
  }

  TEST_CASE("whatever names a scene's warnings come from, a hundred are told at most") {
    const Folder folder;
    std::string scene = "<X3D><Scene>";
    for (int i = 0; i < 400; ++i) {
      scene += "<Shape><Appearance><ImageTexture url='\"no" + std::to_string(i) +
               ".png\"'/></Appearance><Box/></Shape>";
    }
    folder.put("many.x3d", scene + "</Scene></X3D>");
    const auto ended = folder.otter("render many.x3d -o x.png");
    CHECK(ended.status == 0);
    CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') <= base::most_warnings + 1);
  }

  TEST_CASE("a file that may not be read is told as that, not as one that is not there") {
    if (geteuid() == 0) return;  // nothing is forbidden to root
    const Folder folder;
    folder.put("m.obj", triangle);
    fs::permissions(folder.path / "m.obj", fs::perms::none);
    CHECK(tests::mentions(folder.otter("render m.obj -o x.png").err, "Permission denied"));
  }
}

TEST_SUITE("base") {
  TEST_CASE("Printable text has no control character left, in ASCII or in UTF-8, and keeps all others") {
    CHECK(base::printable("a\nb\tc\rd\x1b[0m\x7f") == "a\\nb\\tc\\rd\\x1b[0m\\x7f");
    CHECK(base::printable("caf\xc3\xa9 \xc2\x9b!") == "caf\xc3\xa9 \\x9b!");
  }

  TEST_CASE("Outputs in a folder that is missing are compared by their paths") {
    const std::vector<base::NamedFile> same{{"--a", "/no/such/../such/x"}, {"--b", "/no/such/x"}},
        other{{"--a", "/no/x"}, {"--b", "/no/y"}};
    CHECK_FALSE(base::check_outputs(same, {}));
    CHECK(base::check_outputs(other, {}));
  }

  TEST_CASE("Devices and standard streams may be named twice") {
    const std::vector<base::NamedFile> outputs{
        {"--a", "/dev/null"}, {"--b", "/dev/null"}, {"--c", "-"}, {"--d", "-"}};
    CHECK(base::check_outputs(outputs, {}));
  }

  TEST_CASE("A file whose writer gives up is not there, and the old one is whole") {
    const Folder folder;
    folder.put("x", "old");
    const auto done = base::write_file(folder.path / "x", [](std::FILE* file) -> base::Result<void> {
      std::fputs("half", file);
      return base::fail("no more");
    });
    REQUIRE_FALSE(done);
    CHECK(done.error().text == "no more");
    CHECK(tests::contents(folder.path / "x") == "old");
  }
}
