#pragma once
// Pictures from files: PNG, JPEG, TGA and BMP, of any bit depth, as 8-bit RGBA.
//
// Not modelled: colour profiles, gamma chunks, EXIF orientation, animation.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "load/load.h"
#include "scene/world.h"

namespace load {

/// Decodes a picture; what it is, its bytes say. The header is judged first: a side over limits::picture_side
/// is refused before anything of that size is allocated. Of one that is more than 1,024 texels wide or high,
/// or more than `most_texels`, means of 2 x 2, 4 x 4, ... texels are kept, and its own size beside them.
/// Error: what is wrong, to be put behind the file's name.
base::Result<Texture> decode_picture(std::string_view bytes, std::size_t most_texels = limits::texels);

/// The textures of one scene file, each read once. A picture that cannot be had is a warning, said once, and
/// what wears it is drawn without.
class Pictures {
 public:
  /// Textures go to `out`'s world, warnings and the names of the files read to itself; it must outlive this.
  Pictures(const Source& source, LoadedScene& out);

  /// Index into World::textures of the file named by `reference`; `none` after a warning.
  /// `repeats`: coordinates outside 0..1 wrap; the same file may be wanted both ways.
  std::uint32_t load(std::string_view reference, bool repeats);

  /// The same picture with every visible texel partly transparent (alpha 128), for a see-through material:
  /// the console blends only texels whose bit 15 is set.
  std::uint32_t see_through(std::uint32_t texture);

  /// Some texel is neither opaque nor a hole.
  [[nodiscard]] bool is_partly_transparent(std::uint32_t texture) const { return partly_[texture]; }

 private:
  struct Use {
    std::string file;
    bool repeats;
    auto operator<=>(const Use&) const = default;
  };
  std::uint32_t add(Texture texture);
  std::uint32_t load_file(const std::string& file, bool repeats);

  const Source& source_;
  LoadedScene& out_;
  World& world_;
  std::map<std::string, std::string, std::less<>>
      files_;  // reference -> file, links followed; "": there is none
  std::map<Use, std::uint32_t> loaded_;
  std::map<std::uint32_t, std::uint32_t> see_through_;
  std::vector<bool> partly_;
  std::size_t texels_left_ = limits::texels;
};

}  // namespace load
