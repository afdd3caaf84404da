#include "load/pictures.h"

#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <span>

#include "base/read_file.h"
#include "load/text.h"

// stb inflates a PNG to the end of its stream, whatever its header says, so a small file could ask for
// gigabytes. Every block it wants is measured against what the header allows.
namespace {

constexpr std::size_t most_bytes_in_all = std::size_t{448} << 20;  // of one decoding
thread_local std::size_t most_bytes_per_block = 0, bytes_held = 0;

bool fits(std::size_t bytes, std::size_t instead_of) {
  return bytes <= most_bytes_per_block && bytes_held - instead_of + bytes <= most_bytes_in_all;
}
void* counted(void* block) {
  if (block != nullptr) bytes_held += malloc_usable_size(block);
  return block;
}
void* bounded_malloc(std::size_t bytes) { return fits(bytes, 0) ? counted(std::malloc(bytes)) : nullptr; }
void* bounded_realloc(void* block, std::size_t bytes) {
  const std::size_t before = block == nullptr ? 0 : malloc_usable_size(block);
  if (!fits(bytes, before)) return nullptr;
  void* const moved = std::realloc(block, bytes);
  if (moved != nullptr) bytes_held -= before;
  return counted(moved);
}
void bounded_free(void* block) {
  if (block != nullptr) bytes_held -= malloc_usable_size(block);
  std::free(block);
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
#define STBI_FREE(block) bounded_free(block)
#include <stb/stb_image.h>

namespace load {
namespace {

// A progressive JPEG may go over its pixels as often as it likes; encoders use about ten scans.
constexpr std::size_t most_scans = 64;
constexpr std::size_t most_scanned = std::size_t{1} << 30;  // texels, all scans together

std::size_t scans_of(std::string_view bytes) {
  if (!bytes.starts_with("\xff\xd8")) return 0;
  std::size_t scans = 0;
  for (std::size_t at = 0; (at = bytes.find("\xff\xda", at)) != bytes.npos; at += 2) ++scans;
  return scans;
}

// A page holds 256 x 256 texels: of a picture far larger only the average of every factor x factor of them is
// kept, weighted by alpha as scaled() does.
constexpr int most_kept_side = 1024;

Texture reduced(std::span<const Rgba8> from, int width, int height, int factor) {
  Texture to;
  to.width = (width + factor - 1) / factor;
  to.height = (height + factor - 1) / factor;
  to.pixels.reserve(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  for (int y = 0; y < height; y += factor) {
    for (int x = 0; x < width; x += factor) {
      std::uint64_t r = 0, g = 0, b = 0, a = 0, count = 0;
      for (int v = y; v < std::min(y + factor, height); ++v) {
        for (int u = x; u < std::min(x + factor, width); ++u, ++count) {
          const Rgba8& p = from[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(u)];
          r += std::uint64_t{p.r} * p.a;
          g += std::uint64_t{p.g} * p.a;
          b += std::uint64_t{p.b} * p.a;
          a += p.a;
        }
      }
      const auto mean = [a](std::uint64_t sum) {
        return static_cast<std::uint8_t>(a == 0 ? 0 : (sum + a / 2) / a);
      };
      to.pixels.push_back({mean(r), mean(g), mean(b), static_cast<std::uint8_t>((a + count / 2) / count)});
    }
  }
  return to;
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
  const std::size_t scans = scans_of(bytes);
  if (scans > most_scans) return base::fail("it is a JPEG of more than 64 scans");
  if (scans * texels > most_scanned) {
    return base::fail("it is a JPEG of " + std::to_string(scans) + " scans, too many for its " +
                      size_text(width, height) + " texels");
  }
  most_bytes_per_block = texels * 10 + (std::size_t{1} << 20U);  // 16-bit RGBA, a filter byte a row, slack
  const std::unique_ptr<stbi_uc, decltype(&bounded_free)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &channels, 4), &bounded_free);
  if (!pixels) return base::fail("it is damaged");
  static_assert(sizeof(Rgba8) == 4);
  const std::span<const Rgba8> decoded(reinterpret_cast<const Rgba8*>(pixels.get()), texels);
  int factor = 1;
  const auto kept = [&] {
    const int w = (width + factor - 1) / factor, h = (height + factor - 1) / factor;
    return static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  };
  while (std::max(width, height) > most_kept_side * factor || (kept() > most_texels && kept() > 1))
    factor *= 2;
  Texture texture;
  if (factor == 1) {
    texture.width = width;
    texture.height = height;
    texture.pixels.assign(decoded.begin(), decoded.end());
  } else {
    texture = reduced(decoded, width, height, factor);
  }
  texture.file_width = width;
  texture.file_height = height;
  return texture;
}

Pictures::Pictures(const Source& source, LoadedScene& out)
    : source_(source), out_(out), world_(out.scene.world) {}

std::uint32_t Pictures::add(Texture texture) {
  const bool partly = std::any_of(texture.pixels.begin(), texture.pixels.end(),
                                  [](const Rgba8& p) { return p.a != 0 && p.a != 255; });
  partly_.push_back(partly);
  texels_left_ -= std::min(texels_left_, texture.pixels.size());
  world_.textures.push_back(std::move(texture));
  return static_cast<std::uint32_t>(world_.textures.size() - 1);
}

std::uint32_t Pictures::load(std::string_view reference, bool repeats) {
  auto known = files_.find(reference);
  if (known == files_.end()) {
    const auto file = resolve(source_.folder, reference);
    if (!file) {
      out_.warn(source_.name + ": texture " + in_quotes(reference) + " is left out: " + file.error().text);
    }
    known = files_.emplace(reference, file ? file->string() : std::string()).first;
  }
  return known->second.empty() ? none : load_file(known->second, repeats);
}

// However many names it has, a file is read once; one that cannot be used, too.
std::uint32_t Pictures::load_file(const std::string& file, bool repeats) {
  const Use use{file, repeats};
  if (const auto known = loaded_.find(use); known != loaded_.end()) return known->second;
  if (const auto other = loaded_.find({file, !repeats}); other != loaded_.end()) {
    if (other->second == none || world_.textures[other->second].pixels.size() > texels_left_) return none;
    Texture copy = world_.textures[other->second];
    copy.repeats = repeats;
    return loaded_[use] = add(std::move(copy));
  }
  const std::filesystem::path path(file);
  out_.files.push_back(path);
  auto texture = base::read_regular_file(path, limits::picture_bytes).and_then([&](const std::string& bytes) {
    return decode_picture(bytes, texels_left_);
  });
  if (!texture) {
    out_.warn(source_.name + ": texture " + in_quotes(path.filename().string()) +
              " is left out: " + texture.error().text);
    return loaded_[use] = none;
  }
  texture->name = path.filename().string();
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
