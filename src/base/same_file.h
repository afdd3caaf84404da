#pragma once
// Whether two names mean one file: what is written must be neither read nor written under another name.

#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace base {

/// A file on the command line, and the option that named it ("--vram"; "input" for what has none).
struct NamedFile {
  std::string option, path;
};

/// Compares by device and inode; a file that is not there yet by its folder and name. "-" (a standard
/// stream), devices and pipes never clash. Error (exit 2): names both options and the file.
Result<void> check_outputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs);

}  // namespace base
