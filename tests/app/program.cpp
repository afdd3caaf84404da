// Every command of the program, run as a process.

#include "program.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "app/window/window_state.h"
#include "demos/demos.h"
#include "gpu/kernels.h"
#include "scene/knobs.h"

namespace {

using tests::contents, tests::Folder, tests::is_one_line, tests::mentions;

const std::string no_display = "-u DISPLAY -u WAYLAND_DISPLAY -u SDL_VIDEODRIVER -u XDG_RUNTIME_DIR";

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("--help and --version exit 0 and say it on stdout") {
    const Folder folder;
    const auto help = folder.otter("--help");
    CHECK(help.status == 0);
    CHECK(help.err.empty());
    for (const auto& command : app::commands) CHECK(mentions(help.out, command.name));
    CHECK(folder.otter("--version").out.starts_with("otter "));
  }

  TEST_CASE("OTTER_TARGET forces the instruction set, says so in --version, and changes no picture") {
    const Folder folder;
    std::string first;
    for (const std::string_view target : gpu::target_names()) {
      CAPTURE(target);
      const auto forced = "OTTER_TARGET=" + std::string(target);
      CHECK(mentions(folder.otter("--version", forced).out, "target " + std::string(target)));
      REQUIRE(folder.otter("render crates -o x.png", forced).status == 0);
      const auto picture = contents(folder.path / "x.png");
      CHECK_FALSE(picture.empty());
      if (first.empty()) first = picture;
      CHECK(picture == first);
    }
    const auto refused = folder.otter("list", "OTTER_TARGET=pdp11");
    CHECK(refused.status == 2);
    CHECK(is_one_line(refused.err));
    CHECK(mentions(refused.err, "OTTER_TARGET=pdp11: no such target; expected one of"));
    CHECK(refused.out.empty());
  }

  TEST_CASE("a frame of split polygons is recorded, and what that costs is said") {
    const Folder folder;
    const auto recorded = folder.otter("record cyclic -o x.psxgpu --visibility bsp");
    CHECK(recorded.status == 0);
    CHECK(mentions(recorded.out, "pieces of split polygons were recorded as triangles"));
    CHECK(mentions(recorded.out, "pixels differ from the live frames, by"));
    CHECK(folder.has("x.psxgpu"));
    CHECK(folder.otter("replay x.psxgpu --vram x.png").status == 0);
    CHECK(mentions(folder.otter("record crates -o y.psxgpu --visibility bsp").out,
                   "shows what the live frames show"));
  }

  TEST_CASE("an inspection that cannot be done as asked says so before it prints or writes anything") {
    const Folder folder;
    REQUIRE(folder.otter("record cyclic -o x.psxgpu --frames 2").status == 0);
    for (const auto* asked :
         {"x.psxgpu --frames 1..5 --json no.json", "x.psxgpu --frame 0 --heatmap no.png",
          "cyclic --pixel 320,0 --heatmap no.png", "cyclic --frames 3..2 --json no.json",
          "cyclic --antialias msaa-4 --heatmap no.png", "cyclic --resolution 2 --json no.json"}) {
      CAPTURE(asked);
      const auto ended = folder.otter(std::string("inspect ") + asked);
      CHECK(ended.status == 2);
      CHECK(ended.out.empty());
      CHECK(is_one_line(ended.err));
      CHECK_FALSE(folder.has("no.json"));
      CHECK_FALSE(folder.has("no.png"));
    }
  }

  TEST_CASE(
      "an inspection judges frames with sub-pixel corners, and calls unknown what a plain dump cannot tell") {
    const Folder folder;
    CHECK(mentions(folder.otter("inspect cyclic --position 256").out, "CyclicOverlap"));
    REQUIRE(folder.otter("record cyclic -o x.psxgpu").status == 0);
    const auto plain = folder.otter("inspect x.psxgpu --json x.json").out;
    CHECK(mentions(plain, "wrong pixels not available"));
    for (const auto* part : {"buckets: not available", "lint buckets: not available",
                             "lint links: not available", "lint dropped: not available"}) {
      CAPTURE(part);
      CHECK(mentions(plain, part));
    }
    CHECK(mentions(contents(folder.path / "x.json"), "\"buckets\": \"not available\""));
  }

