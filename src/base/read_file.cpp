#include "base/read_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>

namespace base {

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t most) {
  const auto cannot = [&](int error) {
    return fail(path.string() + ": cannot be read: " + std::strerror(error));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return cannot(errno);
  std::vector<std::byte> bytes;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) {
    bytes.reserve(
        static_cast<std::size_t>(std::min<std::uintmax_t>(std::filesystem::file_size(path, ignored), most)));
  }
  std::array<std::byte, 1U << 16> chunk;
  for (;;) {
    errno = 0;
    const auto count = std::fread(chunk.data(), 1, chunk.size(), file.get());
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
    if (bytes.size() > most) {
      return fail(path.string() + ": more than " + std::to_string(most) + " bytes, which is the limit");
    }
    if (count == chunk.size()) continue;
    if (std::ferror(file.get()) != 0) return cannot(errno);  // a directory opens, and then cannot be read
    return bytes;
  }
}

Result<std::string> read_regular_file(const std::filesystem::path& file, std::size_t most) {
  const std::string name = file.string();
  std::error_code fault;
  const std::filesystem::file_status status = std::filesystem::status(file, fault);
  // A folder that may not be searched hides whether the file is there.
  if (fault && status.type() != std::filesystem::file_type::not_found) {
    return fail(name + ": cannot be read: " + fault.message());
  }
  if (!std::filesystem::exists(status)) return fail(name + ": no such file");
  if (!std::filesystem::is_regular_file(status)) return fail(name + ": not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, fault);
  if (fault) return fail(name + ": cannot be read: " + fault.message());
  if (size > most) {
    return fail(name + ": " + std::to_string(size) + " bytes, the limit is " + std::to_string(most));
  }
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(name + ": cannot be read: " + std::strerror(errno != 0 ? errno : EIO));
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (in.gcount() != static_cast<std::streamsize>(bytes.size())) return fail(name + ": cannot be read whole");
  return bytes;
}

}  // namespace base
