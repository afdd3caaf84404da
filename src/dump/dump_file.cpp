#include "dump/dump_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/file_kind.h"
#include "base/read_file.h"
#include "base/write_file.h"
#include "dump/compression.h"

namespace dump {
namespace {

Compression compression_by_name(const std::filesystem::path& path) {
  const auto extension = base::lower_extension(path);
  if (extension == ".zst") return Compression::zstd;
  return extension == ".xz" ? Compression::xz : Compression::none;
}

}  // namespace

struct DumpFile::State {
  State(std::filesystem::path name, std::uint64_t file_bytes)
      : path(std::move(name)), size(file_bytes), reader(most_held_bytes(file_bytes)) {}

  /// The next piece; empty: there is none.
  std::span<const std::byte> next(std::size_t most) {
    most = std::max<std::size_t>(most, 1);
    if (!file) {
      const auto piece = std::span(held).subspan(taken, std::min<std::size_t>(most, held.size() - taken));
      return piece;
    }
    held.resize(most);
    const auto got = std::fread(held.data(), 1, most, file.get());
    if (got == 0 && std::ferror(file.get()) != 0)
      fault = path.string() + ": cannot be read: " + std::strerror(errno);
    return std::span(held).first(got);
  }

  bool read_some(std::size_t most) {
    if (is_over) return false;
    const auto piece = next(most);
    taken += piece.size();
    if (!piece.empty() && unpacker.feed(piece)) return true;
    is_over = true;
    const auto unpacked = unpacker.finish();
    if (!fault.empty()) return false;
    if (!unpacked) {
      fault = text_of(unpacked.offset, "", unpacked.message);
      return false;
    }
    auto read = reader.finish();
    if (!read) {
      const bool is_packed = unpacker.compression() != Compression::none;
      fault = text_of(read.offset, is_packed ? " of the unpacked dump" : "", read.message);
    } else {
      dump = std::move(*read);
    }
    return false;
  }
  [[nodiscard]] std::string text_of(std::uint64_t offset, const char* where, const std::string& text) const {
    return path.string() + ": byte " + std::to_string(offset) + where + ": " + text;
  }

  std::filesystem::path path;
  std::uint64_t size, taken = 0;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{nullptr, &std::fclose};
  std::vector<std::byte> held;  // a piece of the file, or all of a pipe
  DumpReader reader;
  Unpacker unpacker{[this](std::span<const std::byte> bytes) { return reader.feed(bytes); }};
  bool is_over = false;
  std::string fault;
  std::optional<Dump> dump;  // of a file that is over and good
};

base::Result<DumpFile> DumpFile::open(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    auto bytes = base::read_file(path, max_unpacked_bytes);
    if (!bytes) return tl::make_unexpected(bytes.error());
    auto state = std::make_unique<State>(path, bytes->size());
    state->held = std::move(*bytes);
    return DumpFile(std::move(state));
  }
  const auto size = std::filesystem::file_size(path, ignored);
  if (size > max_unpacked_bytes)
    return base::fail(path.string() + ": more than " + std::to_string(max_unpacked_bytes) +
                      " bytes, which is the limit");
  auto state = std::make_unique<State>(path, size);
  state->file.reset(std::fopen(path.c_str(), "rb"));
  if (!state->file) return base::fail(path.string() + ": cannot be read: " + std::strerror(errno));
  return DumpFile(std::move(state));
}

DumpFile::DumpFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
DumpFile::~DumpFile() = default;
DumpFile::DumpFile(DumpFile&&) noexcept = default;
DumpFile& DumpFile::operator=(DumpFile&&) noexcept = default;

bool DumpFile::read_some(std::size_t most) { return state_->read_some(most); }
const Dump& DumpFile::so_far() const { return state_->dump ? *state_->dump : state_->reader.so_far(); }
bool DumpFile::is_over() const { return state_->is_over; }
const std::string& DumpFile::fault() const { return state_->fault; }
double DumpFile::progress() const {
  if (state_->is_over || state_->size == 0) return 1;
  return static_cast<double>(state_->taken) / static_cast<double>(state_->size);
}

base::Result<Dump> read_dump(const std::filesystem::path& path) {
  auto file = DumpFile::open(path);
  if (!file) return tl::make_unexpected(file.error());
  while (file->read_some(std::size_t{1} << 20)) {
  }
  if (!file->fault().empty()) return base::fail(file->fault());
  return std::move(*file->state_->dump);
}

base::Result<void> write_dump(const std::filesystem::path& path, DumpFormat format,
                              const std::function<base::Result<void>(DumpWriter&)>& make) {
  std::uint64_t file_bytes = 0;
  return base::write_file(path, [&](std::FILE* file) -> base::Result<void> {
    Packer packer(compression_by_name(path), [&](std::span<const std::byte> bytes) {
      std::fwrite(bytes.data(), 1, bytes.size(), file);
      file_bytes += bytes.size();
    });
    DumpWriter writer(format, [&](std::span<const std::byte> bytes) { packer.add(bytes); });
    if (auto made = make(writer); !made) return made;
    packer.finish();
    if (const auto most = most_held_bytes(file_bytes); writer.held_bytes() > most) {
      return base::fail(path.string() + ": the dump would take " + std::to_string(writer.held_bytes()) +
                        " bytes of memory to be read, the limit is " + std::to_string(most) +
                        "; fewer frames fit");
    }
    return {};
  });
}

base::Result<void> write_dump(const std::filesystem::path& path, DumpFormat format, const Dump& dump) {
  return write_dump(path, format, [&dump](DumpWriter& writer) {
    add_packets(dump, writer);
    return base::Result<void>{};
  });
}

}  // namespace dump
