// otter regress: what every dump of a folder draws, held against what it drew; otter merge joins shards of
// it.

#include "debug/regress.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/progress.h"
#include "app/source.h"
#include "base/file_kind.h"
#include "base/message.h"
#include "base/read_file.h"
#include "base/write_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;

constexpr const char* expected_name = "otter.regress.json";
constexpr std::uint64_t most_report_bytes = std::uint64_t{256} << 20;

struct RegressOptions {
  std::string folder, shard = "1/1", json, frame_by;
  bool update = false;
  int jobs = 0;
};

struct Shard {
  std::size_t number = 1, of = 1;
};

base::Result<Shard> parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.number);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, shard.of);
    if (second.ec == std::errc() && second.ptr == end && shard.number >= 1 && shard.number <= shard.of)
      return shard;
  }
  return base::fail("--shard: expected I/N with 1 <= I <= N, got " + text);
}

/// The dumps in a folder and below it, by what is in them; names relative to it, sorted.
base::Result<std::vector<std::string>> dumps_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  fs::recursive_directory_iterator at(folder, error);
  for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
    std::error_code ignored;
    if (!at->is_regular_file(ignored)) continue;
    const auto kind = base::kind_of_file(at->path());
    if (kind && *kind == base::FileKind::dump)
      names.push_back(at->path().lexically_relative(folder).generic_string());
  }
  if (error) return base::fail(folder + ": cannot be read: " + error.message());
  if (names.empty()) return base::fail(folder + ": expected GPU dumps in it");
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> of_shard(const std::vector<std::string>& names, const Shard& shard) {
  std::vector<std::string> mine;
  for (std::size_t n = shard.number - 1; n < names.size(); n += shard.of) mine.push_back(names[n]);
  return mine;
}

/// Draws the dumps, several at once.
base::Result<debug::HashesByName> hash_all(const std::string& folder, const std::vector<std::string>& names,
                                           dump::FrameBy by, int jobs) {
  debug::HashesByName hashes;
  std::optional<base::Error> failed;
  std::mutex mutex;
  std::atomic<std::size_t> next = 0;
  Progress progress("regress", names.size());
  const auto work = [&] {
    for (std::size_t n = next++; n < names.size() && !Interrupt::was_asked(); n = next++) {
      auto recording = debug::Recording::open(fs::path(folder) / names[n]);
      debug::FrameHashes drawn;
      if (recording) drawn = debug::hash_frames(*recording, by, [] { return !Interrupt::was_asked(); });
      const std::lock_guard lock(mutex);
      if (!recording && !failed) failed = recording.error();
      hashes.emplace(names[n], std::move(drawn));
      progress.step();
    }
  };
  std::vector<std::thread> threads;
  for (int n = 1; n < jobs; ++n) threads.emplace_back(work);
  work();
  for (auto& thread : threads) thread.join();
  if (failed) return tl::make_unexpected(*failed);
  return hashes;
}

