#include "display/png.h"

#include <png.h>

#include <cassert>
#include <cstddef>
#include <vector>

#include "base/write_file.h"

namespace display {

base::Result<void> write_png(const std::filesystem::path& path, const base::Picture& picture) {
  assert(picture.width > 0 && picture.height > 0);
  std::vector<std::uint8_t> rgb;
  rgb.reserve(picture.pixels.size() * 3);
  for (const base::Rgba& pixel : picture.pixels) rgb.insert(rgb.end(), {pixel.r, pixel.g, pixel.b});

  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  const auto failed = [&] {
    return base::fail(path.string() + ": cannot be written as PNG: " + image.message, base::Exit::failed);
  };
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);  // an upper bound; the true size comes back
  std::vector<std::byte> file(size);
  if (png_image_write_to_memory(&image, file.data(), &size, 0, rgb.data(), 0, nullptr) == 0) return failed();
  file.resize(size);
  return base::write_file(path, file);
}

}  // namespace display
