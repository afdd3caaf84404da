// otter walk: a list in a RAM image, drawn, linted and refused. Everything expected is worked out by hand.

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "program.h"

namespace {

using tests::contents, tests::Folder, tests::is_one_line, tests::mentions;
using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t table = 0x1000, end = 0xffffff;

/// Main RAM as an emulator saves it.
struct Image {
  std::string bytes;
  explicit Image(std::size_t size = 0x200000) : bytes(size, '\0') {}

  void put(std::uint32_t address, std::uint32_t word) {
    for (int n = 0; n < 4; ++n)
      bytes[address + static_cast<std::uint32_t>(n)] = static_cast<char>(word >> 8 * n);
  }
  void node(std::uint32_t address, std::uint32_t next, const Words& payload) {
    put(address, next | static_cast<std::uint32_t>(payload.size()) << 24);
    for (const auto word : payload) put(address += 4, word);
  }
};

const Words red_rectangle{0x600000f8, 0x00010002, 0x00020003};               // (2,1), 3 x 2
const Words green_triangle{0x2000f800, 0x00000000, 0x00000004, 0x00040000};  // (0,0)(4,0)(0,4)

/// Four buckets; the rectangle in bucket 2, the triangle before it in bucket 1.
Image two_packets() {
  Image ram;
  ram.node(table + 12, table + 8, {});
  ram.node(table + 8, 0x2000, {});
  ram.node(0x2000, table + 4, red_rectangle);
  ram.node(table + 4, 0x2100, {});
  ram.node(0x2100, table, green_triangle);
  ram.node(table, end, {});
  return ram;
}

/// VRAM after two_packets() over pixels of `background`.
std::string two_packets_drawn(std::uint16_t background) {
  std::vector<std::uint16_t> pixels(1024 * 512, background);
  for (std::size_t y = 1; y <= 2; ++y) {
    for (std::size_t x = 2; x <= 4; ++x) pixels[y * 1024 + x] = 0x001f;
  }
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 4 - y; ++x) pixels[y * 1024 + x] = 0x03e0;
  }
  std::string bytes;
  for (const auto pixel : pixels) {
    bytes.push_back(static_cast<char>(pixel & 0xff));
    bytes.push_back(static_cast<char>(pixel >> 8));
  }
  return bytes;
}

}  // namespace

