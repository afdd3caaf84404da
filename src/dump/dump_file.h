#pragma once
// GPU dumps as files.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "base/result.h"
#include "dump/dump.h"

namespace dump {

/// A file that is read, unpacked and checked piece by piece, so that its first frames can be looked at while
/// the others come. Packed or plain, file or pipe.
class DumpFile {
 public:
  /// Error (exit 2): "PATH: cannot be read: REASON", more bytes than max_unpacked_bytes.
  static base::Result<DumpFile> open(const std::filesystem::path& path);
  ~DumpFile();
  DumpFile(DumpFile&&) noexcept;
  DumpFile& operator=(DumpFile&&) noexcept;

  /// The next bytes of the file, `most` at most. False: there are no more, or something is wrong.
  bool read_some(std::size_t most);
  /// The packets that are whole and good so far.
  [[nodiscard]] const Dump& so_far() const;
  [[nodiscard]] bool is_over() const;
  /// What is wrong, as read_dump tells it; empty: nothing. Known when is_over().
  [[nodiscard]] const std::string& fault() const;
  /// How much of the file was read, 0..1.
  [[nodiscard]] double progress() const;

 private:
  struct State;
  explicit DumpFile(std::unique_ptr<State> state);
  friend base::Result<Dump> read_dump(const std::filesystem::path& path);
  std::unique_ptr<State> state_;
};

/// Reads, unpacks and checks. Error (exit 2): "PATH: byte N: what was expected", where N counts in the file,
/// or, where it is packed and could be unpacked, in what it holds.
base::Result<Dump> read_dump(const std::filesystem::path& path);

/// Writes what `make` adds, as it comes; packed if the name ends in .zst or .xz; whole or not at all. A dump
/// that read_dump would refuse for its size is not written: exit 2.
base::Result<void> write_dump(const std::filesystem::path& path, DumpFormat format,
                              const std::function<base::Result<void>(DumpWriter&)>& make);

/// Writes a dump that is in memory.
base::Result<void> write_dump(const std::filesystem::path& path, DumpFormat format, const Dump& dump);

}  // namespace dump
