#include "base/write_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace base {
namespace {

namespace fs = std::filesystem;

Result<void> cannot_write(const fs::path& path, int error) {
  return fail(path.string() + ": cannot be written: " + std::strerror(error), Exit::failed);
}

using Write = std::function<Result<void>(std::FILE*)>;

// What `write` says, or what the file did. fclose reports what the buffer could not (a full disk).
Result<void> write_to(std::FILE* file, const fs::path& path, const Write& write) {
  errno = 0;
  auto made = write(file);
  const bool wrote = std::ferror(file) == 0;
  const int write_error = wrote ? 0 : (errno != 0 ? errno : EIO);
  const bool closed = std::fclose(file) == 0;
  if (!made) return made;
  if (!wrote) return cannot_write(path, write_error);
  return closed ? made : cannot_write(path, errno);
}

// A file that is there is replaced only where its owner would expect it: one that may not be written is not,
// although its folder would allow it, and one with a second name would come apart from it.
Result<void> may_replace(const fs::path& path, const struct stat& old) {
  if ((old.st_mode & 0222) == 0 || access(path.c_str(), W_OK) != 0) {
    return fail(path.string() + ": cannot be written: the file is read-only", Exit::failed);
  }
  if (old.st_nlink > 1) {
    return fail(path.string() + ": cannot be written: it is a hard link, one of " +
                    std::to_string(old.st_nlink) +
                    " names of a file, and only this name would get the new contents; remove it first",
                Exit::failed);
  }
  return {};
}

}  // namespace

Result<void> write_file(const fs::path& path, const Write& write) {
  struct stat old {};
  const bool exists = stat(path.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) return cannot_write(path, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) {
    std::FILE* file = std::fopen(path.c_str(), "wb");
    return file == nullptr ? cannot_write(path, errno) : write_to(file, path, write);
  }
  if (exists) {
    if (auto allowed = may_replace(path, old); !allowed) return allowed;
  }
  std::error_code ignored;
  auto target = fs::canonical(path, ignored);  // the file a link names is replaced, not the link
  if (target.empty()) target = path;
  auto temporary = target;
  temporary += ".part" + std::to_string(getpid());
  fs::remove(temporary, ignored);
  std::FILE* file = std::fopen(temporary.c_str(), "wbx");
  if (file == nullptr) return cannot_write(path, errno);
  if (exists) (void)fchmod(fileno(file), old.st_mode & 07777);
  auto done = write_to(file, path, write);
  if (done && std::rename(temporary.c_str(), target.c_str()) != 0) done = cannot_write(path, errno);
  if (!done) fs::remove(temporary, ignored);
  return done;
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
  return write_file(path, [bytes](std::FILE* file) -> Result<void> {
    std::fwrite(bytes.data(), 1, bytes.size(), file);
    return {};
  });
}

Result<void> write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace base
