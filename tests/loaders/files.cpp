#include "files.h"

#include <doctest/doctest.h>

#include <atomic>
#include <fstream>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#include <unistd.h>

namespace tests {
namespace {

void append(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::vector<unsigned char> pixels(int count, std::initializer_list<unsigned char> pixel) {
  std::vector<unsigned char> all;
  for (int i = 0; i < count; ++i) all.insert(all.end(), pixel);
  return all;
}

}  // namespace

Folder::Folder() {
  static std::atomic<int> next = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("otter-loaders-" + std::to_string(::getpid()) + "-" + std::to_string(next++));
  std::filesystem::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path Folder::write(std::string_view name, std::string_view bytes) const {
  const std::filesystem::path file = path_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::string png(int width, int height, unsigned char r, unsigned char g, unsigned char b, unsigned char a) {
  std::string out;
  stbi_write_png_to_func(&append, &out, width, height, 4, pixels(width * height, {r, g, b, a}).data(),
                         width * 4);
  return out;
}

std::string jpeg(int width, int height, unsigned char r, unsigned char g, unsigned char b) {
  std::string out;
  stbi_write_jpg_to_func(&append, &out, width, height, 3, pixels(width * height, {r, g, b}).data(), 95);
  return out;
}

std::string tga(int width, int height, unsigned char r, unsigned char g, unsigned char b) {
  std::string out;
  stbi_write_tga_to_func(&append, &out, width, height, 3, pixels(width * height, {r, g, b}).data());
  return out;
}

std::string bmp(int width, int height, unsigned char r, unsigned char g, unsigned char b) {
  std::string out;
  stbi_write_bmp_to_func(&append, &out, width, height, 3, pixels(width * height, {r, g, b}).data());
  return out;
}

std::string refusal(const base::Result<load::LoadedScene>& loaded) {
  if (loaded) return "";
  CHECK(loaded.error().exit == base::Exit::bad_input);
  CHECK(loaded.error().text.find('\n') == std::string::npos);
  return loaded.error().text;
}

}  // namespace tests
