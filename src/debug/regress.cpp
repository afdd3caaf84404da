#include "debug/regress.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <set>
#include <utility>

#include "debug/frames.h"
#include "debug/hash.h"
#include "debug/json.h"
#include "debug/player.h"

namespace debug {
namespace {

constexpr const char* schema = "otter.regress/1";

std::string hash_text(std::uint64_t hash) {
  std::array<char, 20> text{};
  std::snprintf(text.data(), text.size(), "%016llX", static_cast<unsigned long long>(hash));
  return text.data();
}

std::optional<std::uint64_t> parse_hex(const std::string& text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value, 16);
  if (error != std::errc() || at != end) return std::nullopt;
  return value;
}

std::string difference(const std::string& name, const FrameHashes& got, const FrameHashes& expected) {
  if (got.fault != expected.fault) {
    const auto told = [](const std::string& fault) { return fault.empty() ? std::string("nothing") : fault; };
    return name + ": wrong with it is " + told(got.fault) + ", expected " + told(expected.fault);
  }
  const std::size_t both = std::min(got.frames.size(), expected.frames.size());
  for (std::size_t n = 0; n < both; ++n) {
    if (got.frames[n] != expected.frames[n])
      return name + ": frame " + std::to_string(n + 1) + ": " + hash_text(got.frames[n]) + ", expected " +
             hash_text(expected.frames[n]);
  }
  return name + ": " + std::to_string(got.frames.size()) + " frames, expected " +
         std::to_string(expected.frames.size());
}

base::Result<FrameHashes> parse_hashes(const Json& json) {
  FrameHashes hashes;
  if (!json.is_object() || !json.contains("frames") || !json["frames"].is_array())
    return base::fail("a dump without its array of frames");
  for (const Json& frame : json["frames"]) {
    const auto hash = frame.is_string() ? parse_hex(frame.get<std::string>()) : std::nullopt;
    if (!hash) return base::fail("a frame that is no hexadecimal number");
    hashes.frames.push_back(*hash);
  }
  if (json.contains("fault") && json["fault"].is_string()) hashes.fault = json["fault"].get<std::string>();
  return hashes;
}

}  // namespace

FrameHashes hash_frames(Recording& recording, dump::FrameBy by, const std::function<bool()>& keep_going) {
  FrameHashes hashes;
  while (recording.read_some(std::size_t{1} << 20)) {
    if (keep_going && !keep_going()) return hashes;
  }
  // The path before it is not the same everywhere.
  const auto& fault = recording.fault();
  const auto at = fault.find(": byte ");
  hashes.fault = at == std::string::npos ? fault : fault.substr(at + 2);
  const auto rest = fault.empty() ? dump::Frames::Rest::nothing : dump::Frames::Rest::lost;
  dump::Frames frames(by);
  frames.extend(recording.dump(), rest);
  FrameIndex index;
  index.extend(recording.dump(), frames, rest);
  Player player(recording, frames, {});
  for (const Frame& frame : index.frames()) {
    if (keep_going && !keep_going()) break;
    player.run({frame.end_packet, 0});
    player.end_frame();
    hashes.frames.push_back(hash_of(std::as_const(player.gpu()).vram().pixels()));
  }
  return hashes;
}

std::vector<std::string> differences(const HashesByName& got, const HashesByName& expected) {
  std::vector<std::string> lines;
  for (const auto& [name, hashes] : got) {
    const auto known = expected.find(name);
    if (known == expected.end()) {
      lines.push_back(name + ": not expected");
    } else if (!(hashes == known->second)) {
      lines.push_back(difference(name, hashes, known->second));
    }
  }
  for (const auto& [name, hashes] : expected)
    if (!got.contains(name)) lines.push_back(name + ": expected and not there");
  return lines;
}

std::string to_json(const RegressReport& report) {
  Json dumps = Json::object();
  for (const auto& [name, hashes] : report.dumps) {
    Json frames = Json::array();
    for (const auto hash : hashes.frames) frames.push_back(hash_text(hash));
    dumps[name] = {{"frames", std::move(frames)}, {"fault", hashes.fault}};
  }
  return to_text(Json{{"schema", schema},
                      {"scene", report.folder},
                      {"frame", 0},
                      {"width", gpu::Vram::width},
                      {"height", gpu::Vram::height},
                      {"shard", report.shard},
                      {"dumps", std::move(dumps)},
                      {"different", report.different}});
}

base::Result<RegressReport> parse_regress(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded() || !json.is_object()) return base::fail("expected a JSON object");
  if (!json.contains("schema") || json["schema"] != schema)
    return base::fail(std::string("expected schema ") + schema);
  if (!json.contains("dumps") || !json["dumps"].is_object())
    return base::fail("expected an object named dumps");
  RegressReport report;
  if (json.contains("scene") && json["scene"].is_string()) report.folder = json["scene"].get<std::string>();
  if (json.contains("shard") && json["shard"].is_string()) report.shard = json["shard"].get<std::string>();
  for (const auto& [name, dump] : json["dumps"].items()) {
    auto hashes = parse_hashes(dump);
    if (!hashes) return base::fail(name + ": " + hashes.error().text);
    report.dumps.emplace(name, std::move(*hashes));
  }
  if (json.contains("different") && json["different"].is_array()) {
    for (const Json& line : json["different"])
      if (line.is_string()) report.different.push_back(line.get<std::string>());
  }
  return report;
}

base::Result<RegressReport> merge(const std::vector<RegressReport>& shards) {
  RegressReport whole;
  std::set<std::string> seen;
  std::string count;
  for (const RegressReport& shard : shards) {
    const auto of = shard.shard.substr(std::min(shard.shard.find('/'), shard.shard.size()));
    if (!count.empty() && of != count)
      return base::fail("shards " + *seen.begin() + " and " + shard.shard + " are not of one whole");
    count = of;
    if (!seen.insert(shard.shard).second) return base::fail("shard " + shard.shard + " is there twice");
    whole.folder = shard.folder;
    whole.different.insert(whole.different.end(), shard.different.begin(), shard.different.end());
    for (const auto& [name, hashes] : shard.dumps) {
      if (!whole.dumps.emplace(name, hashes).second) return base::fail(name + ": in two of the shards");
    }
  }
  if (std::string("/").append(std::to_string(seen.size())) != count)
    return base::fail("expected all shards, I" + count + ", got " + std::to_string(seen.size()));
  return whole;
}

}  // namespace debug
