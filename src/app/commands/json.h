#pragma once
// How commands write a report as JSON.

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "base/result.h"
#include "base/write_file.h"

namespace app {

using Json = nlohmann::ordered_json;

/// To a file, or to standard output where the name is "-". Names of files may hold any bytes; they do not
/// make it fail.
inline base::Result<void> write_json(const std::string& path, const Json& json) {
  const auto text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (path != "-") return base::write_file(path, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return {};
  return base::fail("standard output: cannot be written", base::Exit::failed);
}

}  // namespace app