  TEST_CASE("every command has a help with examples of itself") {
    const Folder folder;
    for (const auto& command : app::commands) {
      const auto help = folder.otter(std::string(command.name) + " --help");
      CAPTURE(std::string(command.name));
      CHECK(help.status == 0);
      CHECK(help.err.empty());
      CHECK(mentions(help.out, "Examples:\n  otter " + std::string(command.name)));
    }
  }

  TEST_CASE("every knob is an option of render and run, with its values in the help") {
    const Folder folder;
    for (const auto* command : {"render", "run"}) {
      const auto help = folder.otter(std::string(command) + " --help").out;
      for (const auto& knob : scene::knob_table()) {
        CAPTURE(std::string(knob.name));
        CHECK(mentions(help, "--" + std::string(knob.name)));
        CHECK((knob.values == "off|on" || mentions(help, knob.values)));
      }
    }
  }

  TEST_CASE("the help of run names every key of the window") {
    const Folder folder;
    CHECK(mentions(folder.otter("run --help").out, app::key_help()));
  }

  TEST_CASE("bad usage is one line on stderr that names what was wrong and what was expected, and exit 2") {
    const Folder folder;
    struct Row {
      const char* arguments;
      std::vector<std::string> said;
    };
    const std::vector<Row> rows{
        {"", {"no command", "render"}},
        {"paint", {"paint: no such command", "render"}},
        {"--paint", {"--paint"}},
        {"list --paint", {"--paint"}},
        {"list --names --long", {"--names", "--long"}},
        {"render", {"SCENE or FILE", "crates"}},
        {"render crates", {"--output"}},
        {"render nowhere -o x.png", {"nowhere: no such scene", "crates", "cyclic"}},
        {"render nowhere.obj -o x.png", {"nowhere.obj"}},
        {"render crates -o x.png --frame -1", {"--frame", "0"}},
        {"render crates -o x.png --frame 1.5", {"--frame"}},
        {"render crates -o x.png --frame", {"--frame"}},
        {"render crates -o x.png --size 300x200", {"--size 300x200", "320"}},
        {"render crates -o x.png --buckets 0", {"--buckets 0", "1..65536"}},
        {"render crates -o x.png --buckets many", {"--buckets many", "1..65536"}},
        {"render crates -o x.png --visibility magic", {"--visibility magic", "ot|sorted|bsp|zbuffer"}},
        {"render crates -o x.png --near nan", {"--near nan"}},
        {"render crates -o x.png --near 100 --far 50", {"--near 100", "--far 50"}},
        {"render crates -o x.png --magic", {"--magic"}},
        {"render crates glass -o x.png", {"glass"}},
        {"render --all crates", {"--all"}},
        {"render --all -o x.png", {"--all", "--directory"}},
        {"run nowhere", {"nowhere: no such scene", "crates"}},
        {"run --pace 3", {"--pace", "vsync"}},
        {"run --scale 0", {"--scale"}},
    };
    for (const auto& row : rows) {
      const auto outcome = folder.otter(row.arguments);
      CAPTURE(std::string(row.arguments));
      CAPTURE(outcome.err);
      CHECK(outcome.status == 2);
      CHECK(outcome.out.empty());
      CHECK(is_one_line(outcome.err));
      CHECK(outcome.err.starts_with("otter"));
      for (const auto& part : row.said) CHECK(mentions(outcome.err, part));
      CHECK_FALSE(folder.has("x.png"));
    }
  }

  TEST_CASE("list names every demo; --names names alone, one a line") {
    const Folder folder;
    const auto names = folder.otter("list --names");
    std::string expected;
    for (const auto& demo : demos::all()) expected.append(demo.name).append("\n");
    CHECK(names.status == 0);
    CHECK(names.out == expected);
    const auto listed = folder.otter("list").out;
    const auto all = folder.otter("list --long").out;
    for (const auto& demo : demos::all()) {
      CHECK(mentions(listed, demo.title));
      CHECK_FALSE(mentions(listed, demo.shows));
      CHECK(mentions(all, demo.shows));
    }
  }

