#pragma once
// GPU dumps as files.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"
#include "dump/dump.h"

namespace dump {

/// Reads, unpacks and checks. Error (exit 2): "PATH: byte N: what was expected", where N counts in the file,
/// or, where it is packed and could be unpacked, in what it holds.
base::Result<Dump> read_dump(const std::filesystem::path& path);

/// Writes what `make` adds, as it comes; packed if the name ends in .zst or .xz; whole or not at all. A dump
/// that read_dump would refuse for its size is not written: exit 2.
base::Result<void> write_dump(const std::filesystem::path& path, DumpFormat format,
                              const std::function<base::Result<void>(DumpWriter&)>& make);

/// One line for each command and packet up to where a replay with `options` would stop:
///     byte offset, port, number of the drawing command or '-', opcode, the command in words
void list_dump(const Dump& dump, const ReplayOptions& options,
               const std::function<void(const std::string&)>& line);

}  // namespace dump
