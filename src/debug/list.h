#pragma once
// Every command of a recording, in words or as JSON.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "debug/number.h"
#include "debug/timeline.h"

namespace debug {

/// Up to command `end.command` of frame `end.frame`, or whole_frame of it.
///
/// One line for each command, and for each packet that is no command:
///     byte offset, F:K or '-', port, number of the drawing command or '-', opcode, the command in words
/// A line of a list in RAM has the address of its packet's tag instead of the offset.
void list_text(Timeline& timeline, const Number& end, const std::function<void(const std::string&)>& line);

/// One object, handed on piece by piece, as the frames are drawn: schema otter.list/1, `commands` an array of
///     {"number": "F:K[:B]", "port": 0, "offset", "drawing": N or null, "opcode": "20h", "words": ["..."],
///      "text", "origin": "801230C4h" or null, "pixels": pixels that it wrote, each write counted,
///      "state": {the registers E1h-E6h as the command found them}}
/// A command's pixels are those written in its own frame. `keep_going` is asked at every frame; false ends
/// the array there.
void list_json(Timeline& timeline, const std::string& name, const Number& end,
               const std::function<void(const std::string&)>& write,
               const std::function<bool()>& keep_going = {});

}  // namespace debug
