#include "base/write_file.h"

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

// 0, or the errno of what went wrong. fclose reports what the buffer could not (a full disk).
int write_with(const fs::path& path, const std::function<void(std::FILE*)>& write) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  errno = 0;
  write(file);
  const bool wrote = std::ferror(file) == 0;
  const int write_error = wrote ? 0 : (errno != 0 ? errno : EIO);
  const bool closed = std::fclose(file) == 0;
  if (!wrote) return write_error;
  return closed ? 0 : errno;
}

}  // namespace

Result<void> write_file(const fs::path& path, const std::function<void(std::FILE*)>& write) {
  std::error_code status_error;
  const auto status = fs::status(path, status_error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const int error = fs::is_directory(status) ? EISDIR : write_with(path, write);
    return error == 0 ? Result<void>{} : cannot_write(path, error);
  }
  std::error_code ignored;
  auto target = fs::canonical(path, ignored);  // the file a link names is replaced, not the link
  if (target.empty()) target = path;
  auto temporary = target;
  temporary += ".part" + std::to_string(getpid());
  int error = write_with(temporary, write);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return {};
  fs::remove(temporary, ignored);
  return cannot_write(path, error);
}

Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
  return write_file(path, [bytes](std::FILE* file) { std::fwrite(bytes.data(), 1, bytes.size(), file); });
}

Result<void> write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace base
