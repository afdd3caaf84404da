#include "app/commands/ram_image.h"

#include <array>
#include <charconv>
#include <cstddef>
#include <utility>

#include "base/read_file.h"
#include "display/vram_file.h"
#include "gpu/vram.h"
#include "ot/packet.h"

namespace app {
namespace {

/// Hexadecimal with or without 0x or h; the segment bits of a pointer are dropped.
std::optional<std::uint32_t> parse_address(std::string text) {
  if (text.starts_with("0x") || text.starts_with("0X")) text.erase(0, 2);
  if (text.ends_with('h') || text.ends_with('H')) text.pop_back();
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return ot::tag::Next::get(value);
}

base::Result<std::uint32_t> address_option(const char* option, const std::string& text) {
  if (const auto address = parse_address(text)) return *address;
  return base::fail(std::string(option) + ": expected a hexadecimal address such as 80123000, got '" + text +
                    "'");
}

base::Result<ot::MainRam> read_ram(const std::string& path) {
  const auto bytes = base::read_file(path, static_cast<std::uint64_t>(ot::RamSize::mib8));
  if (!bytes) return tl::make_unexpected(bytes.error());
  for (const auto size : {ot::RamSize::mib2, ot::RamSize::mib8}) {
    if (bytes->size() != static_cast<std::size_t>(size)) continue;
    ot::MainRam ram(size);
    const auto words = ram.words();
    for (std::size_t n = 0; n < bytes->size(); ++n) {
      words[n / 4] |= std::to_integer<std::uint32_t>((*bytes)[n]) << 8 * (n % 4);
    }
    return ram;
  }
  return base::fail(path + ": expected the 2097152 or 8388608 bytes of main RAM, got " +
                    std::to_string(bytes->size()));
}

base::Result<std::optional<inspect::TableRange>> table_option(const std::string& text,
                                                              const ot::MainRam& ram) {
  if (text.empty()) return std::nullopt;
  const auto comma = text.find(',');
  const auto address = parse_address(text.substr(0, comma));
  std::uint32_t length = 0;
  const auto number = comma == std::string::npos ? std::string() : text.substr(comma + 1);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), length);
  if (!address || error != std::errc() || end != number.data() + number.size() || length == 0 ||
      *address % 4 != 0) {
    return base::fail("--table: expected ADDR,N such as 80123000,1024, got '" + text + "'");
  }
  if (*address >= ram.size_bytes() || length > (ram.size_bytes() - *address) / 4) {
    return base::fail("--table: " + text + " does not lie within the " + std::to_string(ram.size_bytes()) +
                      " bytes of RAM");
  }
  return inspect::TableRange{*address, length};
}

}  // namespace

base::Result<debug::RamImage> read_ram_image(const std::string& path, const std::string& head,
                                             const std::string& table) {
  auto ram = read_ram(path);
  if (!ram) return tl::make_unexpected(ram.error());
  const auto first = address_option("--head", head);
  if (!first) return tl::make_unexpected(first.error());
  const auto range = table_option(table, *ram);
  if (!range) return tl::make_unexpected(range.error());
  return debug::RamImage{std::move(*ram), *first, *range};
}

base::Result<std::vector<std::uint16_t>> read_vram(const std::string& path) {
  if (path.empty()) return std::vector<std::uint16_t>();
  gpu::Vram vram;
  if (auto loaded = display::load_vram(path, vram); !loaded) return tl::make_unexpected(loaded.error());
  const auto pixels = vram.pixels();
  return std::vector<std::uint16_t>(pixels.begin(), pixels.end());
}

}  // namespace app