  TEST_CASE("render writes the PNG of the mode's size and says so in one line") {
    const Folder folder;
    const auto rendered = folder.otter("render crates -o x.png --size 512x240");
    CHECK(rendered.status == 0);
    CHECK(rendered.err.empty());
    CHECK(is_one_line(rendered.out));
    CHECK(rendered.out.starts_with("x.png: crates frame 0, 512x240, "));
    const auto png = contents(folder.path / "x.png");
    REQUIRE(png.size() > 33);
    CHECK(png.substr(1, 3) == "PNG");
    CHECK(png.substr(16, 8) == std::string("\0\0\2\0\0\0\0\xf0", 8));  // IHDR: 512, 240
  }

  TEST_CASE("the same frame is the same file, another frame another") {
    const Folder folder;
    REQUIRE(folder.otter("render crates -o a.png --frame 7").status == 0);
    REQUIRE(folder.otter("render crates -o b.png --frame 7").status == 0);
    REQUIRE(folder.otter("render crates -o c.png --frame 8").status == 0);
    CHECK(contents(folder.path / "a.png") == contents(folder.path / "b.png"));
    CHECK(contents(folder.path / "a.png") != contents(folder.path / "c.png"));
  }

  TEST_CASE("a knob given twice counts as last given") {
    const Folder folder;
    REQUIRE(folder.otter("render crates -o a.png --size 640x480 --size 320x240").status == 0);
    REQUIRE(folder.otter("render crates -o b.png").status == 0);
    CHECK(contents(folder.path / "a.png") == contents(folder.path / "b.png"));
  }

  TEST_CASE("an output that cannot be written is exit 1, one line, and no file") {
    const Folder folder;
    const auto outcome = folder.otter("render crates -o nowhere/x.png");
    CHECK(outcome.status == 1);
    CHECK(is_one_line(outcome.err));
    CHECK(mentions(outcome.err, "nowhere/x.png: cannot be written"));
    CHECK_FALSE(folder.has("nowhere"));
  }

  TEST_CASE("a full standard output is exit 1") {
    const Folder folder;
    CHECK((std::system("'" OTTER_PROGRAM "' list > /dev/full 2> /dev/null") >> 8) == 1);
  }

  TEST_CASE("render --all writes every demo, a line each, without a display") {
    const Folder folder;
    const auto outcome = folder.otter("render --all --directory out/deep", no_display);
    CHECK(outcome.status == 0);
    for (const auto& demo : demos::all()) {
      CHECK(folder.has("out/deep/" + std::string(demo.name) + ".png"));
      CHECK(mentions(outcome.out, "out/deep/" + std::string(demo.name) + ".png: "));
    }
    CHECK(mentions(outcome.out, std::to_string(demos::all().size()) + " scenes rendered"));
  }

  TEST_CASE("a window without a display is exit 2 and one line") {
    const Folder folder;
    const auto outcome = folder.otter("run", no_display);
    CHECK(outcome.status == 2);
    CHECK(is_one_line(outcome.err));
    CHECK(mentions(outcome.err, "no display"));
  }

  TEST_CASE("the window runs on SDL's dummy driver and quits after --frames") {
    const Folder folder;
    for (const auto* arguments : {"", "--split", "--differences", "--visibility zbuffer --split --pace 60"}) {
      CAPTURE(std::string(arguments));
      const auto outcome = folder.otter("run --frames 5 " + std::string(arguments), "SDL_VIDEODRIVER=dummy");
      CHECK(outcome.status == 0);
      CHECK(outcome.err.empty());
      CHECK(outcome.out.empty());
    }
  }

  TEST_CASE("the window's last frame can be written: the picture at --scale and the status line") {
    const Folder folder;
    const auto outcome =
        folder.otter("run crates --frames 2 --scale 2 --screenshot w.png", "SDL_VIDEODRIVER=dummy");
    CHECK(outcome.status == 0);
    const auto png = contents(folder.path / "w.png");
    REQUIRE(png.size() > 33);
    CHECK(png.substr(16, 4) == std::string("\0\0\2\x80", 4));  // IHDR: 640 wide
  }

  TEST_CASE("every demo shows in the window without a word on stderr") {
    const Folder folder;
    for (const auto& demo : demos::all()) {
      CAPTURE(std::string(demo.name));
      const auto outcome =
          folder.otter("run " + std::string(demo.name) + " --frames 2", "SDL_VIDEODRIVER=dummy");
      CHECK(outcome.status == 0);
      CHECK(outcome.err.empty());
    }
  }
}