base::Result<debug::RegressReport> read_report(const fs::path& path) {
  const auto bytes = base::read_file(path, most_report_bytes);
  if (!bytes) return tl::make_unexpected(bytes.error());
  auto report = debug::parse_regress({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!report) return base::fail(path.string() + ": " + report.error().text);
  return report;
}

/// Those that this shard has to answer for: what is not there any more is told by the first.
debug::HashesByName expected_here(const debug::HashesByName& all, const std::vector<std::string>& names,
                                  const std::vector<std::string>& mine, const Shard& shard) {
  debug::HashesByName here;
  for (const auto& [name, hashes] : all) {
    const bool is_mine = std::ranges::binary_search(mine, name);
    const bool is_gone = !std::ranges::binary_search(names, name);
    if (is_mine || (is_gone && shard.number == 1)) here.emplace(name, hashes);
  }
  return here;
}

std::uint64_t count_frames(const debug::HashesByName& dumps) {
  std::uint64_t frames = 0;
  for (const auto& [name, hashes] : dumps) frames += hashes.frames.size();
  return frames;
}

base::Result<void> write_regress(const std::string& path, const debug::RegressReport& report) {
  const auto text = debug::to_json(report);
  if (path != "-") return base::write_file(path, text);
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return {};
  return base::fail("standard output: cannot be written", base::Exit::failed);
}

base::Result<int> update_expected(const RegressOptions& options, const Shard& shard,
                                  const debug::RegressReport& report) {
  const std::string name = shard.of == 1 ? expected_name
                                         : "otter.regress." + std::to_string(shard.number) + "-of-" +
                                               std::to_string(shard.of) + ".json";
  const auto path = (fs::path(options.folder) / name).string();
  if (auto written = write_regress(path, report); !written) return tl::make_unexpected(written.error());
  if (options.json != "-")
    std::printf("%s: %zu dumps, %llu frames\n", base::printable(path).c_str(), report.dumps.size(),
                static_cast<unsigned long long>(count_frames(report.dumps)));
  return 0;
}

base::Result<int> hold_to_expected(const RegressOptions& options) {
  const auto shard = parse_shard(options.shard);
  if (!shard) return tl::make_unexpected(shard.error());
  const auto names = dumps_in(options.folder);
  if (!names) return tl::make_unexpected(names.error());
  debug::RegressReport expected;
  const auto expected_path = fs::path(options.folder) / expected_name;
  if (!options.update) {
    std::error_code ignored;
    if (!fs::exists(expected_path, ignored))
      return base::fail(expected_path.string() + ": no such file; --update writes what is drawn today");
    auto read = read_report(expected_path);
    if (!read) return tl::make_unexpected(read.error());
    expected = std::move(*read);
  }
  const Interrupt interrupt;
  const auto mine = of_shard(*names, *shard);
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  auto dumps = hash_all(options.folder, mine, dump::frame_by_named(options.frame_by),
                        options.jobs == 0 ? cores : options.jobs);
  if (!dumps) return tl::make_unexpected(dumps.error());
  if (interrupt.was_asked()) return base::fail("interrupted: nothing is written", base::Exit::interrupted);
  debug::RegressReport report{
      .folder = options.folder, .shard = options.shard, .dumps = std::move(*dumps), .different = {}};
  if (!options.update)
    report.different = debug::differences(report.dumps, expected_here(expected.dumps, *names, mine, *shard));
  if (!options.json.empty()) {
    if (auto written = write_regress(options.json, report); !written)
      return tl::make_unexpected(written.error());
  }
  if (options.update) return update_expected(options, *shard, report);
  if (options.json != "-") {
    for (const auto& line : report.different) std::puts(base::printable(line).c_str());
    std::printf("%zu dumps, %llu frames: %zu differ\n", report.dumps.size(),
                static_cast<unsigned long long>(count_frames(report.dumps)), report.different.size());
  }
  return report.different.empty() ? 0 : static_cast<int>(base::Exit::failed);
}

struct MergeOptions {
  std::vector<std::string> files;
  std::string output = "-";
};

base::Result<int> merge_shards(const MergeOptions& options) {
  if (options.files.empty()) return base::fail("expected the JSON files of shards");
  std::vector<debug::RegressReport> shards;
  for (const auto& file : options.files) {
    auto report = read_report(file);
    if (!report) return tl::make_unexpected(report.error());
    shards.push_back(std::move(*report));
  }
  const auto whole = debug::merge(shards);
  if (!whole) return tl::make_unexpected(whole.error());
  if (auto written = write_regress(options.output, *whole); !written)
    return tl::make_unexpected(written.error());
  if (options.output != "-") {
    for (const auto& line : whole->different) std::puts(base::printable(line).c_str());
    std::printf("%s: %zu dumps, %llu frames: %zu differ\n", base::printable(options.output).c_str(),
                whole->dumps.size(), static_cast<unsigned long long>(count_frames(whole->dumps)),
                whole->different.size());
  }
  return whole->different.empty() ? 0 : static_cast<int>(base::Exit::failed);
}

}  // namespace

Action add_regress(Arguments arguments) {
  const auto options = std::make_shared<RegressOptions>();
  arguments.positional("folder", "DIR", options->folder,
                       "a folder with GPU dumps, and in it otter.regress.json", Presence::required);
  arguments.flag("--update", options->update, "write what is drawn today into DIR/otter.regress.json");
  arguments.text("--shard", "I/N", options->shard,
                 "every Nth dump from the Ith on; --update then writes otter.regress.I-of-N.json [1/1]");
  arguments.number("--jobs", "N", options->jobs, 1, 256, "dumps drawn at once [as many as there are cores]");
  add_frame_by(arguments, options->frame_by);
  arguments.text("--json", "FILE", options->json,
                 "the hashes and what differs as JSON; - is standard output");
  return [options] { return hold_to_expected(*options); };
}

Action add_merge(Arguments arguments) {
  const auto options = std::make_shared<MergeOptions>();
  arguments.positionals("files", "A.json", options->files, "what otter regress --shard I/N wrote, all N");
  arguments.text("-o,--output", "FILE", options->output, "the whole [- for standard output]");
  return [options] { return merge_shards(*options); };
}

}  // namespace app
