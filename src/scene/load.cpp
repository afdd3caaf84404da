#include "scene/load.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

namespace scene {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::string_view extension;
  std::size_t most_bytes;
  Result<LoadedScene> (*parse)(std::string_view, const Source&);
};

constexpr std::array formats{Format{".obj", limits::obj_bytes, &parse_obj},
                             Format{".x3d", limits::x3d_bytes, &parse_x3d}};

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool is_inside(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// The file itself, links followed, when it is a regular one inside the folder.
Result<fs::path> inside(const fs::path& folder, const fs::path& relative) {
  std::error_code fault;
  const fs::path home = fs::canonical(folder, fault);
  if (fault) return fail("its folder cannot be read");
  const fs::path file = fs::canonical(home / relative, fault);
  if (fault) return fail("there is no such file");
  if (!is_inside(home, file)) return fail("it lies outside the folder of the scene");
  if (!fs::is_regular_file(file, fault)) return fail("it is not a regular file");
  return file;
}

}  // namespace

Result<std::string> read_file(const fs::path& file, std::size_t most) {
  const std::string name = file.string();
  std::error_code fault;
  const fs::file_status status = fs::status(file, fault);
  if (!fs::exists(status)) return fail(name + ": no such file");
  if (!fs::is_regular_file(status)) return fail(name + ": not a regular file");
  const std::uintmax_t size = fs::file_size(file, fault);
  if (fault) return fail(name + ": cannot be read");
  if (size > most) {
    return fail(name + ": " + std::to_string(size) + " bytes, the limit is " + std::to_string(most));
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(name + ": cannot be opened for reading");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (in.gcount() != static_cast<std::streamsize>(bytes.size())) return fail(name + ": cannot be read whole");
  return bytes;
}

Result<fs::path> resolve(const fs::path& folder, std::string_view reference) {
  std::string text(reference);
  std::replace(text.begin(), text.end(), '\\', '/');
  if (text.empty() || text.find('\0') != std::string::npos) return fail("it is no file name");
  const fs::path wanted(text);
  auto found = inside(folder, wanted);
  if (!found) {
    // Exporters write the path of the author's own machine; the picture usually lies beside the scene.
    if (auto beside = inside(folder, wanted.filename())) return beside;
  }
  return found;
}

Result<LoadedScene> load(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  const auto* format =
      std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.extension == extension; });
  if (format == formats.end()) {
    return fail(file.string() + ": cannot tell what kind of scene this is, expected a name in .obj or .x3d");
  }
  auto bytes = read_file(file, format->most_bytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  if (bytes->empty()) return fail(file.string() + ": the file is empty");
  fs::path folder = file.parent_path();
  if (folder.empty()) folder = ".";
  auto loaded = format->parse(*bytes, Source{file.string(), folder});
  if (loaded) {
    loaded->scene.name = file.filename().string();
    if (loaded->scene.title.empty()) loaded->scene.title = loaded->scene.name;
  }
  return loaded;
}

}  // namespace scene
