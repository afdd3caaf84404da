#include "ot/describe.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>

#include "ot/gp1.h"
#include "ot/packet.h"

namespace ot {
namespace {

using gp0::Command;
using Words = std::span<const std::uint32_t>;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 160> text;
  const int size = std::snprintf(text.data(), text.size(), pattern, values...);
  return {text.data(), std::min(text.size() - 1, static_cast<std::size_t>(std::max(size, 0)))};
}

std::string text(Xy p) { return format(" (%d,%d)", p.x, p.y); }
std::string text(Rgb c) { return format(" %02x%02x%02x", c.r, c.g, c.b); }
std::string text(Uv t) { return format(" uv %u,%u", t.u, t.v); }
std::string clut_text(std::uint16_t clut) {
  return format(" clut %u,%u", static_cast<unsigned>(gp0::clut::X16::get(clut) * 16),
                static_cast<unsigned>(gp0::clut::Y::get(clut)));
}

std::string page_text(std::uint32_t page) {
  using namespace gp0::draw_mode;
  static constexpr std::array formats{"4-bit", "8-bit", "15-bit", "15-bit"};
  static constexpr std::array blends{"(B+F)/2", "B+F", "B-F", "B+F/4"};
  return format(" page %u,%u %s blend %s", static_cast<unsigned>(PageX64::get(page) * 64),
                static_cast<unsigned>(PageY256::get(page) * 256), formats[Format::get(page)],
                blends[gp0::draw_mode::Blend::get(page)]);
}

std::string flags(bool gouraud, bool textured, bool semi_transparent, bool raw) {
  std::string out;
  if (gouraud) out += ", gouraud";
  if (textured) out += raw ? ", raw texture" : ", textured";
  if (semi_transparent) out += ", semi-transparent";
  return out;
}

std::string polygon(Words words) {
  const auto p = decode_polygon(words);
  auto out =
      std::string(p.quad ? "quad" : "triangle") + flags(p.gouraud, p.textured, p.semi_transparent, p.raw);
  for (std::size_t v = 0; v < p.vertices(); ++v) {
    out += text(p.xy[v]);
    if (p.gouraud) out += text(p.rgb[v]);
    if (p.textured) out += text(p.uv[v]);
  }
  if (!p.gouraud && !(p.textured && p.raw)) out += text(p.rgb[0]);
  if (p.textured) out += clut_text(p.clut) + page_text(p.texpage);
  return out;
}

std::string rectangle(Words words) {
  const auto r = decode_rectangle(words);
  static constexpr std::array<int, 4> sizes{0, 1, 8, 16};
  const auto fixed = sizes[static_cast<std::size_t>(r.size)];
  const bool variable = r.size == RectangleSize::variable;
  auto out = "rectangle" + flags(false, r.textured, r.semi_transparent, r.raw) + text(r.xy) +
             format(" %dx%d", variable ? r.width : fixed, variable ? r.height : fixed);
  if (!(r.textured && r.raw)) out += text(r.rgb);
  if (r.textured) out += text(r.uv) + clut_text(r.clut);
  return out;
}

std::string line(Words words) {
  const auto l = decode_line(words);
  auto out = "line" + flags(l.gouraud, false, l.semi_transparent, false) + text(l.xy[0]);
  if (l.gouraud) out += text(l.rgb[0]);
  out += text(l.xy[1]);
  return out + text(l.rgb[l.gouraud ? 1 : 0]);
}

std::string polyline(Words words, std::uint64_t length) {
  const auto first = decode_line(words);
  const auto vertices = first.gouraud ? (length - 1) / 2 : length - 2;
  return "polyline" + flags(first.gouraud, false, first.semi_transparent, false) +
         format(" of %llu vertices", static_cast<unsigned long long>(vertices)) + text(first.xy[0]) +
         text(first.xy[1]) + (vertices > 2 ? " ..." : "") + text(first.rgb[0]);
}

std::string position(std::uint32_t word) {
  return format(" (%u,%u)", static_cast<unsigned>(gp0::area::X::get(word)),
                static_cast<unsigned>(gp0::area::Y::get(word)));
}

std::string area(std::uint32_t corner, std::uint32_t size) {
  return position(corner) + format(" %ux%u", static_cast<unsigned>(gp0::area::Width::get(size)),
                                   static_cast<unsigned>(gp0::area::Height::get(size)));
}

std::string draw_mode(std::uint32_t word) {
  using namespace gp0::draw_mode;
  std::string out = "draw mode" + page_text(word);
  if (Dither::get(word) != 0) out += ", dither";
  if (DrawToDisplay::get(word) != 0) out += ", draws to the displayed field";
  if (TextureDisable::get(word) != 0) out += ", textures off";
  if (FlipX::get(word) != 0) out += ", x flip";
  if (FlipY::get(word) != 0) out += ", y flip";
  return out;
}

std::string texture_window(std::uint32_t word) {
  using namespace gp0::texture_window;
  return format("texture window mask %u,%u offset %u,%u", static_cast<unsigned>(MaskX::get(word) * 8),
                static_cast<unsigned>(MaskY::get(word) * 8), static_cast<unsigned>(OffsetX::get(word) * 8),
                static_cast<unsigned>(OffsetY::get(word) * 8));
}

std::string annotation(std::uint32_t word) {
  using namespace gp0::annotation;
  const auto code = gp0::Opcode::get(word);
  if (code == depth_high) return format("depth, high bytes %06x", static_cast<unsigned>(DepthLow::get(word)));
  if (code < fraction) {
    return format("depth of vertex %u: %.4f", static_cast<unsigned>(code - depth_low),
                  DepthLow::get(word) / 4096.0);
  }
  auto text =
      format("fractions of vertex %u: %u/256,%u/256", static_cast<unsigned>(code - fraction),
             static_cast<unsigned>(FractionX::get(word)), static_cast<unsigned>(FractionY::get(word)));
  const int u = TexelRestU::get_signed(word), v = TexelRestV::get_signed(word);
  if (u != 0 || v != 0) text += format(", texel %+d/8,%+d/8", u, v);
  return text;
}

}  // namespace

