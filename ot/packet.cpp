#include "ot/packet.h"

#include <algorithm>

namespace ot {
namespace {

constexpr std::uint32_t opcode(std::uint32_t code) { return gp0::Opcode::put(code); }

constexpr std::uint32_t word(Rgb c) {
  return gp0::colour::R::put(c.r) | gp0::colour::G::put(c.g) | gp0::colour::B::put(c.b);
}
constexpr Rgb rgb(std::uint32_t w) {
  return {static_cast<std::uint8_t>(gp0::colour::R::get(w)),
          static_cast<std::uint8_t>(gp0::colour::G::get(w)),
          static_cast<std::uint8_t>(gp0::colour::B::get(w))};
}

constexpr std::uint32_t word(Xy p) {
  return gp0::vertex::X::put_signed(p.x) | gp0::vertex::Y::put_signed(p.y);
}
constexpr Xy xy(std::uint32_t w) {
  return {static_cast<std::int16_t>(gp0::vertex::X::get_signed(w)),
          static_cast<std::int16_t>(gp0::vertex::Y::get_signed(w))};
}

constexpr std::uint32_t word(Uv t, std::uint32_t high = 0) {
  return gp0::texcoord::U::put(t.u) | gp0::texcoord::V::put(t.v) | gp0::texcoord::Clut::put(high);
}
constexpr Uv uv(std::uint32_t w) {
  return {static_cast<std::uint8_t>(gp0::texcoord::U::get(w)),
          static_cast<std::uint8_t>(gp0::texcoord::V::get(w))};
}

constexpr std::uint32_t pair(std::uint16_t low, std::uint16_t high) {
  return gp0::area::X::put(low) | gp0::area::Y::put(high);
}
constexpr std::uint16_t low(std::uint32_t w) { return static_cast<std::uint16_t>(gp0::area::X::get(w)); }
constexpr std::uint16_t high(std::uint32_t w) { return static_cast<std::uint16_t>(gp0::area::Y::get(w)); }

std::uint32_t first_word(const Polygon& p) {
  using namespace gp0::polygon;
  return opcode(0x20) | IsQuad::put(p.quad) | IsGouraud::put(p.gouraud) | IsTextured::put(p.textured) |
         IsSemiTransparent::put(p.semi_transparent) | IsRaw::put(p.raw) | word(p.rgb[0]);
}

std::uint32_t first_word(const Rectangle& r) {
  using namespace gp0::rectangle;
  return opcode(0x60) | Size::put(static_cast<std::uint32_t>(r.size)) | IsTextured::put(r.textured) |
         IsSemiTransparent::put(r.semi_transparent) | IsRaw::put(r.raw) | word(r.rgb);
}

std::uint32_t high_byte(std::uint32_t z) { return z >> 24; }

/// Words of E7h: none, the one of v0..v2, or both.
std::size_t high_words(const DepthAnnotation& a) {
  if (!a.has_depth) return 0;
  if (a.count == 4 && high_byte(a.z[3]) != 0) return 2;
  return std::ranges::any_of(a.z.begin(), a.z.begin() + 3, [](auto z) { return high_byte(z) != 0; }) ? 1 : 0;
}

/// Writes words to the front of a span and counts them.
struct Writer {
  std::span<std::uint32_t> out;
  std::size_t count = 0;
  void put(std::uint32_t w) {
    assert(count < out.size());
    out[count++] = w;
  }
};

}  // namespace

std::size_t word_count(const Polygon& p) { return gp0::polygon::words(first_word(p)); }
std::size_t word_count(const Rectangle& r) { return gp0::rectangle::words(first_word(r)); }
std::size_t word_count(const Line& l) { return l.gouraud ? 4 : 3; }
std::size_t word_count(const Polyline& l) { return l.xy.size() + (l.gouraud ? l.xy.size() : 1) + 1; }
std::size_t word_count(const DepthAnnotation& a) {
  return static_cast<std::size_t>(a.count) * ((a.has_depth ? 1 : 0) + (a.has_fractions ? 1 : 0)) +
         high_words(a);
}

std::size_t encode(const Polygon& p, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(first_word(p));
  const std::array<std::uint16_t, 4> halves{p.clut, p.texpage, 0, 0};
  for (std::size_t v = 0; v < p.vertices(); ++v) {
    if (p.gouraud && v > 0) w.put(word(p.rgb[v]));
    w.put(word(p.xy[v]));
    if (p.textured) w.put(word(p.uv[v], halves[v]));
  }
  return w.count;
}

std::size_t encode(const Rectangle& r, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(first_word(r));
  w.put(word(r.xy));
  if (r.textured) w.put(word(r.uv, r.clut));
  if (r.size == RectangleSize::variable) {
    w.put(gp0::rectangle::Width::put(r.width) | gp0::rectangle::Height::put(r.height));
  }
  return w.count;
}

std::size_t encode(const Line& l, std::span<std::uint32_t> out) {
  using namespace gp0::line;
  Writer w{out};
  w.put(opcode(0x40) | IsGouraud::put(l.gouraud) | IsSemiTransparent::put(l.semi_transparent) |
        word(l.rgb[0]));
  w.put(word(l.xy[0]));
  if (l.gouraud) w.put(word(l.rgb[1]));
  w.put(word(l.xy[1]));
  return w.count;
}

std::size_t encode(const Polyline& l, std::span<std::uint32_t> out) {
  using namespace gp0::line;
  assert(l.xy.size() >= 2 && l.rgb.size() >= (l.gouraud ? l.xy.size() : 1));
  Writer w{out};
  w.put(opcode(0x48) | IsGouraud::put(l.gouraud) | IsSemiTransparent::put(l.semi_transparent) |
        word(l.rgb[0]));
  for (std::size_t v = 0; v < l.xy.size(); ++v) {
    if (l.gouraud && v > 0) w.put(word(l.rgb[v]));
    w.put(word(l.xy[v]));
  }
  w.put(terminator);
  return w.count;
}

std::size_t encode(const Fill& f, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(opcode(0x02) | word(f.rgb));
  w.put(pair(f.x, f.y));
  w.put(pair(f.width, f.height));
  return w.count;
}

std::size_t encode(const Copy& c, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(opcode(0x80));
  w.put(pair(c.from_x, c.from_y));
  w.put(pair(c.to_x, c.to_y));
  w.put(pair(c.width, c.height));
  return w.count;
}

std::size_t encode(const Upload& u, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(opcode(0xa0));
  w.put(pair(u.x, u.y));
  w.put(pair(u.width, u.height));
  return w.count;
}

std::size_t encode(const Download& d, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(opcode(0xc0));
  w.put(pair(d.x, d.y));
  w.put(pair(d.width, d.height));
  return w.count;
}

std::size_t encode(const DrawMode& m, std::span<std::uint32_t> out) {
  using namespace gp0::draw_mode;
  Writer w{out};
  w.put(make(m.texpage & page_bits) | Dither::put(m.dither) | DrawToDisplay::put(m.draw_to_display) |
        FlipX::put(m.flip_x) | FlipY::put(m.flip_y));
  return w.count;
}

std::size_t encode(const TextureWindow& t, std::span<std::uint32_t> out) {
  using namespace gp0::texture_window;
  Writer w{out};
  w.put(make(MaskX::put(t.mask_x) | MaskY::put(t.mask_y) | OffsetX::put(t.offset_x) |
             OffsetY::put(t.offset_y)));
  return w.count;
}

std::size_t encode(const DrawArea& a, std::span<std::uint32_t> out) {
  using namespace gp0::draw_area;
  Writer w{out};
  w.put(opcode(0xe3) | X::put(a.left) | Y::put(a.top));
  w.put(opcode(0xe4) | X::put(a.right) | Y::put(a.bottom));
  return w.count;
}

std::size_t encode(const DrawOffset& o, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(opcode(0xe5) | gp0::draw_offset::X::put_signed(o.xy.x) | gp0::draw_offset::Y::put_signed(o.xy.y));
  return w.count;
}

std::size_t encode(const MaskBits& m, std::span<std::uint32_t> out) {
  Writer w{out};
  w.put(opcode(0xe6) | gp0::mask_bits::Set::put(m.set) | gp0::mask_bits::Test::put(m.test));
  return w.count;
}

std::size_t encode(const DepthAnnotation& a, std::span<std::uint32_t> out) {
  using namespace gp0::annotation;
  assert(a.count == 3 || a.count == 4);
  Writer w{out};
  const auto vertices = static_cast<std::uint32_t>(a.count);
  for (std::uint32_t v = 0; v < vertices && a.has_depth; ++v)
    w.put(opcode(depth_low + v) | DepthLow::put(a.z[v]));
  const auto highs = high_words(a);
  if (highs > 0) {
    w.put(opcode(depth_high) | High0::put(high_byte(a.z[0])) | High1::put(high_byte(a.z[1])) |
          High2::put(high_byte(a.z[2])));
  }
  if (highs > 1) w.put(opcode(depth_high) | High0::put(high_byte(a.z[3])));
  if (a.has_fractions) {
    for (std::uint32_t v = 0; v < vertices; ++v) {
      w.put(opcode(fraction + v) | FractionX::put(a.fx[v]) | FractionY::put(a.fy[v]) |
            TexelRestU::put_signed(a.du[v]) | TexelRestV::put_signed(a.dv[v]));
    }
  }
  return w.count;
}

Polygon decode_polygon(std::span<const std::uint32_t> words) {
  using namespace gp0::polygon;
  assert(words.size() >= gp0::polygon::words(words[0]));
  const auto first = words[0];
  Polygon p{.quad = IsQuad::get(first) != 0,
            .gouraud = IsGouraud::get(first) != 0,
            .textured = IsTextured::get(first) != 0,
            .semi_transparent = IsSemiTransparent::get(first) != 0,
            .raw = IsRaw::get(first) != 0};
  std::size_t at = 1;
  p.rgb[0] = rgb(first);
  for (std::size_t v = 0; v < p.vertices(); ++v) {
    if (p.gouraud && v > 0) p.rgb[v] = rgb(words[at++]);
    p.xy[v] = xy(words[at++]);
    if (!p.textured) continue;
    if (v == 0) p.clut = high(words[at]);
    if (v == 1) p.texpage = high(words[at]);
    p.uv[v] = uv(words[at++]);
  }
  return p;
}

Rectangle decode_rectangle(std::span<const std::uint32_t> words) {
  using namespace gp0::rectangle;
  assert(words.size() >= gp0::rectangle::words(words[0]));
  const auto first = words[0];
  Rectangle r{.size = static_cast<RectangleSize>(Size::get(first)),
              .textured = IsTextured::get(first) != 0,
              .semi_transparent = IsSemiTransparent::get(first) != 0,
              .raw = IsRaw::get(first) != 0,
              .xy = xy(words[1]),
              .rgb = rgb(first)};
  if (r.textured) {
    r.uv = uv(words[2]);
    r.clut = high(words[2]);
  }
  if (r.size == RectangleSize::variable) {
    const auto size = words[r.textured ? 3 : 2];
    r.width = static_cast<std::uint16_t>(Width::get(size));
    r.height = static_cast<std::uint16_t>(Height::get(size));
  }
  return r;
}

Line decode_line(std::span<const std::uint32_t> words) {
  using namespace gp0::line;
  assert(words.size() >= gp0::line::words(words[0]));
  Line l{.gouraud = IsGouraud::get(words[0]) != 0, .semi_transparent = IsSemiTransparent::get(words[0]) != 0};
  l.rgb[0] = rgb(words[0]);
  l.xy[0] = xy(words[1]);
  if (l.gouraud) l.rgb[1] = rgb(words[2]);
  l.xy[1] = xy(words[l.gouraud ? 3 : 2]);
  return l;
}

Fill decode_fill(std::span<const std::uint32_t> w) {
  assert(w.size() >= 3);
  return {.rgb = rgb(w[0]), .x = low(w[1]), .y = high(w[1]), .width = low(w[2]), .height = high(w[2])};
}

Copy decode_copy(std::span<const std::uint32_t> w) {
  assert(w.size() >= 4);
  return {.from_x = low(w[1]),
          .from_y = high(w[1]),
          .to_x = low(w[2]),
          .to_y = high(w[2]),
          .width = low(w[3]),
          .height = high(w[3])};
}

Upload decode_upload(std::span<const std::uint32_t> w) {
  assert(w.size() >= 3);
  return {.x = low(w[1]), .y = high(w[1]), .width = low(w[2]), .height = high(w[2])};
}

Download decode_download(std::span<const std::uint32_t> w) {
  assert(w.size() >= 3);
  return {.x = low(w[1]), .y = high(w[1]), .width = low(w[2]), .height = high(w[2])};
}

std::optional<std::uint32_t> PacketArena::push(std::span<const std::uint32_t> payload) {
  assert(payload.size() <= tag::Length::max);
  const auto length = static_cast<std::uint32_t>(payload.size());
  if (free_bytes() < 4 * (length + 1)) return std::nullopt;
  const auto at = next_;
  const auto words = ram_->words();
  words[at / 4] = tag::make(tag::end, length);
  std::ranges::copy(payload, words.begin() + at / 4 + 1);
  next_ += 4 * (length + 1);
  return at;
}

}  // namespace ot
