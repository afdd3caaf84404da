#pragma once
// Builders of GP0 packets: plain values in, words out, and back. The arena puts payloads
// with their tags into main RAM.
//
// Every encode writes word_count(value) words to the front of `out`, which must be that long, and returns
// the number. Every decode takes the words of one complete command.

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "ot/gp0.h"
#include "ot/main_ram.h"

namespace ot {

/// A screen position. Vertices keep 11 bits of it (-1024..1023).
struct Xy {
  std::int16_t x = 0, y = 0;
  bool operator==(const Xy&) const = default;
};

struct Uv {
  std::uint8_t u = 0, v = 0;
  bool operator==(const Uv&) const = default;
};

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Rgb&) const = default;
};

/// A triangle or quad (20h-3Fh). Quads go 0-1 / 2-3, a Z: the GPU draws 0,1,2 and 1,2,3.
struct Polygon {
  bool quad = false, gouraud = false, textured = false, semi_transparent = false, raw = false;
  std::array<Xy, 4> xy{};
  std::array<Rgb, 4> rgb{};  ///< only rgb[0] unless gouraud; 80h leaves a texel unchanged
  std::array<Uv, 4> uv{};
  std::uint16_t clut = 0, texpage = 0;
  [[nodiscard]] std::size_t vertices() const { return quad ? 4 : 3; }
  bool operator==(const Polygon&) const = default;
};

enum class RectangleSize : std::uint8_t { variable, dot, square8, square16 };

struct Rectangle {
  RectangleSize size = RectangleSize::variable;
  bool textured = false, semi_transparent = false, raw = false;
  Xy xy{};
  Rgb rgb{};
  Uv uv{};
  std::uint16_t clut = 0;
  std::uint16_t width = 0, height = 0;  ///< 0..1023, 0..511; sent only when variable
  bool operator==(const Rectangle&) const = default;
};

/// One segment, both ends drawn.
struct Line {
  bool gouraud = false, semi_transparent = false;
  std::array<Xy, 2> xy{};
  std::array<Rgb, 2> rgb{};  ///< only rgb[0] unless gouraud
  bool operator==(const Line&) const = default;
};

/// Two vertices or more; the spans belong to the caller. A word that the GPU would take for the terminator
/// cannot come out of an encoded vertex (its upper bits are 0) nor out of a colour (its top byte is 0).
struct Polyline {
  bool gouraud = false, semi_transparent = false;
  std::span<const Xy> xy;
  std::span<const Rgb> rgb;  ///< one, or one per vertex when gouraud
};

/// 02h: ignores drawing area, offset and mask. x and the width are rounded to 16 pixels by the GPU.
struct Fill {
  Rgb rgb{};
  std::uint16_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Fill&) const = default;
};

/// 80h, VRAM to VRAM.
struct Copy {
  std::uint16_t from_x = 0, from_y = 0, to_x = 0, to_y = 0, width = 0, height = 0;
  bool operator==(const Copy&) const = default;
};

/// A0h: these three words, then gp0::transfer::data_words(size word) words of pixels.
struct Upload {
  std::uint16_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Upload&) const = default;
};

/// C0h, VRAM to CPU.
struct Download {
  std::uint16_t x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Download&) const = default;
};

/// E1h. Textured polygons bring their own page, depth and blend; rectangles use these.
struct DrawMode {
  std::uint16_t texpage = 0;  ///< texpage_of(...)
  bool dither = false, draw_to_display = false, flip_x = false, flip_y = false;
  bool operator==(const DrawMode&) const = default;
};

/// E2h, units of 8 texels: u' = (u & ~(mask * 8)) | ((offset & mask) * 8).
struct TextureWindow {
  std::uint8_t mask_x = 0, mask_y = 0, offset_x = 0, offset_y = 0;
  bool operator==(const TextureWindow&) const = default;
};

/// E3h and E4h, corners inclusive.
struct DrawArea {
  std::uint16_t left = 0, top = 0, right = 1023, bottom = 511;
  bool operator==(const DrawArea&) const = default;
};

/// E5h: added to every vertex.
struct DrawOffset {
  Xy xy{};
  bool operator==(const DrawOffset&) const = default;
};

/// E6h.
struct MaskBits {
  bool set = false, test = false;
  bool operator==(const MaskBits&) const = default;
};