TEST_SUITE("otter") {
  TEST_CASE("walk draws a list far to near into VRAM and counts its tags and words") {
    const Folder folder;
    folder.put("ram.bin", two_packets().bytes);
    const auto walked = folder.otter("walk ram.bin --head 100C --vram v.bin");
    CHECK(walked.status == 0);
    CHECK(walked.err.empty());
    CHECK(mentions(walked.out, "ram.bin: 6 tags, 7 words\n"));
    CHECK(mentions(walked.out, "drawing commands: 2\n"));
    CHECK(mentions(walked.out, "not available: no ordering table is known"));
    CHECK(contents(folder.path / "v.bin") == two_packets_drawn(0));
  }

  TEST_CASE("walk takes addresses as programs write them") {
    const Folder folder;
    folder.put("ram.bin", two_packets().bytes);
    for (const auto* head : {"0x100c", "0000100C", "8000100C", "0x8000100C", "100Ch", "A000100C"}) {
      CAPTURE(std::string(head));
      CHECK(mentions(folder.otter("walk ram.bin --head " + std::string(head)).out, "6 tags, 7 words"));
    }
  }

  TEST_CASE("walk --table tells how the packets lie in the buckets") {
    const Folder folder;
    folder.put("ram.bin", two_packets().bytes);
    const auto walked = folder.otter("walk ram.bin --head 100C --table 1000,4");
    CHECK(walked.status == 0);
    CHECK(mentions(walked.out,
                   "buckets: 4, used 2, with more than one packet 0, fullest 1 with 1 packets\n"
                   "       0..0            0 \n"
                   "       1..1            1 ########################################\n"
                   "       2..2            1 ########################################\n"
                   "       3..3            0 \n"));
    CHECK_FALSE(mentions(walked.out, "lint:"));
  }

  TEST_CASE("walk names what is suspicious about a list that still ends well") {
    const Folder folder;
    auto ram = two_packets();
    ram.node(0x2000, table, red_rectangle);  // past bucket 1
    folder.put("ram.bin", ram.bytes);
    const auto walked = folder.otter("walk ram.bin --head 100C --table 1000,4");
    CHECK(walked.status == 0);
    CHECK(mentions(walked.out, "4 tags"));
    CHECK(mentions(walked.out, "lint: unreachable-bucket"));
  }

  TEST_CASE("walk draws over the VRAM it is given, and writes it as a picture or as halfwords") {
    const Folder folder;
    folder.put("ram.bin", two_packets().bytes);
    std::string before;
    for (int n = 0; n < 1024 * 512; ++n) before += "\x34\x12";
    folder.put("before.bin", before);
    CHECK(folder.otter("walk ram.bin --head 100C --vram-in before.bin --vram v.bin").status == 0);
    CHECK(contents(folder.path / "v.bin") == two_packets_drawn(0x1234));
    CHECK(folder.otter("walk ram.bin --head 100C --vram-in before.bin --vram v.png").status == 0);
    const auto png = contents(folder.path / "v.png");
    REQUIRE(png.size() > 33);
    CHECK(png.substr(1, 3) == "PNG");
    CHECK(png.substr(16, 8) == std::string("\0\0\4\0\0\0\2\0", 8));  // IHDR: 1024, 512
  }

  TEST_CASE("walk reads 8 MiB of RAM, and the mirrors of 2 MiB") {
    const Folder folder;
    Image large(0x800000);
    large.node(0x7fff00, end, red_rectangle);
    folder.put("large.bin", large.bytes);
    CHECK(mentions(folder.otter("walk large.bin --head 7FFF00").out, "1 tags, 3 words"));
    auto ram = two_packets();
    ram.node(0x2000, 0x200000 + table + 4, red_rectangle);
    folder.put("ram.bin", ram.bytes);
    const auto mirrored = folder.otter("walk ram.bin --head 60100C --vram v.bin");
    CHECK(mirrored.status == 0);
    CHECK(contents(folder.path / "v.bin") == two_packets_drawn(0));
  }

  TEST_CASE("walk refuses a list that does not end well: one line with both tags, exit 2, nothing written") {
    struct Row {
      std::uint32_t at, next;
      Words payload;
      const char* said;
    };
    const std::vector<Row> rows{
        {0x2100, table + 8, green_triangle, "tag 001008h is linked again from tag 002100h (a loop)"},
        {0x2100, 0x2100, green_triangle, "tag 002100h is linked again from tag 002100h (a loop)"},
        {0x2000, 0x900000, red_rectangle, "tag 002000h links to 900000h, outside RAM"},
        {0x2000, 0x800000, red_rectangle, "tag 002000h links to 800000h, outside RAM"},
    };
    const Folder folder;
    for (const auto& row : rows) {
      CAPTURE(std::string(row.said));
      auto ram = two_packets();
      ram.node(row.at, row.next, row.payload);
      folder.put("ram.bin", ram.bytes);
      const auto walked = folder.otter("walk ram.bin --head 100C --table 1000,4 --vram v.bin");
      CHECK(walked.status == 2);
      CHECK(is_one_line(walked.err));
      CHECK(mentions(walked.err, "ram.bin: " + std::string(row.said)));
      CHECK(mentions(walked.out, "lint: "));
      CHECK_FALSE(folder.has("v.bin"));
    }
    auto ram = two_packets();
    ram.node(0x2000, 0x1ffff8, red_rectangle);
    ram.put(0x1ffff8, 2U << 24 | end);  // one word fits
    folder.put("ram.bin", ram.bytes);
    const auto walked = folder.otter("walk ram.bin --head 100C --vram v.bin");
    CHECK(walked.status == 2);
    CHECK(mentions(walked.err,
                   "the payload of tag 1FFFF8h (linked from tag 002000h) runs past the end of RAM"));
    CHECK_FALSE(folder.has("v.bin"));
  }

  TEST_CASE("walk refuses what it cannot use: one line, exit 2, nothing written") {
    const Folder folder;
    folder.put("ram.bin", two_packets().bytes);
    folder.put("short.bin", "only this");
    folder.put("odd.bin", two_packets().bytes + '\0');
    struct Row {
      std::string arguments, said;
    };
    const std::vector<Row> rows{
        {"walk", "image is required"},
        {"walk ram.bin", "--head"},
        {"walk nowhere.bin --head 100C", "nowhere.bin"},
        {"walk . --head 100C", "."},
        {"walk short.bin --head 100C", "expected the 2097152 or 8388608 bytes of main RAM, got 9"},
        {"walk odd.bin --head 100C", "got 2097153"},
        {"walk ram.bin --head there", "--head: expected a hexadecimal address such as 80123000, got 'there'"},
        {"walk ram.bin --head ''", "--head"},
        {"walk ram.bin --head 100C --table 1000", "--table: expected ADDR,N such as 80123000,1024"},
        {"walk ram.bin --head 100C --table 1000,0", "--table: expected ADDR,N"},
        {"walk ram.bin --head 100C --table 1001,4", "--table: expected ADDR,N"},
        {"walk ram.bin --head 100C --table 1FFFFC,2", "does not lie within the 2097152 bytes of RAM"},
        {"walk ram.bin --head 100C --vram-in short.bin", "short.bin"},
        {"walk ram.bin --head 100C --visibility bsp", "--visibility"},
        {"walk ram.bin --head 100C --magic", "--magic"},
    };
    for (const auto& row : rows) {
      CAPTURE(row.arguments);
      const auto walked = folder.otter(row.arguments + " --vram v.bin");
      CAPTURE(walked.err);
      CHECK(walked.status == 2);
      CHECK(is_one_line(walked.err));
      CHECK(mentions(walked.err, row.said));
      CHECK_FALSE(folder.has("v.bin"));
    }
  }

  TEST_CASE("walk exits 1 when the VRAM cannot be written") {
    const Folder folder;
    folder.put("ram.bin", two_packets().bytes);
    const auto walked = folder.otter("walk ram.bin --head 100C --vram nowhere/v.bin");
    CHECK(walked.status == 1);
    CHECK(is_one_line(walked.err));
    CHECK(mentions(walked.err, "nowhere/v.bin: cannot be written"));
  }

  TEST_CASE("walk draws an annotated list through a z-buffer on request, and only then heeds its depths") {
    // A near rectangle first, a far one over a part of it after: quads at z = 100 and 200 (20.12).
    Image ram;
    const auto depths = [](std::uint32_t z) {
      Words words;
      for (std::uint32_t v = 0; v < 4; ++v) words.push_back((0xe8 + v) << 24 | z << 12);
      return words;
    };
    ram.node(0x2000, 0x2100, depths(100));
    ram.node(0x2100, 0x2200, {0x280000f8, 0x00000000, 0x00000004, 0x00040000, 0x00040004});  // 4 x 4, red
    ram.node(0x2200, 0x2300, depths(200));
    ram.node(0x2300, end, {0x2800f800, 0x00000000, 0x00000008, 0x00040000, 0x00040008});  // 8 x 4, green
    const Folder folder;
    folder.put("ram.bin", ram.bytes);
    CHECK(folder.otter("walk ram.bin --head 2000 --vram ot.bin").status == 0);
    CHECK(folder.otter("walk ram.bin --head 2000 --visibility zbuffer --vram z.bin").status == 0);
    const auto ot = contents(folder.path / "ot.bin"), z = contents(folder.path / "z.bin");
    REQUIRE(ot.size() == 1 << 20);
    REQUIRE(z.size() == 1 << 20);
    const std::string red("\x1f\0", 2), green("\xe0\x03", 2);
    CHECK(ot.substr(2 * 3, 2) == green);
    CHECK(ot.substr(2 * 4, 2) == green);
    CHECK(z.substr(2 * 3, 2) == red);
    CHECK(z.substr(2 * 4, 2) == green);
  }

  // Both in bucket 1: the list draws the square after the triangle; equal depths show the first.
  TEST_CASE("--without-depth says what a polygon without depth does to a z-buffer") {
    const Words blue_square{0x28ff0000, 0x00000000, 0x00000004, 0x00040000, 0x00040004};
    Image ram;
    ram.node(table + 4, 0x2100, {});
    ram.node(0x2100, 0x2200, green_triangle);
    ram.node(0x2200, table, blue_square);
    ram.node(table, end, {});
    const Folder folder;
    folder.put("ram.bin", ram.bytes);
    const auto walk = [&](const std::string& more) {
      return folder.otter("walk ram.bin --head 1004 --visibility zbuffer --vram v.bin " + more);
    };
    const std::string green("\xe0\x03", 2), blue("\x00\x7c", 2);

    const auto in_order = walk("--table 1000,2");
    CHECK(in_order.status == 0);
    CHECK(is_one_line(in_order.err));
    CHECK(mentions(in_order.err, "2 polygons without depth, the first is command 1:1: drawn in list order"));
    CHECK(contents(folder.path / "v.bin").substr(0, 2) == blue);

    const auto by_bucket = walk("--table 1000,2 --without-depth bucket");
    CHECK(by_bucket.status == 0);
    CHECK(by_bucket.err.empty());
    CHECK(contents(folder.path / "v.bin").substr(0, 2) == green);

    std::filesystem::remove(folder.path / "v.bin");
    const auto refused = walk("--without-depth error");
    CHECK(refused.status == 1);
    CHECK(is_one_line(refused.err));
    CHECK(mentions(refused.err, "2 polygons without depth"));
    CHECK_FALSE(folder.has("v.bin"));
    const auto no_table = walk("--without-depth bucket");
    CHECK(no_table.status == 2);
    CHECK(is_one_line(no_table.err));
    CHECK(mentions(no_table.err, "--without-depth bucket: ram.bin has no buckets"));
    CHECK_FALSE(folder.has("v.bin"));
  }

  // Bucket b of N stands for z = (b + 1/2) * 32768 / N: 8,192 and 24,576 here.
  TEST_CASE("a polygon without depth is nearer or farther than one with depth, as its bucket is") {
    const auto annotated = [](std::uint32_t z) {  // z in view-space units, below 4096
      return Words{0xe8000000 | z << 12, 0xe9000000 | z << 12, 0xea000000 | z << 12, 0xe7000000};
    };
    const Words red_triangle{0x200000f8, 0x00000000, 0x00000004, 0x00040000};
    Image ram;
    ram.node(table + 4, 0x2000, {});
    ram.node(0x2000, 0x2100, annotated(4000));
    ram.node(0x2100, table, red_triangle);
    ram.node(table, 0x2200, {});
    ram.node(0x2200, end, green_triangle);  // bucket 0: z = 8192, behind 4000
    const Folder folder;
    folder.put("ram.bin", ram.bytes);
    CHECK(folder
              .otter("walk ram.bin --head 1004 --table 1000,2 --visibility zbuffer --without-depth bucket "
                     "--vram v.bin")
              .status == 0);
    CHECK(contents(folder.path / "v.bin").substr(0, 2) == std::string("\x1f\0", 2));
  }
}
