#include "app/commands/expect.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/commands/json.h"
#include "base/file_kind.h"
#include "base/message.h"
#include "base/printed.h"
#include "debug/blame.h"
#include "display/compare.h"
#include "display/png.h"
#include "display/scanout.h"
#include "display/vram_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

/// A pixel that is not as expected.
struct WrongPixel {
  int x = 0, y = 0;        ///< in what was compared
  std::uint32_t vram = 0;  ///< y * 1024 + x
  std::string got, expected;
};

struct Compared {
  base::Picture shown;
  std::uint64_t compared = 0;
  std::vector<WrongPixel> differences;
};

std::string hex_colour(base::Rgba c) { return base::printed("%02X%02X%02X", c.r, c.g, c.b); }

bool is_compared(const std::optional<base::Picture>& mask, int x, int y) {
  return !mask || mask->at(x, y).r >= 128;
}

base::Result<std::optional<base::Picture>> read_mask(const std::string& path, int width, int height) {
  if (path.empty()) return std::nullopt;
  auto mask = display::read_png(path);
  if (!mask) return tl::make_unexpected(mask.error());
  if (mask->width != width || mask->height != height)
    return base::fail(path + ": " +
                      base::printed("%d x %d pixels, expected the %d x %d of what is compared", mask->width,
                                    mask->height, width, height));
  return std::move(*mask);
}

/// All 16 bits of every pixel.
base::Result<Compared> compare_vram(const gpu::Gpu& gpu, const std::string& path,
                                    const std::string& mask_path) {
  gpu::Vram expected;
  if (auto read = display::load_vram(path, expected); !read) return tl::make_unexpected(read.error());
  const auto mask = read_mask(mask_path, gpu::Vram::width, gpu::Vram::height);
  if (!mask) return tl::make_unexpected(mask.error());
  Compared result{.shown = display::scan_out_all(gpu.vram().pixels()), .compared = 0, .differences = {}};
  for (int y = 0; y < gpu::Vram::height; ++y) {
    for (int x = 0; x < gpu::Vram::width; ++x) {
      if (!is_compared(*mask, x, y)) continue;
      ++result.compared;
      const unsigned got = gpu.vram().at(x, y), wanted = std::as_const(expected).at(x, y);
      if (got != wanted)
        result.differences.push_back({x, y, static_cast<std::uint32_t>(gpu::Vram::offset(x, y)),
                                      base::printed("%04X", got), base::printed("%04X", wanted)});
    }
  }
  return result;
}

/// Programs widen 5 bits to 8 in ways of their own: only those that the pixel has are compared.
bool looks_like(base::Rgba a, base::Rgba b, int bits) {
  const int rest = 8 - bits;
  return a.r >> rest == b.r >> rest && a.g >> rest == b.g >> rest && a.b >> rest == b.b >> rest;
}

/// The colours that are seen.
base::Result<Compared> compare_picture(const gpu::Gpu& gpu, const std::string& path,
                                       const std::string& mask_path) {
  const auto expected = display::read_png(path);
  if (!expected) return tl::make_unexpected(expected.error());
  const auto area = display::area_of(gpu.display());
  const bool is_vram = expected->width == gpu::Vram::width && expected->height == gpu::Vram::height;
  if (!is_vram && (expected->width != area.width || expected->height != area.height))
    return base::fail(
        path + ": " +
        base::printed("%d x %d pixels, expected 1024 x 512 of VRAM or %d x %d, the display area",
                      expected->width, expected->height, area.width, area.height));
  const auto mask = read_mask(mask_path, expected->width, expected->height);
  if (!mask) return tl::make_unexpected(mask.error());
  const int exact_bits = area.is_24_bit && !is_vram ? 8 : 5;
  const auto pixels = gpu.vram().pixels();
  Compared result{.shown = is_vram ? display::scan_out_all(pixels) : display::scan_out(pixels, area),
                  .compared = 0,
                  .differences = {}};
  for (int y = 0; y < expected->height; ++y) {
    for (int x = 0; x < expected->width; ++x) {
      if (!is_compared(*mask, x, y)) continue;
      ++result.compared;
      const auto got = result.shown.at(x, y), wanted = expected->at(x, y);
      if (looks_like(got, wanted, exact_bits)) continue;
      const int column = is_vram ? x : area.x + (area.is_24_bit ? x * 3 / 2 : x);
      const int row = is_vram ? y : area.y + y;
      result.differences.push_back({x, y, static_cast<std::uint32_t>(gpu::Vram::offset(column, row)),
                                    hex_colour(got), hex_colour(wanted)});
    }
  }
  return result;
}

