// How soon any moment of a long recording is reached, and in how much memory.
//     bench_timeline DUMP [FRAMES]     FRAMES: repeat the dump until it has so many [36000]

#include "debug/timeline.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <vector>

#include "base/clock.h"
#include "dump/dump_file.h"
#include "tests/random.h"

namespace {

dump::Dump looped(const dump::Dump& once, std::uint64_t frames) {
  dump::Dump dump;
  while (dump.vsyncs < frames) {
    for (const auto& packet : once.packets) dump.add(packet.type, once.payload(packet));
    dump.vsyncs += once.vsyncs;
  }
  return dump;
}

double percentile(std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// Seeks to random commands of the frames that are known.
void seek_about(debug::Timeline& timeline, const char* when, int count) {
  tests::Random random(1);
  std::vector<double> times;
  for (int n = 0; n < count; ++n) {
    const std::uint64_t frame = 1 + random.below(static_cast<std::uint32_t>(timeline.frames()));
    const std::uint64_t command = random.below(static_cast<std::uint32_t>(timeline.commands_in(frame)) + 1);
    const double begin = base::cpu_ms();
    timeline.seek({.frame = frame, .command = command});
    times.push_back(base::cpu_ms() - begin);
  }
  std::ranges::sort(times);
  std::printf("%s: %d seeks, processor time: median %.2f ms, 99 %% below %.2f ms, longest %.2f ms\n", when,
              count, percentile(times, 0.5), percentile(times, 0.99), times.back());
}

/// What the process holds, in MiB, as the kernel tells.
double resident_mib(const char* name) {
  std::FILE* const file = std::fopen("/proc/self/status", "r");
  if (file == nullptr) return 0;
  char line[256];
  double kib = 0;
  while (std::fgets(line, sizeof line, file) != nullptr)
    if (std::strncmp(line, name, std::strlen(name)) == 0) kib = std::atof(line + std::strlen(name));
  std::fclose(file);
  return kib / 1024;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "bench_timeline: expected a GPU dump\n"), 2;
  std::uint64_t wanted = 36'000;
  if (argc > 2) std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), wanted);
  // Written and read back, so that opening is that of a file.
  auto once = dump::read_dump(argv[1]);
  if (!once) return std::fprintf(stderr, "bench_timeline: %s\n", once.error().text.c_str()), 2;
  const char* const path = "bench_timeline.psxgpu";
  {
    const auto dump = looped(*once, wanted);
    const auto bytes = dump::write_dump(dump, dump::DumpFormat::standard);
    std::FILE* const file = std::fopen(path, "wb");
    if (file == nullptr) return std::perror(path), 1;
    std::fwrite(bytes.data(), 1, bytes.size(), file);
    std::fclose(file);
  }
  const double begin = base::now_ms();
  auto recording = debug::Recording::open(path);
  if (!recording) return 2;
  debug::Timeline timeline(std::move(*recording));
  if (!timeline.read_first_frame()) return 2;
  timeline.seek({.frame = 1, .command = debug::whole_frame});
  std::printf("%s, %llu frames: first frame after %.1f ms\n", argv[1],
              static_cast<unsigned long long>(wanted), base::now_ms() - begin);
  double longest = 0;
  bool is_read = false;
  for (bool more = true; more;) {
    const double step = base::now_ms();
    more = timeline.index_some(8);
    longest = std::max(longest, base::now_ms() - step);
    if (!is_read && timeline.is_read()) {
      is_read = true;
      std::printf("all %llu frames known after %.0f ms\n", static_cast<unsigned long long>(timeline.frames()),
                  base::now_ms() - begin);
    }
  }
  std::printf("indexed after %.0f ms, no step of 8 ms longer than %.1f ms\n", base::now_ms() - begin,
              longest);
  std::printf("%zu states, %.1f MiB beside the recording of %.1f MiB\n", timeline.keyframes().size(),
              static_cast<double>(timeline.bytes()) / (1 << 20),
              static_cast<double>(timeline.dump().held_bytes()) / (1 << 20));
  seek_about(timeline, "indexed", 1000);
  std::printf("resident %.0f MiB, at most %.0f MiB (the copy that was written included)\n",
              resident_mib("VmRSS:"), resident_mib("VmHWM:"));
  std::remove(path);
  return 0;
}
