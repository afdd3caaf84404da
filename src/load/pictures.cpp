#include "load/pictures.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/read_file.h"
#include "load/text.h"

// stb inflates a PNG to the end of its stream, whatever its header says, so a small file could ask for
// gigabytes. Every block it wants is measured against what the header allows.
namespace {

thread_local std::size_t most_bytes_per_block = 0;

void* bounded_malloc(std::size_t bytes) {
  return bytes > most_bytes_per_block ? nullptr : std::malloc(bytes);
}
void* bounded_realloc(void* block, std::size_t bytes) {
  return bytes > most_bytes_per_block ? nullptr : std::realloc(block, bytes);
}

}  // namespace

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_MALLOC(size) bounded_malloc(size)
#define STBI_REALLOC(block, size) bounded_realloc(block, size)
#define STBI_FREE(block) std::free(block)
#include <stb/stb_image.h>

namespace load {
namespace {

// A progressive JPEG may go over its pixels as often as it likes; encoders use about ten scans.
constexpr std::size_t most_scans = 64;

std::size_t scans_of(std::string_view bytes) {
  if (!bytes.starts_with("\xff\xd8")) return 0;
  std::size_t scans = 0;
  for (std::size_t at = 0; (at = bytes.find("\xff\xda", at)) != bytes.npos; at += 2) ++scans;
  return scans;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

base::Result<Texture> decode_picture(std::string_view bytes, std::size_t most_texels) {
  if (bytes.size() > limits::picture_bytes) return base::fail("its file is over the limit of 64 MiB");
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  most_bytes_per_block = std::size_t{1} << 20U;  // what headers need
  if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
    return base::fail("it is no PNG, JPEG, TGA or BMP picture");
  }
  if (width <= 0 || height <= 0) return base::fail("it has no pixels");
  if (width > limits::picture_side || height > limits::picture_side) {
    return base::fail("it is " + size_text(width, height) + ", the limit is 8192 x 8192");
  }
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texels > most_texels) {
    return base::fail("with its " + size_text(width, height) +
                      " texels the scene is over the limit of 8192 x 8192 in all");
  }
  if (scans_of(bytes) > most_scans) return base::fail("it is a JPEG of more than 64 scans");
  most_bytes_per_block = texels * 10 + (std::size_t{1} << 20U);  // 16-bit RGBA, a filter byte a row, slack
  const std::unique_ptr<stbi_uc, decltype(&std::free)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), &std::free);
  if (!pixels) return base::fail("it is damaged");
  Texture texture;
  texture.width = width;
  texture.height = height;
  texture.pixels.resize(texels);
  static_assert(sizeof(Rgba8) == 4);
  std::memcpy(texture.pixels.data(), pixels.get(), texels * 4);
  return texture;
}

Pictures::Pictures(const Source& source, World& world, std::vector<std::string>& warnings)
    : source_(source), world_(world), warnings_(warnings) {}

std::uint32_t Pictures::add(Texture texture) {
  const bool partly = std::any_of(texture.pixels.begin(), texture.pixels.end(),
                                  [](const Rgba8& p) { return p.a != 0 && p.a != 255; });
  partly_.push_back(partly);
  texels_left_ -= std::min(texels_left_, texture.pixels.size());
  world_.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(world_.textures.size() - 1);
}

base::Result<Texture> Pictures::read(std::string_view reference) {
  auto file = resolve(source_.folder, reference);
  if (!file) return tl::make_unexpected(file.error());
  auto bytes = base::read_regular_file(*file, limits::picture_bytes);
  if (!bytes) return base::fail("it cannot be read, or is over the limit of 64 MiB");
  auto texture = decode_picture(*bytes, texels_left_);
  if (texture) texture->name = file->filename().string();
  return texture;
}

std::uint32_t Pictures::load(std::string_view reference, bool repeats) {
  const Use use{std::string(reference), repeats};
  if (const auto known = loaded_.find(use); known != loaded_.end()) return known->second;
  if (const auto other = loaded_.find({use.reference, !repeats}); other != loaded_.end()) {
    if (other->second == none || world_.textures[other->second].pixels.size() > texels_left_) return none;
    Texture copy = world_.textures[other->second];
    copy.repeats = repeats;
    return loaded_[use] = add(std::move(copy));
  }
  auto texture = read(reference);
  if (!texture) {
    warnings_.push_back(source_.name + ": texture " + in_quotes(reference) +
                        " is left out: " + texture.error().text);
    return loaded_[use] = none;
  }
  texture->repeats = repeats;
  return loaded_[use] = add(std::move(*texture));
}

std::uint32_t Pictures::see_through(std::uint32_t texture) {
  if (const auto known = see_through_.find(texture); known != see_through_.end()) return known->second;
  if (world_.textures[texture].pixels.size() > texels_left_) return texture;
  Texture copy = world_.textures[texture];
  for (Rgba8& p : copy.pixels) {
    if (p.a != 0) p.a = 128;
  }
  return see_through_[texture] = add(std::move(copy));
}

}  // namespace load