base::Result<Compared> compare_with(const gpu::Gpu& gpu, const std::string& path, const std::string& mask) {
  return base::lower_extension(path) == ".png" ? compare_picture(gpu, path, mask)
                                               : compare_vram(gpu, path, mask);
}

/// Differing pixels that one kind of command wrote last.
struct KindRow {
  std::string kind;
  std::uint64_t pixels = 0;
  std::optional<debug::Number> first;  ///< the first of these commands; nothing: nobody wrote them
  WrongPixel example;                  ///< a pixel of it
  std::string text;                    ///< the command in words
  std::vector<std::string> history;    ///< of that pixel, in the frame of that command
};

std::string command_in_words(debug::Timeline& timeline, const debug::Number& number) {
  if (number.command == 0) return "what goes on from the frame before";
  return debug::describe(timeline.dump(), timeline.commands(number.frame)[number.command - 1]);
}

std::vector<KindRow> blame(debug::Timeline& timeline, const debug::Number& moment, const Compared& comparison,
                           const std::function<bool()>& keep_going) {
  std::vector<std::uint32_t> pixels;
  for (const auto& difference : comparison.differences) pixels.push_back(difference.vram);
  const auto writers = debug::last_writers(timeline, moment, pixels, keep_going);
  std::map<std::string, KindRow> rows;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const auto& writer = writers[n];
    const std::string kind = writer ? std::string(debug::name(writer->kind)) : "nothing";
    KindRow& row = rows[kind];
    const bool is_first = ++row.pixels == 1 || (writer && gpu::is_before(writer->number, *row.first));
    if (!is_first) continue;
    if (writer) row.first = writer->number;
    row.example = comparison.differences[n];
  }
  std::vector<KindRow> sorted;
  for (auto& [kind, row] : rows) {
    row.kind = kind;
    if (row.first) {
      row.text = command_in_words(timeline, *row.first);
      const bool is_last = row.first->frame == moment.frame;
      row.history = debug::pixel_events(
          timeline, is_last ? moment : debug::Number{row.first->frame, debug::whole_frame}, row.example.vram);
    }
    sorted.push_back(std::move(row));
  }
  std::ranges::stable_sort(sorted, std::ranges::greater{}, &KindRow::pixels);
  return sorted;
}

void print_kinds(const std::string& file, const Compared& comparison, const std::vector<KindRow>& rows) {
  std::printf("%s: %zu of %llu pixels differ\n", base::printable(file).c_str(), comparison.differences.size(),
              static_cast<unsigned long long>(comparison.compared));
  if (rows.empty()) return;
  std::printf("%9s  %-9s  %-12s  command\n", "pixels", "wrote", "first");
  for (const KindRow& row : rows) {
    std::printf("%9llu  %-9s  %-12s  %s\n", static_cast<unsigned long long>(row.pixels), row.kind.c_str(),
                row.first ? debug::to_text(*row.first).c_str() : "-", row.text.c_str());
  }
  for (const KindRow& row : rows) {
    const auto& e = row.example;
    std::printf("%s: pixel %d,%d (VRAM %u,%u) is %s, expected %s\n", row.kind.c_str(), e.x, e.y,
                static_cast<unsigned>(e.vram % gpu::Vram::width),
                static_cast<unsigned>(e.vram / gpu::Vram::width), e.got.c_str(), e.expected.c_str());
    for (const auto& line : row.history) std::printf("    %s\n", line.c_str());
  }
}

Json kinds_json(const std::string& name, const debug::Number& moment, const Compared& comparison,
                const std::vector<KindRow>& rows) {
  Json kinds = Json::array();
  for (const KindRow& row : rows) {
    const auto& e = row.example;
    kinds.push_back({{"kind", row.kind},
                     {"pixels", row.pixels},
                     {"first", row.first ? Json(debug::to_text(*row.first)) : Json(nullptr)},
                     {"text", row.text},
                     {"pixel", {e.x, e.y}},
                     {"vram", {e.vram % gpu::Vram::width, e.vram / gpu::Vram::width}},
                     {"got", e.got},
                     {"expected", e.expected},
                     {"history", row.history}});
  }
  return {{"schema", "otter.expect/1"},
          {"scene", name},
          {"frame", moment.frame},
          {"width", comparison.shown.width},
          {"height", comparison.shown.height},
          {"compared", comparison.compared},
          {"different", comparison.differences.size()},
          {"kinds", std::move(kinds)}};
}

