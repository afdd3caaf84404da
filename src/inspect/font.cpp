// The smallest letters that can be read.

#include <array>
#include <cctype>

#include "inspect/maps.h"

namespace inspect {
namespace {

struct Glyph {
  char character;
  std::array<const char*, 5> rows;
};

constexpr std::array<Glyph, 44> glyphs{{
    {'A', {" # ", "# #", "###", "# #", "# #"}}, {'B', {"## ", "# #", "## ", "# #", "## "}},
    {'C', {" ##", "#  ", "#  ", "#  ", " ##"}}, {'D', {"## ", "# #", "# #", "# #", "## "}},
    {'E', {"###", "#  ", "## ", "#  ", "###"}}, {'F', {"###", "#  ", "## ", "#  ", "#  "}},
    {'G', {" ##", "#  ", "# #", "# #", " ##"}}, {'H', {"# #", "# #", "###", "# #", "# #"}},
    {'I', {"###", " # ", " # ", " # ", "###"}}, {'J', {"  #", "  #", "  #", "# #", " # "}},
    {'K', {"# #", "# #", "## ", "# #", "# #"}}, {'L', {"#  ", "#  ", "#  ", "#  ", "###"}},
    {'M', {"# #", "###", "###", "# #", "# #"}}, {'N', {"## ", "# #", "# #", "# #", "# #"}},
    {'O', {" # ", "# #", "# #", "# #", " # "}}, {'P', {"## ", "# #", "## ", "#  ", "#  "}},
    {'Q', {" # ", "# #", "# #", " ##", "  #"}}, {'R', {"## ", "# #", "## ", "# #", "# #"}},
    {'S', {" ##", "#  ", " # ", "  #", "## "}}, {'T', {"###", " # ", " # ", " # ", " # "}},
    {'U', {"# #", "# #", "# #", "# #", "###"}}, {'V', {"# #", "# #", "# #", "# #", " # "}},
    {'W', {"# #", "# #", "###", "###", "# #"}}, {'X', {"# #", "# #", " # ", "# #", "# #"}},
    {'Y', {"# #", "# #", " # ", " # ", " # "}}, {'Z', {"###", "  #", " # ", "#  ", "###"}},
    {'0', {"###", "# #", "# #", "# #", "###"}}, {'1', {" # ", "## ", " # ", " # ", "###"}},
    {'2', {"## ", "  #", " # ", "#  ", "###"}}, {'3', {"## ", "  #", " # ", "  #", "## "}},
    {'4', {"# #", "# #", "###", "  #", "  #"}}, {'5', {"###", "#  ", "## ", "  #", "## "}},
    {'6', {" ##", "#  ", "###", "# #", "###"}}, {'7', {"###", "  #", " # ", " # ", " # "}},
    {'8', {"###", "# #", "###", "# #", "###"}}, {'9', {"###", "# #", "###", "  #", "## "}},
    {'-', {"   ", "   ", "###", "   ", "   "}}, {'.', {"   ", "   ", "   ", "   ", " # "}},
    {':', {"   ", " # ", "   ", " # ", "   "}}, {'%', {"# #", "  #", " # ", "#  ", "# #"}},
    {'(', {" # ", "#  ", "#  ", "#  ", " # "}}, {')', {" # ", "  #", "  #", "  #", " # "}},
    {',', {"   ", "   ", "   ", " # ", "#  "}}, {'+', {"   ", " # ", "###", " # ", "   "}},
}};

const Glyph* find(char c) {
  const char upper = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (const Glyph& glyph : glyphs) {
    if (glyph.character == upper) return &glyph;
  }
  return nullptr;  // blank
}

}  // namespace

int draw_text(base::Picture& image, int x, int y, std::string_view text, base::Rgba colour, int scale) {
  for (const char c : text) {
    const Glyph* glyph = find(c);
    for (int row = 0; glyph != nullptr && row < 5 * scale; ++row) {
      for (int column = 0; column < 3 * scale; ++column) {
        if (glyph->rows[static_cast<std::size_t>(row / scale)][column / scale] != '#') continue;
        if (x + column < image.width && y + row < image.height) image.at(x + column, y + row) = colour;
      }
    }
    x += 4 * scale;
  }
  return x;
}

}  // namespace inspect