/// What the console's words cannot say of the next polygon: E7h-EFh.
struct DepthAnnotation {
  std::array<std::uint32_t, 4> z{};        ///< view-space depth, unsigned 20.12, one per vertex
  std::array<std::uint8_t, 4> fx{}, fy{};  ///< the 8 bits below the integer screen coordinates
  /// Exact texture coordinates are the packet's and these, eighths of a texel, -8..7; texel i has its middle
  /// at i.
  std::array<std::int8_t, 4> du{}, dv{};
  bool has_depth = true;       ///< z counts
  bool has_fractions = false;  ///< fx, fy, du, dv count
  int count = 3;               ///< vertices: 3 or 4
  bool operator==(const DepthAnnotation&) const = default;
};

/// The texture page halfword: x a multiple of 64, y 0 or 256.
constexpr std::uint16_t texpage_of(unsigned x, unsigned y, Blend blend, TexelFormat format) {
  using namespace gp0::draw_mode;
  return static_cast<std::uint16_t>(PageX64::put(x / 64) | PageY256::put(y / 256) | put(blend) | put(format));
}

/// The CLUT halfword: x a multiple of 16.
constexpr std::uint16_t clut_of(unsigned x, unsigned y) {
  return static_cast<std::uint16_t>(gp0::clut::X16::put(x / 16) | gp0::clut::Y::put(y));
}

std::size_t word_count(const Polygon& p);
std::size_t word_count(const Rectangle& r);
std::size_t word_count(const Line& l);
std::size_t word_count(const Polyline& l);
std::size_t word_count(const DepthAnnotation& a);  ///< at most 10

std::size_t encode(const Polygon& p, std::span<std::uint32_t> out);
std::size_t encode(const Rectangle& r, std::span<std::uint32_t> out);
std::size_t encode(const Line& l, std::span<std::uint32_t> out);
std::size_t encode(const Polyline& l, std::span<std::uint32_t> out);
std::size_t encode(const Fill& f, std::span<std::uint32_t> out);           ///< 3 words
std::size_t encode(const Copy& c, std::span<std::uint32_t> out);           ///< 4 words
std::size_t encode(const Upload& u, std::span<std::uint32_t> out);         ///< 3 words
std::size_t encode(const Download& d, std::span<std::uint32_t> out);       ///< 3 words
std::size_t encode(const DrawMode& m, std::span<std::uint32_t> out);       ///< 1 word
std::size_t encode(const TextureWindow& w, std::span<std::uint32_t> out);  ///< 1 word
std::size_t encode(const DrawArea& a, std::span<std::uint32_t> out);       ///< 2 words
std::size_t encode(const DrawOffset& o, std::span<std::uint32_t> out);     ///< 1 word
std::size_t encode(const MaskBits& m, std::span<std::uint32_t> out);       ///< 1 word
std::size_t encode(const DepthAnnotation& a, std::span<std::uint32_t> out);

Polygon decode_polygon(std::span<const std::uint32_t> words);
Rectangle decode_rectangle(std::span<const std::uint32_t> words);
Line decode_line(std::span<const std::uint32_t> words);
Fill decode_fill(std::span<const std::uint32_t> words);
Copy decode_copy(std::span<const std::uint32_t> words);
Upload decode_upload(std::span<const std::uint32_t> words);
Download decode_download(std::span<const std::uint32_t> words);

/// Packets one behind the other in begin..end-1 (word aligned byte addresses inside RAM). The RAM must
/// outlive the arena.
class PacketArena {
 public:
  PacketArena(MainRam& ram, std::uint32_t begin, std::uint32_t end)
      : ram_(&ram), begin_(begin), end_(end), next_(begin) {
    assert(begin % 4 == 0 && end % 4 == 0 && begin <= end && end <= ram.size_bytes());
  }

  /// Stores a tag that ends the list and the payload (255 words at most) behind it. Returns the tag's
  /// address; nothing if the arena is full, and then nothing was stored.
  std::optional<std::uint32_t> push(std::span<const std::uint32_t> payload);

  void reset() { next_ = begin_; }
  [[nodiscard]] std::uint32_t used_bytes() const { return next_ - begin_; }
  [[nodiscard]] std::uint32_t free_bytes() const { return end_ - next_; }

 private:
  MainRam* ram_;
  std::uint32_t begin_, end_, next_;
};

/// Makes the tag at `from` point to the tag at `to` (or tag::end); its length stays.
inline void link(MainRam& ram, std::uint32_t from, std::uint32_t to) {
  ram.write(from, tag::Next::set(ram.read(from), to));
}

}  // namespace ot
