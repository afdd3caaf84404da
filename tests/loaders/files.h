#pragma once
// Scene files and pictures that a test writes for itself, in a folder that goes with it.

#include <filesystem>
#include <string>
#include <string_view>

#include "load/load.h"

namespace tests {

class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path write(std::string_view name, std::string_view bytes) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The bytes of a picture `width` x `height`, of one colour with the given alpha.
std::string png(int width, int height, unsigned char r, unsigned char g, unsigned char b,
                unsigned char a = 255);
std::string jpeg(int width, int height, unsigned char r, unsigned char g, unsigned char b);
std::string tga(int width, int height, unsigned char r, unsigned char g, unsigned char b);
std::string bmp(int width, int height, unsigned char r, unsigned char g, unsigned char b);

/// The line an input is refused with, "" if it is accepted. Also checks that it is
/// one line and exit status 2.
std::string refusal(const base::Result<load::LoadedScene>& loaded);

inline base::Result<load::LoadedScene> obj(std::string_view text, const std::filesystem::path& folder = ".") {
  return load::parse_obj(text, {"model.obj", folder});
}

}  // namespace tests
