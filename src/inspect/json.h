#pragma once
// The report as JSON, schema otter.inspect/1.

#include <cstdio>
#include <memory>
#include <string>

#include "inspect/report.h"

namespace inspect {

/// One object, ending in a newline. Pixel positions are relative to the picture; draws are
/// numbers F:K:B (gpu/number.h), null where there is none.
std::string to_json(const Report& report);

/// Several frames, none of which is kept in memory: what is known of each waits in a temporary file. The sums
/// stand under the names of a single frame, then `frames`, one object each.
class FramesJson {
 public:
  FramesJson();

  /// False: the temporary file could not be written; errno says why.
  [[nodiscard]] bool add(const Report& report);
  /// The whole object, ending in a newline; one frame as to_json() has it. Needs a frame.
  void write(std::FILE* to);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> spool_;
  Report first_;        // of which only the names and the size are kept
  std::string single_;  // the first frame alone
  Sums sums_;
};

}  // namespace inspect
