// `./run bench ot`: what ordering costs. Random depths, 4096 buckets, packets of 40 bytes; nanoseconds per
// primitive, the best of rounds in which all rows take turns. `./run bench ot --plot docs/ot-growth.svg`
// draws the growth.
//
// The table and its list live in 8 MiB, which hold 200,000 packets.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "ot/links.h"
#include "ot/ordering_table.h"
#include "ot/packet.h"
#include "ot/sort.h"
#include "ot/walker.h"

namespace {

constexpr std::uint32_t buckets = 4096;
constexpr int bucket_shift = 32 - 12;
constexpr std::uint32_t packet_words = 10;  // a tag and the 9 words of a textured quad

using Clock = std::chrono::steady_clock;

/// A GPU as far as the walk is concerned: every word is read.
struct Reader {
  std::uint64_t sum = 0;
  void operator()(std::uint32_t, std::span<const std::uint32_t> payload) {
    for (const auto word : payload) sum += word;
  }
};

struct Times {
  double insert = 1e9, walk = 1e9, std_sort = 1e9, radix = 1e9;
  [[nodiscard]] double table() const { return insert + walk; }
};

struct Workload {
  std::vector<std::uint32_t> memory;
  ot::OrderingTable table;
  std::mt19937 random{1};
  std::vector<std::uint32_t> depth, node;  // depth: 32 bits, the upper 12 choose the bucket
  std::vector<ot::Keyed> keyed, sorted;

  explicit Workload(std::uint32_t count)
      : memory(std::max<std::size_t>(power_of_two(buckets + std::size_t{count} * packet_words), 1024)),
        table(memory, 0, buckets) {
    for (std::uint32_t n = 0; n < count; ++n) {
      const auto index = buckets + n * packet_words;
      memory[index] = ot::tag::make(ot::tag::end, packet_words - 1);
      for (std::uint32_t w = 1; w < packet_words; ++w) memory[index + w] = n + w;
      node.push_back(index * ot::links::unit);
    }
    depth.resize(count);
    sorted.resize(count);
  }

  /// Another frame: a processor learns the branches of a small sort that it sees again and again.
  void shuffle() {
    for (auto& z : depth) z = static_cast<std::uint32_t>(random());
  }

  static std::size_t power_of_two(std::size_t at_least) {
    std::size_t size = 1;
    while (size < at_least) size *= 2;
    return size;
  }

  void insert_all() {
    table.clear();
    for (std::size_t n = 0; n < node.size(); ++n) table.insert(depth[n] >> bucket_shift, node[n]);
  }
};

[[noreturn]] void wrong(const char* what) {
  std::fprintf(stderr, "bench_ot: %s\n", what);
  std::exit(1);
}

Times measure(std::uint32_t count) {
  Workload work(count);
  Times best;
  const auto take = [&](double& into, auto&& body) {
    const auto begin = Clock::now();
    body();
    const std::chrono::duration<double, std::nano> taken = Clock::now() - begin;
    into = std::min(into, taken.count() / count);
  };
  const auto rounds = std::clamp<std::uint32_t>(2'000'000 / count, 7, 200);
  for (std::uint32_t round = 0; round < rounds; ++round) {
    Reader reader;
    ot::WalkResult walked;
    work.shuffle();
    take(best.insert, [&] { work.insert_all(); });
    take(best.walk, [&] { walked = ot::walk(work.memory, work.table.head(), reader); });
    if (!walked || walked.nodes != count + buckets || reader.sum == 0) wrong("the walk is not whole");

    work.keyed.clear();
    for (std::uint32_t n = 0; n < count; ++n)
      work.keyed.push_back({work.depth[n], work.node[n], work.node[n]});
    take(best.radix, [&] { ot::radix_pass<ot::Keyed>(work.keyed, work.sorted, bucket_shift, 12); });
    take(best.std_sort, [&] {
      std::sort(work.keyed.begin(), work.keyed.end(),
                [](const auto& a, const auto& b) { return a.key < b.key; });
    });
    for (std::uint32_t n = 0; n < count; ++n) {
      if (work.keyed[n].key >> bucket_shift != work.sorted[n].key >> bucket_shift) wrong("the sorts differ");
    }
  }
  return best;
}

void print_row(std::uint32_t count, const Times& t) {
  std::printf("%9u %7.1f %7.1f | %8.1f | %8.1f %8.1f\n", count, t.insert, t.walk, t.table(), t.std_sort,
              t.radix);
}

/// gnuplot reads the program from stdin; the numbers are in it.
int plot(const std::string& path) {
  std::vector<std::pair<std::uint32_t, Times>> rows;
  for (int step = 0; step <= 9; ++step) {
    const auto count = static_cast<std::uint32_t>(std::lround(std::pow(10.0, 3 + step / 4.0)));
    rows.emplace_back(count, measure(count));
    print_row(rows.back().first, rows.back().second);
  }
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) return 1;
  std::fprintf(gnuplot,
               "set terminal svg size 760,480 font 'sans-serif,13' background rgb 'white'\n"
               "set output '%s'\n"
               "set title 'Ordering primitives: a table of 4096 buckets against two sorts'\n"
               "set logscale x\nset xrange [900:2e5]\nset xlabel 'primitives'\nset ylabel 'nanoseconds per "
               "primitive'\n"
               "set format x '10^{%%T}'\nset grid\nset key top left\nset logscale y\nset yrange "
               "[1:2000]\n$data << EOD\n",
               path.c_str());
  for (const auto& [count, t] : rows) {
    std::fprintf(gnuplot, "%u %g %g %g %g\n", count, t.insert, t.table(), t.std_sort, t.radix);
  }
  std::fputs(
      "EOD\n"
      "plot $data using 1:4 with linespoints lw 2 title 'std::sort alone, O(n log n)', \\\n"
      "     '' using 1:3 with linespoints lw 2 title 'table: insert and walk', \\\n"
      "     '' using 1:5 with linespoints lw 2 title 'one-pass radix sort alone', \\\n"
      "     '' using 1:2 with linespoints lw 2 title 'table: insert alone'\n",
      gnuplot);
  if (pclose(gnuplot) != 0) wrong("gnuplot failed");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool plots = argc == 3 && std::strcmp(argv[1], "--plot") == 0;
  if (argc > 1 && !plots) {
    std::fputs("usage: bench_ot [--plot FILE.svg]\n", stderr);
    return 2;
  }
  std::printf("%u buckets, packets of %u bytes, ns per primitive\n", buckets, packet_words * 4);
  std::puts("primitives  insert    walk | ins+walk | std::sort    radix");
  if (plots) return plot(argv[2]);
  for (const std::uint32_t count : {10'000U, 100'000U, 200'000U}) print_row(count, measure(count));
  return 0;
}
