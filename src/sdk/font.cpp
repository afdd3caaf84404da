// The debug font. Its place in VRAM is part of the interface, because programs draw over it: 32 x 32 words of
// texture, sixteen letters of 8 x 8 a row from '!' on, and a CLUT of 16 entries in the row below. Every
// letter is a sprite of 8 x 8. The glyphs are our own.

#include <array>
#include <cctype>
#include <cstdarg>
#include <cstdio>
#include <string>
#include <vector>

#include "sdk/console.h"
#include "sdk/font_glyphs.h"
#include "sdk/include/psxgpu.h"

namespace {

constexpr int letter_size = 8, letters_a_row = 16, rows = 4;
constexpr char first_letter = '!';
constexpr int texture_width = letters_a_row * letter_size, texture_height = rows * letter_size;

struct Stream {
  int x = 0, y = 0, width = 0, height = 0, background = 0;
  std::size_t limit = 0;
  std::string text;
};

struct Font {
  std::uint16_t page = 0, clut = 0;
  std::vector<Stream> streams;
};
Font& font() {
  static auto& one = *new Font;
  return one;
}

/// 4 bits a texel, 1 where a letter is: one column free at its left, one row above it.
constexpr auto texture = [] {
  std::array<std::uint32_t, texture_width * texture_height / 8> words{};
  for (int n = 0; n < letters_a_row * rows; ++n) {
    const int left = n % letters_a_row * letter_size + 1, top = n / letters_a_row * letter_size + 1;
    for (int y = 0; y < sdk::glyph_height; ++y) {
      for (int x = 0; x < sdk::glyph_width; ++x) {
        const auto row = sdk::glyphs[static_cast<std::size_t>(n)][static_cast<std::size_t>(y)];
        if ((row >> (sdk::glyph_width - 1 - x) & 1) == 0) continue;
        const auto at = static_cast<std::size_t>((top + y) * texture_width + left + x);
        words[at / 8] |= 1U << (at % 8 * 4);
      }
    }
  }
  return words;
}();

bool is_drawn(char letter) { return letter > ' '; }

void make_letter(SPRT_8& sprite, char letter, int x, int y) {
  const int n = std::toupper(static_cast<unsigned char>(letter)) - first_letter;
  setSprt8(&sprite);
  setShadeTex(&sprite, 1);
  setXY0(&sprite, static_cast<int16_t>(x), static_cast<int16_t>(y));
  setUV0(&sprite, static_cast<uint8_t>(n % letters_a_row * letter_size),
         static_cast<uint8_t>(n / letters_a_row * letter_size));
  sprite.clut = font().clut;
}

/// The stream a program means: -1 is the one opened last.
Stream* stream(int id, const char* call, sdk::CallSite site) {
  auto& streams = font().streams;
  const auto index = id < 0 ? streams.size() - 1 : static_cast<std::size_t>(id);
  if (index < streams.size()) return &streams[index];
  sdk::the_console().lint.note(
      "bad-size", site, std::string(call) + ": stream " + std::to_string(id) + " was not opened by FntOpen");
  return nullptr;
}

void draw_background(const Stream& s) {
  TILE tile;
  setTile(&tile);
  setXY0(&tile, static_cast<int16_t>(s.x), static_cast<int16_t>(s.y));
  setWH(&tile, static_cast<int16_t>(s.width), static_cast<int16_t>(s.height));
  setRGB0(&tile, 0, 0, 0);
  constexpr int see_through = 2;
  if (s.background == see_through) setSemiTrans(&tile, 1);
  DrawPrim(&tile);
}

void draw_letters(const Stream& s) {
  int x = s.x, y = s.y;
  for (const char letter : s.text) {
    if (letter == '\n' || x - s.x > s.width - letter_size) {
      x = s.x;
      y += letter_size;
      if (letter == '\n') continue;
    }
    if (y - s.y > s.height - letter_size) break;
    if (is_drawn(letter)) {
      SPRT_8 sprite{};  // its colour counts for nothing, and is black
      make_letter(sprite, letter, x, y);
      DrawPrim(&sprite);
    }
    x += letter_size;
  }
}

}  // namespace

extern "C" {

void FntLoad(int x, int y) {
  static constexpr std::array<std::uint32_t, 8> colours{0x7fff0000};  // transparent, then white
  const auto at_x = static_cast<int16_t>(x), at_y = static_cast<int16_t>(y);
  const RECT area{at_x, at_y, texture_width / 4, texture_height};
  const RECT clut{at_x, static_cast<int16_t>(y + texture_height), 16, 1};
  LoadImage(&area, texture.data());
  LoadImage(&clut, colours.data());
  font().page = static_cast<std::uint16_t>(getTPage(0, 0, x, y));
  font().clut = static_cast<std::uint16_t>(getClut(x, y + texture_height));
  font().streams.clear();
}

void* FntSort(uint32_t* ot, void* pri, int x, int y, const char* text) {
  const auto* site = __builtin_return_address(0);
  if (!sdk::is_usable(ot, "FntSort", site) || !sdk::is_usable(pri, "FntSort", site) ||
      !sdk::is_usable(text, "FntSort", site)) {
    return pri;
  }
  auto* sprite = static_cast<SPRT_8*>(pri);
  int column = x;
  for (; *text != '\0'; ++text) {
    if (*text == '\n') {
      column = x;
      y += letter_size;
      continue;
    }
    if (is_drawn(*text)) {
      make_letter(*sprite, *text, column, y);
      addPrim(ot, sprite);
      ++sprite;
    }
    column += letter_size;
  }
  auto* page = reinterpret_cast<DR_TPAGE*>(sprite);
  setDrawTPage(page, 0, 0, font().page);
  addPrim(ot, page);
  return page + 1;
}

int FntOpen(int x, int y, int w, int h, int isbg, int n) {
  font().streams.push_back({x, y, w, h, isbg, static_cast<std::size_t>(n < 0 ? 0 : n), {}});
  return static_cast<int>(font().streams.size()) - 1;
}

int FntPrint(int id, const char* fmt, ...) {
  auto* s = stream(id, "FntPrint", __builtin_return_address(0));
  if (s == nullptr || !sdk::is_usable(fmt, "FntPrint", __builtin_return_address(0))) return -1;
  std::array<char, 1024> text{};
  va_list arguments;
  va_start(arguments, fmt);
  std::vsnprintf(text.data(), text.size(), fmt, arguments);
  va_end(arguments);
  s->text += text.data();
  if (s->text.size() > s->limit) s->text.resize(s->limit);
  return static_cast<int>(s->text.size());
}

void* FntFlush(int id) {
  auto* s = stream(id, "FntFlush", __builtin_return_address(0));
  if (s == nullptr) return nullptr;
  DR_TPAGE page;
  setDrawTPage(&page, 0, 0, font().page);
  DrawPrim(&page);
  if (s->background != 0) draw_background(*s);
  draw_letters(*s);
  s->text.clear();
  return nullptr;
}

}  // extern "C"
