// Programs as their users meet them: the demos, run as processes.

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "dump/dump.h"
#include "tests/app/program.h"

TEST_SUITE("sdk") {
  namespace {

  /// Runs a program of the build's bin folder.
  struct Programs : tests::Folder {
    [[nodiscard]] tests::Outcome run(const std::string& name, const std::string& arguments) const {
      return shell("'" SDK_PROGRAMS "/" + name + "' " + arguments);
    }
    [[nodiscard]] tests::Outcome shell(const std::string& command) const {
      const auto line = "cd '" + path.string() + "' && " + command + " > .out 2> .err < /dev/null";
      const int status = std::system(line.c_str());
      return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, tests::contents(path / ".out"),
              tests::contents(path / ".err")};
    }
    [[nodiscard]] nlohmann::json report(const std::string& name, const std::string& arguments) const {
      const auto outcome = run(name, arguments + " --json -");
      REQUIRE(outcome.status == 0);
      return nlohmann::json::parse(outcome.out);
    }
    [[nodiscard]] std::string vram(const std::string& name, const std::string& arguments) const {
      REQUIRE(run(name, arguments + " --vram vram.bin").status == 0);
      return tests::contents(path / "vram.bin");
    }
    [[nodiscard]] dump::Dump recorded(const std::string& name, const std::string& arguments) const {
      REQUIRE(run(name, arguments + " --record r.psxgpu").status == 0);
      const auto bytes = tests::contents(path / "r.psxgpu");
      auto parsed = dump::parse_dump(std::as_bytes(std::span(bytes)));
      REQUIRE(parsed);
      return std::move(*parsed);
    }
  };

  std::vector<std::string> kinds(const nlohmann::json& report) {
    std::vector<std::string> all;
    for (const auto& item : report["lint"]) all.push_back(item["kind"]);
    return all;
  }

  }  // namespace

  TEST_CASE_FIXTURE(Programs, "every demo draws its frames and ends with 0") {
    for (const char* name : {"sdk_hello", "sdk_cube", "sdk_corridor", "sdk_glass", "sdk_too_far"}) {
      CAPTURE(name);
      const auto outcome = run(name, "--frames 4 -o frame.png");
      CHECK(outcome.status == 0);
      CHECK(has("frame.png"));
      CHECK(tests::mentions(outcome.err, "4 frames"));
    }
  }

  TEST_CASE_FIXTURE(Programs, "two runs are equal to the bit") {
    CHECK(vram("sdk_glass", "--frames 20") == vram("sdk_glass", "--frames 20"));
  }

  TEST_CASE_FIXTURE(Programs, "demos without a planted mistake have no finding") {
    for (const char* name : {"sdk_hello", "sdk_cube", "sdk_corridor", "sdk_glass"}) {
      CAPTURE(name);
      CHECK(kinds(report(name, "--frames 40")).empty());
    }
  }

  TEST_CASE_FIXTURE(Programs, "a bucket equal to the table's length is named with the line that links it") {
    const auto lint = report("sdk_too_far", "--frames 40")["lint"];
    REQUIRE(lint.size() >= 1);
    bool found = false;
    for (const auto& item : lint) {
      if (item["kind"] != "bucket-range") continue;
      found = true;
      CHECK(std::string(item["at"]).starts_with("too_far.c:"));
      CHECK(tests::mentions(item["text"], "entry 256 of the table"));
      CHECK(tests::mentions(item["text"], "which has 256"));
    }
    CHECK(found);
  }

  TEST_CASE_FIXTURE(Programs, "every polygon of the demos has depth by the address it was stored at") {
    for (const char* name : {"sdk_cube", "sdk_corridor", "sdk_glass"}) {
      CAPTURE(name);
      const auto depth = report(name, "--frames 30")["depth"];
      CHECK(depth["polygons"] > 0);
      CHECK(depth["by_address"] == depth["polygons"]);
    }
  }

  TEST_CASE_FIXTURE(Programs, "drawn near to far through a z-buffer, the corridor is what its table draws") {
    const auto forward = vram("sdk_corridor", "--frames 31 --pad 5:UP,20:RIGHT");
    CHECK(vram("sdk_corridor", "--frames 31 --pad 5:UP,20:RIGHT --reversed --visibility zbuffer") == forward);
    // The proof is worth something: without the z-buffer the reversed list draws another picture.
    CHECK(vram("sdk_corridor", "--frames 31 --pad 5:UP,20:RIGHT --reversed") != forward);
  }

  TEST_CASE_FIXTURE(Programs, "the pad script moves the corridor, and its log replays the run") {
    const auto still = vram("sdk_corridor", "--frames 20");
    const auto moved = vram("sdk_corridor", "--frames 20 --pad 3:UP,9:LEFT --pad-log pads.txt");
    CHECK(moved != still);
    auto script = tests::contents(path / "pads.txt");
    script.pop_back();
    CHECK(vram("sdk_corridor", "--frames 20 --pad '" + script + "'") == moved);
  }

  TEST_CASE_FIXTURE(Programs, "a recording replays to the VRAM that the program left") {
    const auto live = vram("sdk_corridor", "--frames 10");
    const auto recording = recorded("sdk_corridor", "--frames 10");
    CHECK(recording.vsyncs == 10);
    gpu::Gpu gpu;
    dump::replay(recording, gpu);
    const auto pixels = gpu.vram().pixels();
    CHECK(std::memcmp(pixels.data(), live.data(), live.size()) == 0);
  }

  TEST_CASE_FIXTURE(Programs, "a recording carries depth only if asked, and is otherwise the same") {
    const auto plain = recorded("sdk_cube", "--frames 5"),
               annotated = recorded("sdk_cube", "--frames 5 --annotate");
    const auto depth_words = [](const dump::Dump& d) {
      return std::count_if(d.words.begin(), d.words.end(),
                           [](std::uint32_t w) { return w >> 24 >= 0xe8 && w >> 24 <= 0xeb; });
    };
    CHECK(depth_words(plain) == 0);
    CHECK(depth_words(annotated) > 0);
    CHECK(plain.drawing_commands == annotated.drawing_commands);
  }

  TEST_CASE_FIXTURE(Programs, "four times the resolution is four times the picture") {
    REQUIRE(run("sdk_cube", "--frames 10 -o big.png --resolution 4 --position 256").status == 0);
    const auto png = tests::contents(path / "big.png");
    REQUIRE(png.size() > 24);
    CHECK(static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]) == 1280);
  }

  TEST_CASE_FIXTURE(Programs, "a wrong option is one line and status 2, and leaves no file") {
    for (const char* arguments :
         {"--frames 0 -o x.png", "--pad 3 -o x.png", "--visibility bsp -o x.png", "--nonsense"}) {
      CAPTURE(arguments);
      const auto outcome = run("sdk_cube", arguments);
      CHECK(outcome.status == 2);
      CHECK(tests::is_one_line(outcome.err));
      CHECK_FALSE(has("x.png"));
    }
  }

  TEST_CASE_FIXTURE(Programs,
                    "a crash is told with its signal and line, what was drawn is kept, and the status is 1") {
    const auto outcome = run("sdk_faults", "--frames 10 -o x.png");
    CHECK(outcome.status == 1);
    CHECK(tests::mentions(outcome.err, "faults.c:"));
    CHECK(tests::mentions(outcome.err, "SIGSEGV"));
    CHECK(has("x.png"));
  }

  TEST_CASE_FIXTURE(Programs, "bad pointers and sizes are findings with the line of the call") {
    const auto lint = report("sdk_bad_calls", "--frames 3")["lint"];
    std::vector<std::string> found;
    for (const auto& item : lint) {
      CHECK(std::string(item["at"]).starts_with("bad_calls.c:"));
      found.push_back(item["kind"]);
    }
    CHECK(found == std::vector<std::string>{"bad-pointer", "bad-pointer", "bad-pointer", "bad-size",
                                            "bad-pointer", "list"});
  }

  TEST_CASE_FIXTURE(Programs, "a program that never calls VSync gets its blanks from the clock") {
    const auto told = report("sdk_spins", "--frames 3");
    CHECK(told["never_waited"] == true);
    CHECK(told["frame"] == 3);
  }

  TEST_CASE_FIXTURE(Programs, "packets on the heap and on main's stack can be linked") {
    const auto told = report("sdk_heap", "--frames 3");
    CHECK(kinds(told).empty());
    CHECK(told["depth"]["polygons"] == 0);
    CHECK(told["tags"] > 0);
    CHECK(told["end"] == "ended");
  }

  TEST_CASE_FIXTURE(Programs, "a recording names the buckets of the program's table, which inspect tells") {
    REQUIRE(run("sdk_corridor", "--frames 12 --record r.psxgpu --annotate").status == 0);
    const auto told = shell("'" OTTER_PROGRAM "' inspect r.psxgpu --frame 8 --json -");
    REQUIRE(told.status == 0);
    const auto report = nlohmann::json::parse(told.out);
    for (const auto& item : report["lint"]) CHECK(item["kind"] != "buckets");
    const auto listed = shell("'" OTTER_PROGRAM "' replay r.psxgpu --list --json -");
    bool has_bucket = false;
    const auto list = nlohmann::json::parse(listed.out);
    for (const auto& one : list["commands"]) {
      const std::string number = one["number"];
      has_bucket = has_bucket || std::count(number.begin(), number.end(), ':') == 2;
    }
    CHECK(has_bucket);
  }

  TEST_CASE_FIXTURE(Programs,
                    "polygons without depth are drawn in list order, refused, or take their bucket's") {
    const auto plain = run("sdk_hello", "--frames 3 --visibility zbuffer -o x.png");
    CHECK(plain.status == 0);
    const std::string far_ones = "--frames 12 --visibility zbuffer -o x.png --without-depth ";
    CHECK(run("sdk_cube", far_ones + "error").status == 0);  // all of its polygons have depth
    CHECK(run("sdk_cube", far_ones + "bucket").status == 0);
  }

  TEST_CASE_FIXTURE(Programs, "play runs a program with all that follows, and nothing else") {
    const auto outcome =
        shell("'" OTTER_PROGRAM "' play '" SDK_PROGRAMS "/sdk_cube' --frames 4 -o frame.png");
    CHECK(outcome.status == 0);
    CHECK(has("frame.png"));
    const auto refused = shell("'" OTTER_PROGRAM "' play /bin/sh -c true");
    CHECK(refused.status == 2);
    CHECK(tests::is_one_line(refused.err));
    CHECK(tests::mentions(refused.err, "otter_add_program"));
    CHECK(shell("'" OTTER_PROGRAM "' play nowhere").status == 2);
  }
}
