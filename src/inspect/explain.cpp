// The message of a failed check.

#include <algorithm>
#include <string>
#include <vector>

#include "inspect/check.h"

namespace inspect {
namespace {

using gpu::Vram;

constexpr int most_columns = 72, most_rows = 24;

struct Box {
  int left = Vram::width, top = Vram::height, right = -1, bottom = -1;  // all inside
};

char letter(const WrongPixel& wrong) {
  constexpr const char* letters = "BXCTKLDP";  // in the order of Cause
  const auto cause = wrong.causes.first();
  return cause ? letters[static_cast<std::size_t>(*cause)] : '?';
}

Box box_of(const std::vector<const WrongPixel*>& pixels) {
  Box box;
  for (const WrongPixel* wrong : pixels) {
    const int x = static_cast<int>(wrong->pixel % Vram::width),
              y = static_cast<int>(wrong->pixel / Vram::width);
    box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x), std::max(box.bottom, y)};
  }
  return box;
}

void append_map(std::string& out, const std::vector<const WrongPixel*>& pixels, const Box& box) {
  const int columns = std::min(most_columns, box.right - box.left + 1);
  const int rows = std::min(most_rows, box.bottom - box.top + 1);
  std::vector<std::string> map(static_cast<std::size_t>(rows),
                               std::string(static_cast<std::size_t>(columns), '.'));
  for (const WrongPixel* wrong : pixels) {
    const int x = static_cast<int>(wrong->pixel % Vram::width) - box.left;
    const int y = static_cast<int>(wrong->pixel / Vram::width) - box.top;
    if (x < columns && y < rows)
      map[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = letter(*wrong);
  }
  for (const std::string& row : map) out.append("    ").append(row).append("\n");
  if (columns <= box.right - box.left || rows <= box.bottom - box.top)
    out += "    (the top left corner of it)\n";
}

}  // namespace

std::string explain(const Report& report, std::optional<Cause> cause) {
  std::vector<const WrongPixel*> pixels;
  for (const WrongPixel& wrong : report.wrong) {
    if (!cause || wrong.causes.first() == cause) pixels.push_back(&wrong);
  }
  std::string out = std::to_string(pixels.size()).append(" wrong pixels");
  if (cause) out.append(" by ").append(name(*cause));
  out.append("\n").append(to_text(report));
  if (pixels.empty()) return out;
  const Box box = box_of(pixels);
  const auto position = [&](int x, int y) {
    return std::string("(")
               .append(std::to_string(x - report.picture.x))
               .append(",")
               .append(std::to_string(y - report.picture.y)) +
           ")";
  };
  out.append("  between ").append(position(box.left, box.top)).append(" and ");
  out.append(position(box.right, box.bottom));
  out.append(
      "; B BlendOrder, X Interpenetration, C CyclicOverlap, T BucketTie, K KeyInversion, L ListOrder, "
      "D DepthTie, P DepthPrecision\n");
  append_map(out, pixels, box);
  return out;
}

}  // namespace inspect
