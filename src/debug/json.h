#pragma once
// How this room writes JSON. Names of files may hold any bytes; they must not make the output fail.

#include <nlohmann/json.hpp>
#include <string>

namespace debug {

using Json = nlohmann::ordered_json;

/// On lines, ending in a newline.
inline std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}
inline std::string one_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace debug
