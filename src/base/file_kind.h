#pragma once
// What a file is: told by its first bytes, and by its name only where they do not say.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace base {

/// ".psxgpu" of "frame.PSXGPU": what a name ends in, in lower case.
std::string lower_extension(const std::filesystem::path& name);

enum class FileKind : std::uint8_t { unknown, dump, obj, x3d };

/// `first_bytes`: the beginning of the file, some hundred bytes suffice. GPU dumps of both revisions begin
/// with their magic, packed ones with that of zstd or xz, XML with a tag; OBJ is text with a line that begins
/// with "v ". Otherwise the extension decides, in any case: .psxgpu, .zst, .xz, .obj, .x3d.
FileKind kind_of(std::string_view first_bytes, const std::filesystem::path& name);

/// The same for a file. Error (exit 2): no such file, not a regular file, unreadable.
Result<FileKind> kind_of_file(const std::filesystem::path& path);

/// "a GPU dump, OBJ or X3D": what may stand where a file is expected, for messages.
inline constexpr std::string_view known_kinds = "a GPU dump (.psxgpu), OBJ (.obj) or X3D (.x3d)";

}  // namespace base
