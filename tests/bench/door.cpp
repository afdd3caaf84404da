// The price of the C library: the same stream through its door and into a gpu::Gpu, in bulk and word by word,
// one after the other in many rounds. A library's call and its checks come on top; the target is 3 %.
//
//     bench_door [ROUNDS]

#include <otter/otter.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "gpu/gpu.h"

namespace {

/// Triangles of about `edge` pixels at random places.
std::vector<std::uint32_t> triangles(std::uint32_t edge, int count) {
  std::mt19937 random(1);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  std::vector<std::uint32_t> words{0xe1000000, 0xe3000000, 0xe4000000 | 319 | 239 << 10};
  for (int n = 0; n < count; ++n) {
    const std::uint32_t x = below(320 - edge), y = below(240 - edge);
    words.insert(words.end(),
                 {0x20000000 | below(1 << 24), x | y << 16, (x + edge) | y << 16, x | (y + edge) << 16});
  }
  return words;
}

/// Of this thread's own time: what others do on the machine counts less.
double thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

template <class Body>
double nanoseconds(std::size_t words, Body&& body) {
  const double begin = thread_nanoseconds();
  body();
  return (thread_nanoseconds() - begin) / static_cast<double>(words);
}

void compare(const char* name, std::uint32_t edge, bool in_bulk, int rounds) {
  const auto words = triangles(edge, 4000);
  gpu::Gpu gpu;
  otter* const door = otter_create();
  if (door == nullptr) std::exit(1);
  double own = 1e9, library = 1e9;  // the best round: the one that others disturbed least
  for (int round = 0; round < rounds; ++round) {
    own = std::min(own, nanoseconds(words.size(), [&] {
                     if (in_bulk) return gpu.gp0(words);
                     for (const auto word : words) gpu.gp0(word);
                   }));
    library = std::min(library, nanoseconds(words.size(), [&] {
                         if (in_bulk) return static_cast<void>(otter_gp0(door, words.data(), words.size()));
                         for (const auto word : words) otter_gp0_word(door, word);
                       }));
  }
  std::printf("%-10s %3u pixels  C++ %7.2f  C %7.2f ns a word  %+5.1f %%\n", name,
              static_cast<unsigned>(edge), own, library, 100 * (library / own - 1));
  otter_destroy(door);
}

}  // namespace

int main(int count, char** words) {
  const int rounds = count > 1 ? std::max(1, std::atoi(words[1])) : 201;
  for (const std::uint32_t edge : {8U, 32U}) {
    compare("in bulk", edge, true, rounds);
    compare("one by one", edge, false, rounds);
  }
}
