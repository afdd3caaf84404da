// Plots by gnuplot, run as a program; pictures as base64.

#include <png.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cost/report.h"
#include "cost/report_plots.h"
#include "cost/text.h"

namespace cost {
namespace {

/// A file of our own that vanishes with us.
class TemporaryFile {
 public:
  TemporaryFile() {
    std::string name = (std::filesystem::temp_directory_path() / "otter-cost-XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) return;
    close(file);
    path_ = name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// gnuplot's colours as variables of the page's style, and names of its own for what it defines: a page holds
/// many plots.
void adapt(std::string& svg) {
  struct Named {
    std::string_view name, colour;
  };
  for (const auto& [name, colour] :
       {Named{"ink", theme::ink}, Named{"soft", theme::soft}, Named{"line", theme::line},
        Named{"up", theme::up}, Named{"down", theme::down}, Named{"front", theme::front}}) {
    const auto value = std::stoul(std::string(colour.substr(1)), nullptr, 16);
    const auto [r, g, b] = std::array{value >> 16, value >> 8 & 255, value & 255};
    for (const char* format : {"rgb(%lu,%lu,%lu)", "rgb(%3lu, %3lu, %3lu)"}) {
      std::array<char, 40> text{};
      std::snprintf(text.data(), text.size(), format, r, g, b);
      replace_all(svg, text.data(), joined({"var(--", name, ")"}));
    }
  }
  static int plots = 0;
  const std::string own = "plot" + std::to_string(++plots);
  for (const char* prefix : {"id='gp", "id=\"gp", "#gp"}) {
    std::string renamed = prefix;
    renamed.replace(renamed.size() - 2, 2, own);
    replace_all(svg, prefix, renamed);
  }
  replace_all(svg, "<title>Gnuplot</title>", "");
}

}  // namespace

std::string plotted(const std::string& script) {
  const TemporaryFile in;
  const TemporaryFile out;
  if (in.path().empty() || out.path().empty()) return {};
  std::ofstream(in.path()) << "set output '" << out.path() << "'\n" << script;
  const std::string command = "gnuplot '" + in.path() + "' >/dev/null 2>&1";
  if (std::system(command.c_str()) != 0) return {};
  std::ifstream file(out.path());
  std::stringstream text;
  text << file.rdbuf();
  std::string svg = text.str();
  const auto begin = svg.find("<svg");
  if (begin == std::string::npos) return {};
  svg.erase(0, begin);
  adapt(svg);
  return svg;
}

std::string png_base64(const base::Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<unsigned char> data(size);
  if (png_image_write_to_memory(&image, data.data(), &size, 0, picture.pixels.data(), 0, nullptr) == 0)
    return {};
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t left = std::min<std::size_t>(3, size - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < left ? data[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= left ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace cost
