// `./run bench inspect`: what truth costs. A cloud of 5,000 triangles, 320x240, sorted into 4096 buckets by
// average depth, is drawn without anybody watching, drawn and watched, and judged; the best of rounds in
// which the three take turns. Then the triangles grow, and with them the samples they cover. `./run bench
// inspect --plot docs/truth-growth.svg` draws the growth.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "gpu/gpu.h"
#include "inspect/report.h"
#include "ot/packet.h"

namespace {

constexpr std::uint32_t triangles = 5000;
constexpr int width = 320, height = 240;
constexpr std::uint32_t nearest = 200, farthest = 4000, buckets = 4096;

using Clock = std::chrono::steady_clock;

double ms_of(auto&& body) {
  const auto begin = Clock::now();
  body();
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

struct Packet {
  std::uint32_t bucket = 0;
  std::vector<std::uint32_t> words;  // depth, then the triangle
};

// Triangles all over the picture and the depths, each within `reach` pixels and `reach` units of its middle.
std::vector<Packet> cloud(std::uint32_t count, int reach, bool is_sorted) {
  std::mt19937 random{5};
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<std::uint32_t>(high - low + 1));
  };
  std::vector<Packet> packets(count);
  for (Packet& packet : packets) {
    const int x = between(0, width - 1), y = between(0, height - 1);
    const int z = between(static_cast<int>(nearest), static_cast<int>(farthest));
    ot::Polygon triangle{.gouraud = true};
    ot::DepthAnnotation depth;
    std::uint32_t sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.xy[k] = {static_cast<std::int16_t>(x + between(-reach, reach)),
                        static_cast<std::int16_t>(y + between(-reach, reach))};
      triangle.rgb[k] = {static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()), 128};
      depth.z[k] = static_cast<std::uint32_t>(z + between(-reach, reach)) * 4096;
      sum += depth.z[k] / 4096;
    }
    packet.bucket = is_sorted ? std::min(buckets - 1, sum / 3) : 0;
    packet.words.resize(ot::word_count(depth) + ot::word_count(triangle));
    const auto n = ot::encode(depth, packet.words);
    ot::encode(triangle, std::span(packet.words).subspan(n));
  }
  std::stable_sort(packets.begin(), packets.end(),
                   [](const Packet& a, const Packet& b) { return a.bucket > b.bucket; });
  return packets;
}

struct Row {
  double raster_ms = 1e9, watched_ms = 1e9, truth_ms = 1e9;
  inspect::Report report;
  [[nodiscard]] double ns_per_sample() const {
    return truth_ms * 1e6 / static_cast<double>(report.fragments);
  }
};

void draw(const std::vector<Packet>& packets, gpu::Gpu& gpu, gpu::Trace* trace) {
  gpu.set_trace(trace);
  for (const Packet& packet : packets) {
    if (trace != nullptr) trace->bucket = packet.bucket;
    gpu.gp0(packet.words);
  }
  gpu.set_trace(nullptr);
}

Row measure(int reach, int rounds, bool is_sorted = true) {
  const auto packets = cloud(triangles, reach, is_sorted);
  gpu::Gpu gpu;
  gpu.gp0(std::array<std::uint32_t, 2>{0xe3000000, 0xe4000000 | (height - 1) << 10 | (width - 1)});
  gpu::Trace trace;
  trace.keep_history = true;
  Row row;
  for (int round = 0; round < rounds; ++round) {
    trace.clear();
    row.raster_ms = std::min(row.raster_ms, ms_of([&] { draw(packets, gpu, nullptr); }));
    row.watched_ms = std::min(row.watched_ms, ms_of([&] { draw(packets, gpu, &trace); }));
    row.truth_ms = std::min(row.truth_ms, ms_of([&] { row.report = inspect::inspect(trace, {}); }));
  }
  return row;
}

void print(int reach, const Row& row) {
  const auto& r = row.report;
  std::printf("%5d %9llu %8.2f %8.2f %9.2f %8.1f %7.0f %8llu %10llu %7llu\n", reach,
              static_cast<unsigned long long>(r.fragments), row.raster_ms, row.watched_ms, row.truth_ms,
              row.ns_per_sample(), row.truth_ms / row.raster_ms,
              static_cast<unsigned long long>(r.wrong_pixels()),
              static_cast<unsigned long long>(r.decisions.filtered),
              static_cast<unsigned long long>(r.decisions.exact));
}

bool plot(const std::string& path, const std::vector<Row>& rows) {
  std::FILE* gnuplot = popen("gnuplot", "w");
  if (gnuplot == nullptr) return false;
  std::fprintf(gnuplot,
               "set terminal svg size 720,400 font 'sans-serif,13' background rgb 'white'\n"
               "set output '%s'\n"
               "set title 'Truth of 5,000 triangles that grow, 320x240'\n"
               "set xlabel 'samples covered, millions'\nset ylabel 'milliseconds'\n"
               "set xrange [0:*]\nset yrange [0:*]\nset grid\nset key top left\n$data << EOD\n",
               path.c_str());
  for (const Row& row : rows) {
    std::fprintf(gnuplot, "%g %g %g %g\n", static_cast<double>(row.report.fragments) / 1e6, row.truth_ms,
                 row.watched_ms, row.raster_ms);
  }
  std::fputs(
      "EOD\n"
      "plot $data using 1:2 with linespoints lw 2 pt 7 ps 0.5 title 'truth and causes', \\\n"
      "     '' using 1:3 with linespoints lw 2 pt 5 ps 0.5 title 'drawing, watched', \\\n"
      "     '' using 1:4 with linespoints lw 2 pt 9 ps 0.5 title 'drawing, nobody watching'\n",
      gnuplot);
  return pclose(gnuplot) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool plots = argc == 3 && std::strcmp(argv[1], "--plot") == 0;
  if (argc > 1 && !plots) {
    std::fputs("usage: bench_inspect [--plot FILE.svg]\n", stderr);
    return 2;
  }
  std::puts("5,000 triangles, 320x240, best of rounds; ratio: truth to drawing without anybody watching");
  std::puts("reach   samples draw ms  watched  truth ms ns/sampl   ratio    wrong   filtered   exact");
  print(16, measure(16, 7));
  std::puts("all in one bucket, so that nearly every pixel is wrong:");
  print(16, measure(16, 5, false));
  std::puts("growing:");
  std::vector<Row> rows;
  for (const int reach : {4, 8, 12, 16, 20, 24, 28, 32}) {
    rows.push_back(measure(reach, 3));
    print(reach, rows.back());
  }
  if (plots && !plot(argv[2], rows)) {
    std::fputs("bench_inspect: gnuplot failed\n", stderr);
    return 1;
  }
  return 0;
}
