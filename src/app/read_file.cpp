#include "app/read_file.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace app {

scene::Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t most) {
  const auto fail = [&](int error) {
    return scene::fail(path.string() + ": cannot be read: " + std::strerror(error));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return fail(errno);
  std::vector<std::byte> bytes;
  std::array<std::byte, 1U << 16> chunk;
  for (;;) {
    errno = 0;
    const auto count = std::fread(chunk.data(), 1, chunk.size(), file.get());
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + static_cast<std::ptrdiff_t>(count));
    if (bytes.size() > most) {
      return scene::fail(path.string() + ": more than " + std::to_string(most) +
                         " bytes, which is the limit");
    }
    if (count == chunk.size()) continue;
    if (std::ferror(file.get()) != 0) return fail(errno);  // a directory opens, and then cannot be read
    return bytes;
  }
}

}  // namespace app
