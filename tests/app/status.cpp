#include "app/window/status.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "app/commands/describe.h"

namespace {

std::string all_text(const app::WindowState& state, int columns) {
  app::Status status;
  status.scene = "crates";
  std::string text;
  for (const auto& row : app::status_rows(app::status_pieces(state, status), columns)) {
    for (const auto& piece : row) text += piece.text + "  ";
    text += "\n";
  }
  return text;
}

bool mentions(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

}  // namespace

TEST_SUITE("window") {
  TEST_CASE("however narrow the window, the status says that it is paused, and at which frame") {
    app::WindowState state;
    state.paused = true;
    state.frame = 12;
    for (const int columns : {20, 40, 80, 300}) {
      CAPTURE(columns);
      CHECK(mentions(all_text(state, columns), "paused at frame 12"));
    }
  }

  TEST_CASE("the status says every knob that is not the console's, by its name on the command line") {
    for (const auto& knob : scene::knob_table()) {
      for (const std::string value :
           {"on", "1", "2", "16", "zbuffer", "nearest", "fifo", "linear", "lequal", "bucket", "double", "256",
            "perspective", "bilinear", "24", "msaa-4", "tent", "pixel", "640x480"}) {
        app::WindowState state;
        const auto before = knob.get(state.knobs);
        if (!knob.set(state.knobs, value) || knob.get(state.knobs) == before || knob.name == "visibility")
          continue;
        CAPTURE(std::string(knob.name));
        CAPTURE(value);
        const auto text = all_text(state, 60);
        const bool is_told = mentions(text, std::string(knob.name)) ||
                             mentions(text, knob.name == "key" ? value + " z" : value + " buckets");
        CHECK(is_told);
      }
    }
  }

  TEST_CASE("at the console's settings no knob is named") {
    const auto text = all_text({}, 300);
    for (const auto& knob : scene::knob_table()) {
      if (knob.name == "buckets") continue;  // "1,024 buckets"
      CHECK_FALSE(mentions(text, std::string(knob.name) + " "));
    }
  }

  TEST_CASE("rows are no longer than the window is wide, and figures never cost a row") {
    app::WindowState state;
    state.knobs.buckets = 3;
    state.knobs.bias = -7;
    state.knobs.filter = scene::Filter::bilinear;
    for (int columns = 8; columns < 150; ++columns) {
      app::Status status;
      status.scene = "a name as long as a file's may be, and then some more of it.psxgpu";
      const auto pieces = app::status_pieces(state, status);
      const auto rows = app::status_rows(pieces, columns);
      for (const auto& row : rows) {
        std::size_t used = 0;
        for (const auto& piece : row) used += piece.text.size();
        CHECK(used + 2 * (row.size() - 1) <= static_cast<std::size_t>(columns));
      }
      auto needed = pieces;
      std::erase_if(needed, [](const auto& piece) { return !piece.must_show; });
      CHECK(rows.size() == app::status_rows(needed, columns).size());
    }
  }

  TEST_CASE("an empty picture says why: no faces, or what became of all of them") {
    scene::FrameStats stats;
    CHECK(mentions(app::why_empty(stats), "neither faces nor lines"));
    stats.faces = 12;
    stats.dropped[static_cast<std::size_t>(scene::Drop::back_face)] = 4;
    stats.dropped[static_cast<std::size_t>(scene::Drop::near_plane)] = 8;
    const auto why = app::why_empty(stats);
    CHECK(mentions(why, "of 12 faces"));
    CHECK(mentions(why, "4 back face"));
    CHECK(mentions(why, "8 near plane"));
    stats.primitives = 1;
    CHECK(app::why_empty(stats).empty());
  }

  TEST_CASE("the title tells lists of windows the scene, and whether it rests, and where") {
    app::WindowState state;
    CHECK(app::window_title(state, "crates") == "Otter: crates");
    state.split = state.paused = true;
    state.frame = 12;
    state.lens.shown = 3;
    CHECK(app::window_title(state, "crates") == "Otter: crates, split, paused at frame 12, command 3");
  }
}
