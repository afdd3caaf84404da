#pragma once
// What a recording draws, frame by frame, in one number each: kept in a file, they tell when a dump is drawn
// otherwise than it was.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "debug/recording.h"
#include "dump/frames.h"

namespace debug {

/// A recording as drawn: debug::hash_of VRAM at the end of each frame.
struct FrameHashes {
  std::vector<std::uint64_t> frames;
  std::string fault;  ///< what is wrong with the rest of the dump, without its path; empty: nothing
  bool operator==(const FrameHashes&) const = default;
};

/// Draws all of it. `keep_going` is asked at every frame; false ends it there.
FrameHashes hash_frames(Recording& recording, dump::FrameBy by = dump::FrameBy::display,
                        const std::function<bool()>& keep_going = {});

/// Of many recordings, by name.
using HashesByName = std::map<std::string, FrameHashes>;

/// One line about what is not the same: "intro.psxgpu: frame 12: 0123456789ABCDEF, expected ...", "...: not
/// expected", "...: expected and not there".
std::vector<std::string> differences(const HashesByName& got, const HashesByName& expected);

/// A set of recordings as it is kept in a file: schema otter.regress/1.
struct RegressReport {
  std::string folder;
  std::string shard = "1/1";  ///< I/N: every Nth name from the Ith on
  HashesByName dumps;
  std::vector<std::string> different;  ///< from what was expected then
};

std::string to_json(const RegressReport& report);
/// Error (exit 2): one clause about what is no such report.
base::Result<RegressReport> parse_regress(std::string_view json);

/// Shards of one folder put together. Error (exit 2): they name a dump twice with other hashes, or are not
/// all shards of one whole.
base::Result<RegressReport> merge(const std::vector<RegressReport>& shards);

}  // namespace debug
