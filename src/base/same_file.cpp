#include "base/same_file.h"

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <optional>
#include <tuple>

namespace base {
namespace {

namespace fs = std::filesystem;

using Identity = std::tuple<std::uintmax_t, std::uintmax_t, std::string>;  // device, inode, name inside it

std::optional<Identity> identity(const std::string& path) {
  if (path.empty() || path == "-") return std::nullopt;
  struct stat there {};
  if (stat(path.c_str(), &there) == 0) {
    if (!S_ISREG(there.st_mode)) return std::nullopt;
    return Identity{there.st_dev, there.st_ino, {}};
  }
  fs::path file(path);
  std::error_code fault;
  // A link that leads nowhere yet: what it names will be written.
  for (int hops = 0; hops < 40 && fs::is_symlink(fs::symlink_status(file, fault)); ++hops) {
    const auto target = fs::read_symlink(file, fault);
    file = target.is_absolute() ? target : file.parent_path() / target;
  }
  const auto folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (stat(folder.c_str(), &there) != 0)
    return Identity{0, 0, fs::absolute(file, fault).lexically_normal().string()};
  return Identity{there.st_dev, there.st_ino, file.filename().string()};
}

}  // namespace

Result<void> check_outputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs) {
  std::map<Identity, const NamedFile*> seen;
  for (const NamedFile& input : inputs) {
    if (const auto id = identity(input.path); id) seen.try_emplace(*id, &input);
  }
  for (const NamedFile& output : outputs) {
    const auto id = identity(output.path);
    if (!id) continue;
    const auto [other, is_new] = seen.try_emplace(*id, &output);
    if (is_new) continue;
    return fail(output.option + " " + output.path + ": expected a file of its own, " + other->second->option +
                " " + other->second->path + " is the same one");
  }
  return {};
}

}  // namespace base
