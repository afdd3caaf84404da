#include "display/write_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

namespace display {
namespace {

namespace fs = std::filesystem;

scene::Result<void> cannot_write(const fs::path& path, int error) {
  return scene::fail(path.string() + ": cannot be written: " + std::strerror(error), scene::Exit::failed);
}

// 0, or the errno of what went wrong. fclose reports what the buffer could not (a full disk).
int write_bytes(const fs::path& path, std::span<const std::byte> bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  const bool wrote = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = wrote ? 0 : errno;
  const bool closed = std::fclose(file) == 0;
  if (!wrote) return write_error;
  return closed ? 0 : errno;
}

}  // namespace

scene::Result<void> write_file(const fs::path& path, std::span<const std::byte> bytes) {
  std::error_code status_error;
  const auto status = fs::status(path, status_error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    const int error = fs::is_directory(status) ? EISDIR : write_bytes(path, bytes);
    return error == 0 ? scene::Result<void>{} : cannot_write(path, error);
  }
  std::error_code ignored;
  auto target = fs::canonical(path, ignored);  // the file a link names is replaced, not the link
  if (target.empty()) target = path;
  auto temporary = target;
  temporary += ".part" + std::to_string(getpid());
  int error = write_bytes(temporary, bytes);
  if (error == 0 && std::rename(temporary.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return {};
  fs::remove(temporary, ignored);
  return cannot_write(path, error);
}

scene::Result<void> write_file(const fs::path& path, std::string_view text) {
  return write_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace display
