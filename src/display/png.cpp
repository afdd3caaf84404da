#include "display/png.h"

#include <png.h>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/read_file.h"
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

base::Result<base::Picture> read_png(const std::filesystem::path& path) {
  constexpr std::uint64_t most_bytes = std::uint64_t{64} << 20;
  const auto file = base::read_file(path, most_bytes);
  if (!file) return tl::make_unexpected(file.error());
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto failed = [&] { return base::fail(path.string() + ": expected a PNG: " + image.message); };
  if (png_image_begin_read_from_memory(&image, file->data(), file->size()) == 0) return failed();
  if (image.width > most_png_side || image.height > most_png_side) {
    png_image_free(&image);
    return base::fail(path.string() + ": " + std::to_string(image.width) + " x " +
                      std::to_string(image.height) + " pixels, expected at most " +
                      std::to_string(most_png_side) + " a side");
  }
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  const png_color black{0, 0, 0};  // behind what is transparent
  if (png_image_finish_read(&image, &black, rgb.data(), 0, nullptr) == 0) return failed();
  base::Picture picture(static_cast<int>(image.width), static_cast<int>(image.height));
  for (std::size_t n = 0; n < picture.pixels.size(); ++n)
    picture.pixels[n] = {rgb[3 * n], rgb[3 * n + 1], rgb[3 * n + 2], 255};
  return picture;
}

}  // namespace display