base::Result<void> write_difference(const std::string& path, const Compared& comparison) {
  if (path.empty()) return {};
  if (comparison.shown.pixels.empty())
    return base::fail(path + ": the display area is empty", base::Exit::failed);
  base::Picture other = comparison.shown;  // differs just where something differs, bit 15 included
  for (const auto& d : comparison.differences) other.at(d.x, d.y).r ^= 0x80;
  return display::write_png(path, display::mark_different(comparison.shown, other, {255, 0, 0, 255}));
}

base::Result<bool> check_one(const ExpectOptions& options, const std::string& file, const std::string& name,
                             debug::Timeline& timeline, const debug::Number& moment,
                             bool says_nothing_if_good, const std::function<bool()>& keep_going) {
  const auto comparison = compare_with(timeline.seek(moment), file, options.mask);
  if (!comparison) return tl::make_unexpected(comparison.error());
  const bool is_good = comparison->differences.empty();
  if (is_good && says_nothing_if_good) return true;
  const auto rows = blame(timeline, moment, *comparison, keep_going);
  if (options.json != "-") print_kinds(file, *comparison, rows);
  if (!options.json.empty()) {
    if (auto written = write_json(options.json, kinds_json(name, moment, *comparison, rows)); !written)
      return tl::make_unexpected(written.error());
  }
  if (auto written = write_difference(options.difference, *comparison); !written)
    return tl::make_unexpected(written.error());
  return is_good;
}

/// frame-NNNNNN.png and .bin by number.
base::Result<std::map<std::uint64_t, std::string>> frame_files(const std::string& folder) {
  std::map<std::uint64_t, std::string> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto extension = base::lower_extension(entry.path());
    const std::string stem = entry.path().stem().string();
    constexpr std::string_view prefix = "frame-";
    if ((extension != ".png" && extension != ".bin") || !stem.starts_with(prefix)) continue;
    std::uint64_t number = 0;
    const char* const end = stem.data() + stem.size();
    const auto read = std::from_chars(stem.data() + prefix.size(), end, number);
    if (read.ec == std::errc() && read.ptr == end) files.emplace(number, entry.path().string());
  }
  if (error) return base::fail("--expect-frames " + folder + ": cannot be read: " + error.message());
  if (files.empty())
    return base::fail("--expect-frames " + folder + ": expected files named frame-000001.png or .bin in it");
  return files;
}

base::Result<bool> check_frames(const ExpectOptions& options, const std::string& name,
                                debug::Timeline& timeline, const debug::Number& moment,
                                const std::function<bool()>& keep_going) {
  const auto files = frame_files(options.frames);
  if (!files) return tl::make_unexpected(files.error());
  std::uint64_t good = 0;
  for (const auto& [frame, file] : *files) {
    if (frame < 1 || frame > timeline.frames())
      return base::fail(file + ": " + name + " has the frames 1.." + std::to_string(timeline.frames()));
    if (frame > moment.frame) break;
    if (keep_going && !keep_going()) return base::fail("interrupted", base::Exit::interrupted);
    const debug::Number end{frame, frame == moment.frame ? moment.command : debug::whole_frame};
    const auto checked = check_one(options, file, name, timeline, end, true, keep_going);
    if (!checked || !*checked) return checked;
    ++good;
  }
  if (options.json != "-")
    std::printf("%s: %llu frames as expected\n", base::printable(options.frames).c_str(),
                static_cast<unsigned long long>(good));
  if (options.json.empty()) return true;
  return write_json(options.json, {{"schema", "otter.expect/1"},
                                   {"scene", name},
                                   {"frame", moment.frame},
                                   {"width", 0},
                                   {"height", 0},
                                   {"frames", good},
                                   {"different", 0},
                                   {"kinds", Json::array()}})
      .map([] { return true; });
}

}  // namespace

void add_expect_options(Arguments& arguments, ExpectOptions& options) {
  arguments.text(
      "--expect", "FILE", options.expect,
      "compare: 1 MiB of VRAM, or FILE.png of VRAM or of the display area; exit 1 when pixels differ");
  arguments.text("--expect-frames", "DIR", options.frames,
                 "compare every frame with DIR/frame-NNNNNN.png or .bin, up to the first that differs");
  arguments.text("--mask", "FILE", options.mask, "with --expect: a PNG, white where pixels count");
  arguments.text("--difference", "FILE", options.difference,
                 "with --expect: write a PNG, the pixels that differ in red");
}

base::Result<bool> check_expected(const ExpectOptions& options, const std::string& name,
                                  debug::Timeline& timeline, const debug::Number& moment,
                                  const std::function<bool()>& keep_going) {
  if (!options.frames.empty()) return check_frames(options, name, timeline, moment, keep_going);
  return check_one(options, options.expect, name, timeline, moment, false, keep_going);
}

}  // namespace app
