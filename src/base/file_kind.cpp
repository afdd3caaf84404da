#include "base/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

namespace base {
namespace {

using std::string_view;

struct Row {
  FileKind kind;
  string_view text;
};

constexpr std::array magics{Row{FileKind::dump, "PSXGPUDUMPv1"}, Row{FileKind::dump, "\x28\xB5\x2F\xFD"},
                            Row{FileKind::dump, string_view("\xFD"
                                                            "7zXZ\0",
                                                            6)}};
constexpr std::array extensions{Row{FileKind::dump, ".psxgpu"}, Row{FileKind::dump, ".zst"},
                                Row{FileKind::dump, ".xz"}, Row{FileKind::obj, ".obj"},
                                Row{FileKind::x3d, ".x3d"}};

bool is_xml(string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const auto first = bytes.find_first_not_of(" \t\r\n");
  return first != bytes.npos && bytes[first] == '<';
}

bool has_vertex_line(string_view bytes) {
  return bytes.find('\0') == bytes.npos && (bytes.starts_with("v ") || bytes.find("\nv ") != bytes.npos);
}

}  // namespace

std::string lower_extension(const std::filesystem::path& name) {
  std::string extension = name.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

FileKind kind_of(string_view first_bytes, const std::filesystem::path& name) {
  for (const Row& row : magics)
    if (first_bytes.starts_with(row.text)) return row.kind;
  if (is_xml(first_bytes)) return FileKind::x3d;
  if (has_vertex_line(first_bytes)) return FileKind::obj;
  const std::string extension = lower_extension(name);
  for (const Row& row : extensions)
    if (extension == row.text) return row.kind;
  return FileKind::unknown;
}

Result<FileKind> kind_of_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) return fail(path.string() + ": no such file");
  if (!std::filesystem::is_regular_file(status)) return fail(path.string() + ": not a regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return fail(path.string() + ": cannot be read: " + std::strerror(errno));
  std::array<char, 4096> bytes;
  return kind_of(string_view(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file.get())), path);
}

}  // namespace base
