#include "cost/packet_edit.h"

#include <algorithm>
#include <array>
#include <utility>

#include "gpu/rules.h"
#include "ot/gp0.h"
#include "ot/packet.h"

namespace cost {
namespace {

namespace gp0 = ot::gp0;

using gpu::Blend;
using gpu::Primitive;
using gpu::TexelFormat;

template <TexelFormat F>
bool has_texels(const Primitive& p) {
  return p.is_textured() && p.state.texel_format() == F;
}
template <Blend B>
bool blends(const Primitive& p) {
  return p.is_semi_transparent() && p.state.blend() == B;
}
bool is_gouraud(const Primitive& p) {
  return (p.kind == gpu::Kind::polygon || p.kind == gpu::Kind::line) && p.is_gouraud() && !p.is_raw();
}
bool is_modulated(const Primitive& p) { return p.is_textured() && !p.is_raw(); }
bool is_windowed(const Primitive& p) {
  return p.is_textured() && (p.state.texture_window & gp0::texture_window::masks) != 0;
}
bool sets_mask(const Primitive& p) { return p.kind <= gpu::Kind::line && p.state.mask_set() != 0; }
bool tests_mask(const Primitive& p) { return p.kind <= gpu::Kind::line && p.state.mask_test() != 0; }

enum Index : std::size_t {
  clut4,
  clut8,
  direct15,
  modulation,
  gouraud,
  average,
  add,
  subtract,
  add_quarter,
  dither,
  window,
  mask_set,
  mask_test
};

constexpr std::array table{
    PacketEffect{"texture, 4-bit", has_texels<TexelFormat::clut4>},
    PacketEffect{"texture, 8-bit", has_texels<TexelFormat::clut8>},
    PacketEffect{"texture, 15-bit", has_texels<TexelFormat::direct15>},
    PacketEffect{"modulated texels", is_modulated},
    PacketEffect{"Gouraud shading", is_gouraud},
    PacketEffect{"blend B/2+F/2", blends<Blend::average>},
    PacketEffect{"blend B+F", blends<Blend::add>},
    PacketEffect{"blend B-F", blends<Blend::subtract>},
    PacketEffect{"blend B+F/4", blends<Blend::add_quarter>},
    PacketEffect{"dither", gpu::is_dithered},
    PacketEffect{"texture window", is_windowed},
    PacketEffect{"set mask bit", sets_mask},
    PacketEffect{"test mask bit", tests_mask},
};

/// The parts of a polygon's words that editing moves.
struct PolygonWords {
  std::uint32_t command;
  std::array<std::uint32_t, 4> colour{}, xy{}, uv{};
  std::size_t count;

  explicit PolygonWords(std::span<const std::uint32_t> w)
      : command(w[0]), count(gp0::polygon::vertices(w[0])) {
    std::size_t at = 1;
    for (std::size_t v = 0; v < count; ++v) {
      colour[v] = v != 0 && gp0::polygon::IsGouraud::get(command) != 0 ? w[at++] : command & 0xffffff;
      xy[v] = w[at++];
      if (gp0::polygon::IsTextured::get(command) != 0) uv[v] = w[at++];
    }
  }
  void append_to(std::vector<std::uint32_t>& out) const {
    for (std::size_t v = 0; v < count; ++v) {
      if (v == 0) out.push_back(command);
      if (v != 0 && gp0::polygon::IsGouraud::get(command) != 0) out.push_back(colour[v]);
      out.push_back(xy[v]);
      if (gp0::polygon::IsTextured::get(command) != 0) out.push_back(uv[v]);
    }
  }
};

constexpr std::uint32_t gouraud_bit = gp0::polygon::IsGouraud::mask,
                        textured_bit = gp0::polygon::IsTextured::mask,
                        semi_bit = gp0::polygon::IsSemiTransparent::mask, raw_bit = gp0::polygon::IsRaw::mask;

/// What of the draw mode polygons read.
using PolygonMode = ot::Field<0, 11>;

/// Follows the draw mode as the GPU does and edits what comes by.
class Editor {
 public:
  explicit Editor(std::size_t effect) : effect_(effect) {}

  void take(std::span<const std::uint32_t> words) {
    switch (gp0::command_of(words[0])) {
      case gp0::Command::polygon:
        return polygon(PolygonWords(words));
      case gp0::Command::line:
        return line(words);
      case gp0::Command::draw_mode:
        mode_ = PolygonMode::get(words[0]);
        return attribute(words[0], effect_ == dither ? gp0::draw_mode::Dither::mask : 0);
      case gp0::Command::texture_window:
        return attribute(words[0], effect_ == window ? gp0::texture_window::masks : 0);
      case gp0::Command::mask_bits:
        return attribute(words[0], effect_ == mask_set    ? gp0::mask_bits::Set::mask
                                   : effect_ == mask_test ? gp0::mask_bits::Test::mask
                                                          : 0);
      default:
        out.insert(out.end(), words.begin(), words.end());
    }
  }

  std::vector<std::uint32_t> out;

 private:
  void attribute(std::uint32_t word, std::uint32_t cleared) { out.push_back(word & ~cleared); }

  [[nodiscard]] bool is_blend() const { return effect_ >= average && effect_ <= add_quarter; }
  [[nodiscard]] bool blends_so() const {
    return is_blend() && gp0::draw_mode::Blend::get(mode_) == effect_ - average;
  }

  void polygon(PolygonWords p) {
    const bool textured = (p.command & textured_bit) != 0;
    constexpr std::uint32_t page = gp0::draw_mode::page_bits & ~gp0::draw_mode::TextureDisable::mask;
    if (textured) mode_ = (mode_ & ~page) | (gp0::texcoord::Texpage::get(p.uv[1]) & page);
    const auto format = std::min<std::size_t>(gp0::draw_mode::Format::get(mode_), direct15);
    if (textured && effect_ <= direct15 && format == effect_) {
      // The page of a textured polygon stays in force; without it the draw mode must say the same.
      out.push_back(gp0::draw_mode::make(mode_));
      p.command &= ~(textured_bit | raw_bit);
    }
    if (effect_ == modulation && textured) p.command |= raw_bit;
    if (effect_ == gouraud) p.command &= ~gouraud_bit;
    if (blends_so()) p.command &= ~semi_bit;
    p.append_to(out);
  }

  void line(std::span<const std::uint32_t> words) {
    const bool shaded = (words[0] & gouraud_bit) != 0;
    std::uint32_t command = words[0];
    if (blends_so()) command &= ~semi_bit;
    if (effect_ == gouraud && shaded) {
      out.insert(out.end(), {command & ~gouraud_bit, words[1], words[3]});
      return;
    }
    out.push_back(command);
    out.insert(out.end(), words.begin() + 1, words.end());
  }

  std::size_t effect_;
  std::uint32_t mode_ = 0;
};

}  // namespace

std::span<const PacketEffect> packet_effects() { return table; }

std::vector<std::uint32_t> without(std::span<const std::uint32_t> words, std::size_t index) {
  Editor editor(index);
  while (!words.empty()) {
    std::size_t length = gp0::command_words(words[0]);
    const auto command = gp0::command_of(words[0]);
    if (command == gp0::Command::upload && words.size() >= length)
      length += gp0::transfer::data_words(words[2]);
    if (command == gp0::Command::polyline) {
      while (length < words.size() && !gp0::line::is_terminator(words[length])) ++length;
      ++length;
    }
    length = std::min(length, words.size());
    editor.take(words.first(length));
    words = words.subspan(length);
  }
  return std::move(editor.out);
}

}  // namespace cost
