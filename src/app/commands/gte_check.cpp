// otter gte-check: register vectors through the GTE.

#include <iostream>
#include <memory>
#include <string>
#include <string_view>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "base/read_file.h"
#include "gte/check.h"

namespace app {
namespace {

struct GteCheckOptions {
  std::string file;
  bool all = false;
};

constexpr std::uint64_t max_csv_bytes = std::uint64_t{1} << 30;

base::Result<int> gte_check(const GteCheckOptions& options) {
  const auto bytes = base::read_file(options.file, max_csv_bytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const auto outcome = gte::check_csv(text, std::cout, options.all);
  std::cout.flush();
  if (outcome.malformed) return base::fail(options.file + ": " + outcome.malformed->message());
  if (!std::cout) return base::fail("standard output: cannot be written", base::Exit::failed);
  return outcome.exit_status();
}

}  // namespace

Action add_gte_check(Arguments arguments) {
  const auto options = std::make_shared<GteCheckOptions>();
  arguments.positional("file", "FILE.csv", options->file,
                       "idx,op,cmd,in0..in63,out0..out63 in hexadecimal, header row first",
                       Presence::required);
  arguments.flag("--all", options->all, "print every register that differs, not the first 20");
  return [options] { return gte_check(*options); };
}

}  // namespace app
