#include "load/load.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "base/file_kind.h"
#include "base/message.h"
#include "base/read_file.h"

namespace load {
namespace {

namespace fs = std::filesystem;

struct Format {
  base::FileKind kind;
  std::size_t most_bytes;
  base::Result<LoadedScene> (*parse)(std::string_view, const Source&);
};

constexpr std::array formats{Format{base::FileKind::obj, limits::obj_bytes, &parse_obj},
                             Format{base::FileKind::x3d, limits::x3d_bytes, &parse_x3d}};

bool is_inside(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// The file itself, links followed, when it is a regular one inside the folder.
base::Result<fs::path> inside(const fs::path& folder, const fs::path& relative) {
  std::error_code fault;
  const fs::path home = fs::canonical(folder, fault);
  if (fault) return base::fail("its folder cannot be read: " + fault.message());
  const fs::path file = fs::canonical(home / relative, fault);
  if (fault == std::errc::no_such_file_or_directory) return base::fail("there is no such file");
  if (fault) return base::fail("it cannot be read: " + fault.message());
  if (!is_inside(home, file)) return base::fail("it lies outside the folder of the scene");
  if (!fs::is_regular_file(file, fault)) return base::fail("it is not a regular file");
  return file;
}

}  // namespace

void LoadedScene::warn(std::string text) {
  if (warnings.size() < base::most_warnings) warnings.push_back(std::move(text));
}

base::Result<fs::path> resolve(const fs::path& folder, std::string_view reference) {
  std::string text(reference);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.empty() || text.find('\0') != std::string::npos) return base::fail("it is no file name");
  const fs::path wanted(text);
  auto found = inside(folder, wanted);
  if (!found) {
    // Exporters write the path of the author's own machine; the picture usually lies beside the scene.
    if (auto beside = inside(folder, wanted.filename())) return beside;
  }
  return found;
}

base::Result<LoadedScene> load(const fs::path& file) {
  const auto kind = base::kind_of_file(file);
  if (!kind) return tl::make_unexpected(kind.error());
  const auto format = std::ranges::find(formats, *kind, &Format::kind);
  if (format == formats.end()) {
    return base::fail(file.string() +
                      ": cannot tell what kind of scene this is, expected OBJ (.obj) or X3D (.x3d)");
  }
  auto bytes = base::read_regular_file(file, format->most_bytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  if (bytes->empty()) return base::fail(file.string() + ": the file is empty");
  fs::path folder = file.parent_path();
  if (folder.empty()) folder = ".";
  auto loaded = format->parse(*bytes, Source{file.string(), folder});
  if (loaded) {
    loaded->scene.name = file.filename().string();
    if (loaded->scene.title.empty()) loaded->scene.title = loaded->scene.name;
  }
  return loaded;
}

}  // namespace load