std::string describe(Words w, std::uint64_t length) {
  assert(!w.empty() && w.size() >= std::min<std::size_t>(gp0::command_words(w[0]), length));
  const auto corner = [&](const char* name) {
    return format("%s %u,%u", name, static_cast<unsigned>(gp0::draw_area::X::get(w[0])),
                  static_cast<unsigned>(gp0::draw_area::Y::get(w[0])));
  };
  switch (gp0::command_of(w[0])) {
    case Command::nop:
      return gp0::Opcode::get(w[0]) == 0 ? "nothing" : "unknown, nothing";
    case Command::clear_cache:
      return "clear cache";
    case Command::irq:
      return "interrupt";
    case Command::fill:
      return "fill" + area(w[1], w[2]) + text(decode_fill(w).rgb);
    case Command::polygon:
      return polygon(w);
    case Command::line:
      return line(w);
    case Command::polyline:
      return polyline(w, length);
    case Command::rectangle:
      return rectangle(w);
    case Command::copy:
      return "copy from" + area(w[1], w[3]) + " to" + position(w[2]);
    case Command::upload:
      return "upload to" + area(w[1], w[2]);
    case Command::download:
      return "read from" + area(w[1], w[2]);
    case Command::draw_mode:
      return draw_mode(w[0]);
    case Command::texture_window:
      return texture_window(w[0]);
    case Command::area_top_left:
      return corner("drawing area from");
    case Command::area_bottom_right:
      return corner("drawing area to");
    case Command::draw_offset:
      return format("drawing offset %d,%d", static_cast<int>(gp0::draw_offset::X::get_signed(w[0])),
                    static_cast<int>(gp0::draw_offset::Y::get_signed(w[0])));
    case Command::mask_bits:
      return format("mask bit: %s, %s", gp0::mask_bits::Set::get(w[0]) != 0 ? "set" : "not set",
                    gp0::mask_bits::Test::get(w[0]) != 0 ? "tested" : "not tested");
    case Command::annotation:
      return annotation(w[0]);
  }
  return {};
}

std::string describe_control(std::uint32_t word) {
  using gp1::Command;
  const auto pair = [](const char* name, std::uint32_t first, const char* between, std::uint32_t second) {
    return format("%s %u%s%u", name, static_cast<unsigned>(first), between, static_cast<unsigned>(second));
  };
  switch (gp1::command_of(word)) {
    case Command::reset:
      return "reset";
    case Command::clear_fifo:
      return "clear FIFO";
    case Command::acknowledge_irq:
      return "acknowledge interrupt";
    case Command::display_off:
      return gp1::display_off::IsOff::get(word) != 0 ? "display off" : "display on";
    case Command::dma_direction:
      return format("DMA direction %u", static_cast<unsigned>(gp1::dma_direction::Direction::get(word)));
    case Command::display_start: {
      using namespace gp1::display_start;
      return pair("display from", X::get(word), ",", Y::get(word));
    }
    case Command::horizontal_range: {
      using namespace gp1::horizontal_range;
      return pair("horizontal range", X1::get(word), "..", X2::get(word));
    }
    case Command::vertical_range: {
      using namespace gp1::vertical_range;
      return pair("vertical range", Y1::get(word), "..", Y2::get(word));
    }
    case Command::display_mode: {
      using namespace gp1::display_mode;
      auto out = format("display mode %d wide", width(word));
      if (Is480Lines::get(word) != 0) out += ", 480 lines";
      if (IsPal::get(word) != 0) out += ", PAL";
      if (Is24Bit::get(word) != 0) out += ", 24 bit";
      if (IsInterlaced::get(word) != 0) out += ", interlaced";
      return out;
    }
    case Command::allow_texture_disable: {
      using namespace gp1::allow_texture_disable;
      return IsAllowed::get(word) != 0 ? "allow textures off" : "forbid textures off";
    }
    case Command::read_register:
      return format("read register %u", static_cast<unsigned>(gp1::read_register::Number::get(word)));
    case Command::unknown:
      break;
  }
  return "unknown, nothing";
}

std::string address_text(std::uint32_t address) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%06Xh", static_cast<unsigned>(address));
  return text.data();
}

}  // namespace ot
