// otter slice: the few commands of a dump that some pixels depend on, as a dump of its own.

#include "debug/slice.h"

#include <charconv>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/source.h"
#include "base/message.h"
#include "display/scanout.h"
#include "dump/dump_file.h"

namespace app {
namespace {

struct SliceOptions {
  std::string source, pixel, size = "1x1", output, format = "standard";
  SourceOptions source_options;
  std::uint64_t frame = 1;
  bool vram = false;
};

/// "A,B" or "AxB".
std::optional<std::pair<int, int>> two_numbers(std::string_view text, char between) {
  int a = 0, b = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, a);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != between) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, b);
  if (second.ec != std::errc() || second.ptr != end || a < 0 || b < 0) return std::nullopt;
  return std::pair(a, b);
}

/// The halfwords of VRAM that the asked rectangle is made of.
base::Result<std::vector<std::uint32_t>> pixels_of(const SliceOptions& options, const gpu::Gpu& gpu) {
  const auto corner = two_numbers(options.pixel, ',');
  if (!corner) return base::fail("--pixel: expected X,Y, got " + options.pixel);
  const auto size = two_numbers(options.size, 'x');
  if (!size || size->first == 0 || size->second == 0)
    return base::fail("--size: expected WxH, got " + options.size);
  display::Area area{.width = gpu::Vram::width, .height = gpu::Vram::height};
  if (!options.vram) area = display::area_of(gpu.display());
  const auto [x, y] = *corner;
  const auto [width, height] = *size;
  if (x >= area.width || y >= area.height || width > area.width - x || height > area.height - y) {
    return base::fail("--pixel: expected a rectangle inside " + std::to_string(area.width) + "x" +
                      std::to_string(area.height) +
                      (options.vram ? ", VRAM" : ", the display area (--vram: all of VRAM)") + ", got " +
                      options.pixel + " and " + options.size);
  }
  std::vector<std::uint32_t> pixels;
  const int first = area.is_24_bit ? x * 3 / 2 : x;
  const int end = area.is_24_bit ? ((x + width) * 3 + 1) / 2 : x + width;
  for (int row = y; row < y + height; ++row)
    for (int column = first; column < end; ++column)
      pixels.push_back(static_cast<std::uint32_t>(gpu::Vram::offset(area.x + column, area.y + row)));
  return pixels;
}

base::Result<int> run_slice(const SliceOptions& options) {
  auto source = open_source(options.source, options.source_options);
  if (!source) return tl::make_unexpected(source.error());
  if (!source->is_recording())
    return base::fail(options.source +
                      ": expected a dump or a RAM image; otter record makes a dump of a scene");
  auto timeline = open_timeline(*source, {});
  if (!timeline) return tl::make_unexpected(timeline.error());
  const Interrupt interrupt;
  const auto goes_on = [&] { return !interrupt.was_asked(); };
  if (auto read = (*timeline)->read_all([&](double) { return goes_on(); }); !read)
    return tl::make_unexpected(read.error());
  warn_of_fault(**timeline);
  if (options.frame > (*timeline)->frames())
    return base::fail("--frame " + std::to_string(options.frame) + ": " + options.source +
                      " has the frames 1.." + std::to_string((*timeline)->frames()));
  const auto pixels = pixels_of(options, (*timeline)->seek({options.frame, debug::whole_frame}));
  if (!pixels) return tl::make_unexpected(pixels.error());
  const auto sliced = debug::slice(**timeline, options.frame, *pixels, goes_on);
  if (!sliced) return tl::make_unexpected(sliced.error());
  const auto format = options.format == "v1" ? dump::DumpFormat::v1 : dump::DumpFormat::standard;
  std::uint64_t words = 0;
  auto written =
      dump::write_dump(options.output, format, [&](dump::DumpWriter& writer) -> base::Result<void> {
        writer.add_text(dump::PacketType::comment, "otter: slice of " + options.source + ", frame " +
                                                       std::to_string(options.frame) + ", " + options.pixel +
                                                       " " + options.size);
        dump::add_packets(sliced->dump, writer);
        words = writer.words();
        return {};
      });
  if (!written) return tl::make_unexpected(written.error());
  std::uint64_t all = 0;
  for (std::uint64_t f = 1; f <= options.frame; ++f) all += (*timeline)->commands_in(f);
  std::printf("%s: %zu of %llu commands, %llu pixels of uploads, %llu words\n",
              base::printable(options.output).c_str(), sliced->kept.size(),
              static_cast<unsigned long long>(all), static_cast<unsigned long long>(sliced->upload_pixels),
              static_cast<unsigned long long>(words));
  for (const auto& number : sliced->kept) {
    if (number.command == 0) {
      std::printf("  %-12s the rest of an upload of the frame before\n", debug::to_text(number).c_str());
      continue;
    }
    const auto& command = (*timeline)->commands(number.frame)[number.command - 1];
    std::printf("  %-12s %s\n", debug::to_text((*timeline)->number_of(number.frame, command)).c_str(),
                debug::describe((*timeline)->dump(), command).c_str());
  }
  return 0;
}

}  // namespace

Action add_slice(Arguments arguments) {
  const auto options = std::make_shared<SliceOptions>();
  arguments.positional("source", "DUMP|RAM.bin", options->source, "a GPU dump, or a RAM image with --head",
                       Presence::required);
  arguments.number("--frame", "F", options->frame, std::uint64_t{1}, std::uint64_t{1} << 40,
                   "the frame at whose end the pixels are looked at, from 1 [1]");
  arguments.text("--pixel", "X,Y", options->pixel, "the pixel of the display area, or the top left one",
                 Presence::required);
  arguments.text("--size", "WxH", options->size, "how many pixels [1x1]");
  arguments.flag("--vram", options->vram, "X,Y is a place in VRAM");
  arguments.text("-o,--output", "FILE", options->output,
                 "the dump to write; packed if its name ends in .zst or .xz", Presence::required);
  arguments.choice("--format", options->format, {"standard", "v1"},
                   "standard: v1r1, aligned; v1: the older form [standard]");
  add_source_options(arguments, options->source_options);
  return [options] { return run_slice(*options); };
}

}  // namespace app
