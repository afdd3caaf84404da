#include "inspect/lint.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "inspect/history.h"
#include "inspect/json.h"
#include "inspect/maps.h"
#include "ot/ordering_table.h"
#include "stage.h"

namespace {

constexpr std::uint32_t table_at = 0x1000, length = 8;

// A cleared table of eight buckets.
struct Ram {
  ot::MainRam ram{ot::RamSize::mib2};
  ot::OrderingTable table{ram, table_at, length};
  Ram() { table.clear(); }

  // A dot at `address`, not linked yet.
  std::uint32_t packet(std::uint32_t address) {
    ram.write(address, 0x02ffffff);
    ram.write(address + 4, 0x68ffffff);
    ram.write(address + 8, 0);
    return address;
  }
  [[nodiscard]] std::vector<inspect::LintItem> lint() const {
    return inspect::lint_list(ram, table.head(), inspect::TableRange{table_at, length});
  }
};

bool has(const std::vector<inspect::LintItem>& items, const char* kind, const char* at) {
  return std::any_of(items.begin(), items.end(),
                     [&](const auto& item) { return item.kind == kind && item.at == at; });
}

}  // namespace

TEST_SUITE("inspect") {
  TEST_CASE("a sound list has nothing to be said about it") {
    Ram r;
    r.table.insert(3, r.packet(0x2000));
    r.table.insert(3, r.packet(0x2010));
    CHECK(r.lint().empty());
  }

  TEST_CASE("a packet inserted into two buckets is linked twice, and the buckets between are lost") {
    Ram r;
    r.table.insert(6, r.packet(0x2000));
    r.table.insert(2, 0x2000);  // bucket 6 now leads to the packet and on to bucket 1
    const auto items = r.lint();
    CHECK(has(items, "linked-twice", "002000h"));
    CHECK(has(items, "unreachable-bucket", "001008h"));  // 2; and 3, 4, 5
  }

  TEST_CASE("a packet inserted again behind itself is a loop") {
    Ram r;
    r.table.insert(2, r.packet(0x2000));
    r.table.insert(2, 0x2000);
    const auto items = r.lint();
    CHECK(has(items, "loop", "002000h"));
    CHECK(has(items, "linked-twice", "002000h"));
  }

  TEST_CASE("packets whose words overlap are named") {
    Ram r;
    r.table.insert(3, r.packet(0x2000));
    r.table.insert(4, r.packet(0x2008));  // on the last word of the one before
    CHECK(has(r.lint(), "overlap", "002008h"));
  }

  TEST_CASE("a link outside RAM is named") {
    Ram r;
    r.ram.write(table_at, 0x00900000);
    CHECK(has(r.lint(), "outside-ram", "900000h"));
  }

  TEST_CASE("a packet on the word above the table was inserted at the length, one on the word below at -1") {
    Ram r;
    r.ram.write(table_at + 4 * length, r.packet(0x2000));
    r.ram.write(table_at - 4, r.packet(0x2010));
    const auto items = r.lint();
    CHECK(has(items, "bucket-range", "001020h"));
    CHECK(has(items, "bucket-range", "000FFCh"));
  }

  TEST_CASE("a bucket number is below, at or above the length, or fine") {
    CHECK_FALSE(inspect::lint_bucket(0, 8));
    CHECK_FALSE(inspect::lint_bucket(7, 8));
    CHECK(inspect::lint_bucket(-1, 8)->text == "bucket -1 is below 0 of a table of 8");
    CHECK(inspect::lint_bucket(8, 8)->text ==
          "bucket 8 is the length of a table of 8 (compared with > instead of >=?)");
    CHECK(inspect::lint_bucket(9, 8)->text == "bucket 9 is above the length of a table of 8");
  }

  TEST_CASE("primitives that ask for a bucket below, at or above the table's range are told apart") {
    CHECK(inspect::lint_buckets({}, 64).empty());
    const auto items = inspect::lint_buckets({3, 1, 2}, 64);
    REQUIRE(items.size() == 3);
    for (const auto& item : items) CHECK(item.kind == "bucket-range");
    CHECK(items[0].at == "bucket < 0");
    CHECK(items[0].text == "3 primitives ask for a bucket below 0 of a table of 64; drawn in bucket 0");
    CHECK(items[1].at == "bucket = 64");
    CHECK(items[1].text.starts_with(
        "1 primitive asks for a bucket at the length of a table of 64; drawn in bucket 63"));
    CHECK(items[2].text ==
          "2 primitives ask for a bucket above the length of a table of 64; drawn in bucket 63");
  }

  TEST_CASE("without a table, bucket checks read not available") {
    Ram r;
    const auto items = inspect::lint_list(r.ram, r.table.head(), std::nullopt);
    REQUIRE(items.size() == 1);
    CHECK(items[0].text == "not available: no ordering table is known");
  }

  TEST_CASE("polygons that draw nothing are counted by reason") {
    tests::Stage stage;
    stage.polygon({{0, 0, 1}, {4, 4, 1}, {2, 2, 1}});
    stage.polygon({{-900, 0, 1}, {900, 0, 1}, {0, 9, 1}});
    stage.polygon({{20, 20, 1}, {30, 20, 1}, {20, 30, 1}});
    const auto report = stage.report();
    REQUIRE(report.lint.size() == 3);
    CHECK(report.lint[0].kind == "size-rule");
    CHECK(report.lint[0].at == "0:2");
    CHECK(report.lint[1].kind == "no-area");
    CHECK(report.lint[2].kind == "outside-area");
  }

  TEST_CASE("the JSON report begins with its schema and names every cause") {
    tests::Stage stage;
    stage.quad(0, 0, 4, 4, 100, {.bucket = 3});
    stage.quad(2, 2, 6, 6, 200, {.bucket = 3});
    const std::string json = inspect::to_json(stage.report());
    CHECK(json.find("{\n  \"schema\": \"otter.inspect/1\",\n  \"scene\": \"stage\",\n  \"frame\": 0,\n  "
                    "\"width\": 8,\n"
                    "  \"height\": 8,\n  \"pixels_drawn\": 28,\n  \"wrong_pixels\": 4,\n") == 0);
    for (const auto name : inspect::cause_names)
      CHECK(json.find(std::string(name).insert(0, 1, '"').append("\": ")) != std::string::npos);
    CHECK(json.find("\"BucketTie\": 4") != std::string::npos);
  }

  TEST_CASE(
      "the JSON of several frames has the sums first, then each frame; that of one frame is the frame's") {
    tests::Stage one, two;
    one.quad(0, 0, 4, 4, 100, {.bucket = 3});
    one.quad(2, 2, 6, 6, 200, {.bucket = 3});
    two.quad(0, 0, 4, 4, 100, {.bucket = 3});
    two.quad(0, 0, 2, 2, 200, {.bucket = 9});
    const auto text = [](inspect::FramesJson& json) {
      std::FILE* file = std::tmpfile();
      REQUIRE(file != nullptr);
      json.write(file);
      std::string read(static_cast<std::size_t>(std::ftell(file)), ' ');
      std::rewind(file);
      REQUIRE(std::fread(read.data(), 1, read.size(), file) == read.size());
      std::fclose(file);
      return read;
    };
    inspect::FramesJson json;
    CHECK(json.add(one.report()));
    CHECK(text(json) == inspect::to_json(one.report()));
    CHECK(json.add(two.report()));
    const auto both = nlohmann::json::parse(text(json));
    CHECK(both["schema"] == "otter.inspect/1");
    CHECK(both["pixels_drawn"] == 28 + 16);
    CHECK(both["wrong_pixels"] == 4 + 4);
    CHECK(both["causes"]["BucketTie"] == 4);
    CHECK(both["causes"]["KeyInversion"] == 4);
    REQUIRE(both["frames"].size() == 2);
    CHECK(both["frames"][0]["wrong_pixels"] == 4);
    CHECK(both["frames"][1]["pairs"][0]["cause"] == "KeyInversion");
  }

  TEST_CASE("a pixel tells who drew it, what it shows and what it should show") {
    tests::Stage stage;
    stage.quad(0, 0, 4, 4, 100, {.bucket = 3, .rgb = {255, 0, 0}});
    stage.quad(2, 2, 6, 6, 200, {.bucket = 3, .rgb = {0, 255, 0}});
    const auto report = stage.report();
    const auto lines = inspect::pixel_history(report, stage.trace(), 2, 3);
    REQUIRE(lines.size() == 4);
    CHECK(lines[1] == "  1. 0:1:3 quad wrote 001F over 0000, depth 100.0000");
    CHECK(lines[2] == "  2. 0:2:3 quad wrote 03E0 over 001F, depth 200.0000");
    CHECK(lines[3] ==
          "  wrong: shows 0:2:3 at depth 200.0000, should show 0:1:3 at depth 100.0000: BucketTie");
    CHECK(inspect::pixel_history(report, stage.trace(), 8, 0).empty());
  }

  TEST_CASE("the truth image has the colours of the true owners, layers blended in the true order") {
    tests::Stage stage;
    stage.quad(0, 0, 8, 8, 100, {.rgb = {255, 0, 0}});
    stage.quad(0, 0, 8, 8, 200, {.rgb = {0, 255, 0}});                           // hides it, wrongly
    stage.quad(0, 0, 8, 4, 50, {.semi_transparent = true, .rgb = {0, 0, 255}});  // (B + F) / 2
    const auto report = stage.report();
    const auto image = inspect::truth_image(report, stage.trace(), stage.gpu().vram().pixels());
    CHECK(image.at(1, 6) == base::Rgba{255, 0, 0});
    CHECK(image.at(1, 1) == base::Rgba{123, 0, 123});  // (31 + 0) >> 1 = 15, widened to 123
    const auto heat = inspect::heatmap(report, stage.gpu().vram().pixels());
    CHECK(heat.at(1, 6) == inspect::colour_of(inspect::Cause::list_order));
    CHECK(heat.height > 8);  // the legend
  }
}
