#pragma once
// What a replay should leave, held against what it leaves, and whom the difference is blamed on.

#include <cstdint>
#include <functional>
#include <string>

#include "app/commands/arguments.h"
#include "base/result.h"
#include "debug/number.h"
#include "debug/timeline.h"

namespace app {

struct ExpectOptions {
  std::string expect;      ///< 1 MiB of VRAM, or a PNG of VRAM or of the display area
  std::string frames;      ///< a folder of such files: frame-000001.png, frame-000002.bin ...
  std::string mask;        ///< PNG: white where pixels count
  std::string difference;  ///< PNG to write
  std::string json;        ///< the report; "-": standard output

  [[nodiscard]] bool is_asked() const { return !expect.empty() || !frames.empty(); }
};
/// Declares all but --json.
void add_expect_options(Arguments& arguments, ExpectOptions& options);

/// Compares VRAM or picture at `moment`, or at the end of every frame that there is a file for up to then,
/// and reports: the differing pixels by the kind of command that wrote them last, the first such command,
/// both values and that pixel's history. The value: whether all is as expected. Error (exit 2): a file that
/// is no VRAM or picture of this size.
base::Result<bool> check_expected(const ExpectOptions& options, const std::string& name,
                                  debug::Timeline& timeline, const debug::Number& moment,
                                  const std::function<bool()>& keep_going);

}  // namespace app
