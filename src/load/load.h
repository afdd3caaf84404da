#pragma once
// Scenes from files. A file is hostile until read: every parse below is bounded in memory and time for any
// bytes, by the limits of this page, and reports what is wrong by file and line.
//
// Not modelled: what a format holds beyond the list in its own header (obj.h, x3d.h); it is named in a
// warning and the rest still draws.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "load/scene_words.h"

namespace load {

/// What a file may hold. One more is an error (scene files) or a warning (pictures, materials).
namespace limits {
inline constexpr std::size_t obj_bytes = std::size_t{512} << 20;
inline constexpr std::size_t x3d_bytes = std::size_t{64} << 20;
inline constexpr std::size_t mtl_bytes = std::size_t{16} << 20;
inline constexpr std::size_t picture_bytes = std::size_t{64} << 20;
inline constexpr std::size_t faces = 1'000'000;     ///< triangles and quads of one scene, lines included
inline constexpr std::size_t vertices = 4'000'000;  ///< positions, normals and texture coordinates, each
inline constexpr std::size_t instances = 65'536;    ///< shapes placed by one scene
inline constexpr std::size_t elements = 1'000'000;  ///< XML elements, in the file and after USE
inline constexpr std::size_t materials = 4'096;
inline constexpr int depth = 128;                            ///< nested X3D groups
inline constexpr double coordinate = 1e9;                    ///< largest magnitude of any number
inline constexpr int picture_side = 8'192;                   ///< width and height of a texture file
inline constexpr std::size_t texels = std::size_t{1} << 24;  ///< kept of all textures of one scene
}  // namespace limits

struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;         ///< one sentence each, every unsupported thing once, file named
  std::vector<std::filesystem::path> files;  ///< read beside the scene file itself: pictures, materials

  /// At most base::most_warnings are kept.
  void warn(std::string text);
};

/// Where bytes came from: the name errors are reported under, and the folder outside which nothing is read.
struct Source {
  std::string name;
  std::filesystem::path folder;
};

/// Reads a scene file; what it is, base::kind_of tells.
/// Error (bad_input): missing, unreadable, too large, malformed, another kind of file.
base::Result<LoadedScene> load(const std::filesystem::path& file);

/// The parsers behind load(), for bytes that are in memory already.
base::Result<LoadedScene> parse_obj(std::string_view bytes, const Source& source);
base::Result<LoadedScene> parse_x3d(std::string_view bytes, const Source& source);

/// The file `reference` names from inside a scene file, if it is there, regular, and in
/// `folder` or below it (symbolic links followed). Back slashes are slashes; a path that leads
/// elsewhere is tried by its last part.
base::Result<std::filesystem::path> resolve(const std::filesystem::path& folder, std::string_view reference);

}  // namespace load
