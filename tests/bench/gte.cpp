// `./run bench gte`: what the coprocessor costs, one command at a time and in arrays, and what exactness
// costs against float32. Absolute figures wander with the machine; every ratio is taken inside one run, from
// medians of rounds in which all rows take turns.

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

#include "gte/batch.h"
#include "gte/commands.h"
#include "tests/bench/gte_float.h"

namespace {

constexpr std::size_t count = 4096;  // vertices; triangles take three each

std::uint64_t ticks() {
#if defined(__x86_64__)
  return __rdtsc();
#else
  return 0;
#endif
}

/// 4096 vertices that a rotation and a translation bring to SZ 256..4096 and onto the
/// screen, with normals and colours.
struct Workload {
  gte::Registers setup;
  std::vector<gte::Vertex> vertices, normals;
  std::vector<gte::Colour> colours;
  std::vector<std::int16_t> ir0;

  Workload() {
    std::mt19937 random(1);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    const double a = 0.5, b = 0.3;
    const double m[3][3] = {{std::cos(a), 0, std::sin(a)},
                            {std::sin(a) * std::sin(b), std::cos(b), -std::cos(a) * std::sin(b)},
                            {-std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)}};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        setup.rt[i][j].raw = static_cast<std::int16_t>(std::lround(m[i][j] * 4096));
        setup.llm[i][j].raw = static_cast<std::int16_t>(between(-2300, 2300));
        setup.lcm[i][j].raw = static_cast<std::int16_t>(between(0, 1365));
      }
      setup.bk[i].raw = 512;
      setup.fc[i].raw = 0x800;
    }
    setup.tr = {10, -20, 2176};
    setup.ofx.raw = 160 << 16;
    setup.ofy.raw = 120 << 16;
    setup.h = 320;
    setup.dqa.raw = -4194;
    setup.dqb.raw = 0x1400000;
    setup.zsf3.raw = 341;
    setup.rgbc = {128, 128, 128, 0x34};
    for (std::size_t i = 0; i < 3 * count; ++i) {
      const double z = between(260, 4090);
      const double eye[3] = {z * between(-0.45, 0.45) - 10, z * between(-0.35, 0.35) + 20, z - 2176};
      const auto model = [&](std::size_t j) {
        return static_cast<std::int16_t>(std::lround(m[0][j] * eye[0] + m[1][j] * eye[1] + m[2][j] * eye[2]));
      };
      vertices.push_back({model(0), model(1), model(2), 0});
      const double theta = between(0, 6.28), y = between(-1, 1), around = std::sqrt(1 - y * y);
      normals.push_back({static_cast<std::int16_t>(4096 * around * std::cos(theta)),
                         static_cast<std::int16_t>(4096 * y),
                         static_cast<std::int16_t>(4096 * around * std::sin(theta)), 0});
      colours.push_back(gte::detail::colour(static_cast<std::uint32_t>(random())));
      ir0.push_back(static_cast<std::int16_t>(between(0, 4096)));
    }
  }
};

struct Row {
  std::string door, target, unit;
  double work;   // elements a call
  double floor;  // million/s to beat; 0: none
  std::function<void()> run;
  std::vector<double> seconds{}, cycles{};

  [[nodiscard]] double rate() const { return work / median(seconds) / 1e6; }
  [[nodiscard]] double cycles_each() const { return median(cycles) / work; }

  static double median(std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
  }
};

// ---- one at a time, as an emulator drives it: registers in by number, the command word, registers out

std::uint32_t sink;

std::uint32_t xy(const gte::Vertex& v) { return gte::detail::join(v.x, v.y); }
std::uint32_t z(const gte::Vertex& v) { return gte::detail::extend(v.z); }

void add_single_rows(std::vector<Row>& rows, const Workload& w) {
  static gte::Registers r;
  r = w.setup;
  const auto loop = [](auto&& body) {
    return [body] {
      std::uint32_t sum = 0;
      for (std::size_t i = 0; i < count; ++i) sum += body(i);
      sink = sum;
    };
  };
  const auto load = [&w](unsigned at, std::size_t i) {
    gte::write(r, 2 * at, xy(w.vertices[i]));
    gte::write(r, 2 * at + 1, z(w.vertices[i]));
  };
  rows.push_back({"RTPS", "single", "vertices", count, 41, loop([load](std::size_t i) {
                    load(0, i);
                    execute(r, gte::sdk::rtps);
                    return gte::read(r, 14) + gte::read(r, 19) + gte::read(r, 63);
                  })});
  rows.push_back({"RTPT+NCLIP+AVSZ3", "single", "triangles", count, 17, loop([load](std::size_t i) {
                    for (unsigned k = 0; k < 3; ++k) load(k, 3 * i + k);
                    execute(r, gte::sdk::rtpt);
                    std::uint32_t sum =
                        gte::read(r, 63) + gte::read(r, 12) + gte::read(r, 13) + gte::read(r, 14);
                    execute(r, gte::sdk::nclip);
                    sum += gte::read(r, 24);
                    execute(r, gte::sdk::avsz3);
                    return sum + gte::read(r, 7);
                  })});
  const auto colour = [&w](std::size_t i, gte::Command c) {
    gte::write(r, 0, xy(w.normals[i]));
    gte::write(r, 1, z(w.normals[i]));
    gte::write(r, 6, gte::detail::word(w.colours[i]));
    gte::write(r, 8, gte::detail::extend(w.ir0[i]));
    execute(r, c);
    return gte::read(r, 22) + gte::read(r, 63);
  };
  rows.push_back({"NCDS", "single", "normals", count, 32,
                  loop([colour](std::size_t i) { return colour(i, gte::sdk::ncds); })});
  rows.push_back({"NCCS", "single", "normals", count, 0,
                  loop([colour](std::size_t i) { return colour(i, gte::sdk::nccs); })});
  rows.push_back({"DPCS", "single", "colours", count, 104, loop([&w](std::size_t i) {
                    gte::write(r, 6, gte::detail::word(w.colours[i]));
                    gte::write(r, 8, gte::detail::extend(w.ir0[i]));
                    execute(r, gte::sdk::dpcs);
                    return gte::read(r, 22) + gte::read(r, 63);
                  })});
  rows.push_back({"MVMVA", "single", "vectors", count, 111, loop([load](std::size_t i) {
                    load(0, i);
                    execute(r, gte::sdk::mvmva.word | (1u << 19));
                    return gte::read(r, 25) + gte::read(r, 26) + gte::read(r, 27);
                  })});
}

// ---- arrays

struct Results {
  std::vector<gte::ScreenXy> sxy = std::vector<gte::ScreenXy>(3 * count);
  std::vector<std::uint16_t> sz = std::vector<std::uint16_t>(3 * count), otz = sz;
  std::vector<std::uint32_t> flag = std::vector<std::uint32_t>(3 * count), flag2 = flag, z = flag;
  std::vector<std::int32_t> mac0 = std::vector<std::int32_t>(count), mac1 = mac0, mac2 = mac0, mac3 = mac0;
  std::vector<gte::Colour> rgb = std::vector<gte::Colour>(3 * count);
  std::vector<std::uint8_t> fx = std::vector<std::uint8_t>(count), fy = fx;
};

void add_batch_rows(std::vector<Row>& rows, const Workload& w, const char* target) {
  static Results o;
  const auto add = [&](const char* door, const char* unit, double floor, auto&& body) {
    rows.push_back({door, target, unit, static_cast<double>(count), floor, [target, body] {
                      gte::use_batch_target(target);
                      body();
                    }});
  };
  const std::span<const gte::Vertex> all(w.vertices), some = all.first(count),
                                                      normals(w.normals.data(), count);
  const std::span<const gte::Colour> colours(w.colours.data(), count);
  const std::span<const std::int16_t> ir0(w.ir0.data(), count);
  const bool avx2 = std::strcmp(target, "AVX2") == 0, avx512 = std::strcmp(target, "AVX-512") == 0;
  const auto floor = [&](double two, double five) { return avx2 ? two : avx512 ? five : 0; };
  if (const bench::FloatProject plain = bench::float_project(target)) {
    add("float32", "vertices", 0, [=, &w] { plain(w.setup, some, o.sxy.data(), o.sz.data()); });
  }
  add("RTPS", "vertices", floor(480, 840),
      [=, &w] { project(w.setup, some, {.sxy = o.sxy.data(), .sz = o.sz.data()}); });
  add("RTPS, FLAG", "vertices", floor(380, 700),
      [=, &w] { project(w.setup, some, {.sxy = o.sxy.data(), .sz = o.sz.data(), .flag = o.flag.data()}); });
  add("RTPS, z, fractions", "vertices", 0, [=, &w] {
    project(w.setup, some,
            {.sxy = o.sxy.data(),
             .sz = o.sz.data(),
             .z_20_12 = o.z.data(),
             .fraction_x = o.fx.data(),
             .fraction_y = o.fy.data()});
  });
  // A translation that leaves 32 bits: sums in 64-bit lanes, every x limited, no block clean.
  gte::Registers beyond = w.setup;
  beyond.tr[0] = 600'000;
  add("RTPS, beyond 32 bits, FLAG", "vertices", 0,
      [=] { project(beyond, some, {.sxy = o.sxy.data(), .sz = o.sz.data(), .flag = o.flag.data()}); });
  add("RTPT+NCLIP+AVSZ3", "triangles", floor(155, 260), [=, &w] {
    project_triangles(w.setup, all, {.sxy = o.sxy.data(), .mac0 = o.mac0.data(), .otz = o.otz.data()});
  });
  add("RTPT+NCLIP+AVSZ3, FLAG", "triangles", floor(135, 220), [=, &w] {
    project_triangles(w.setup, all,
                      {.sxy = o.sxy.data(),
                       .flag = o.flag.data(),
                       .mac0 = o.mac0.data(),
                       .otz = o.otz.data(),
                       .avsz3_flag = o.flag2.data()});
  });
  add("NCDS, FLAG", "normals", 0, [=, &w] {
    light(w.setup, gte::Light::ncds, normals, colours, ir0, {.rgb = o.rgb.data(), .flag = o.flag.data()});
  });
  add("NCCS, FLAG", "normals", 0, [=, &w] {
    light(w.setup, gte::Light::nccs, normals, colours, {}, {.rgb = o.rgb.data(), .flag = o.flag.data()});
  });
  add("DPCS, FLAG", "colours", 0,
      [=, &w] { cue(w.setup, colours, ir0, {.rgb = o.rgb.data(), .flag = o.flag.data()}); });
  add("MVMVA, FLAG", "vectors", 0, [=, &w] {
    multiply(w.setup, gte::sdk::mvmva.word | (1u << 19), some,
             {.mac = {o.mac1.data(), o.mac2.data(), o.mac3.data()}, .flag = o.flag.data()});
  });
}

// ---- rounds and table

/// Calls a row often enough to be timed, about a millisecond.
int calls_for(const Row& row) {
  using Clock = std::chrono::steady_clock;
  row.run();
  const auto begin = Clock::now();
  int calls = 0;
  while (Clock::now() - begin < std::chrono::milliseconds(1)) row.run(), ++calls;
  return std::max(calls, 1);
}

void measure(std::vector<Row>& rows, int rounds) {
  using Clock = std::chrono::steady_clock;
  std::vector<int> calls(rows.size());
  std::transform(rows.begin(), rows.end(), calls.begin(), calls_for);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::uint64_t first_tick = ticks();
      const auto begin = Clock::now();
      for (int n = 0; n < calls[i]; ++n) rows[i].run();
      const std::chrono::duration<double> taken = Clock::now() - begin;
      rows[i].cycles.push_back(static_cast<double>(ticks() - first_tick) / calls[i]);
      rows[i].seconds.push_back(taken.count() / calls[i]);
    }
  }
}

void print(const std::vector<Row>& rows, int rounds) {
  std::map<std::string, double> single, yardstick;
  for (const Row& row : rows) {
    if (row.target == "single") single[row.door] = row.rate();
    if (row.door == "float32") yardstick[row.target] = row.rate();
  }
  std::printf("%zu elements a call, medians of %d interleaved rounds, fastest target %s\n", count, rounds,
              gte::batch_target());
  std::printf("| door | target | million/s | TSC ticks each | to beat | x single | of float32 |\n");
  std::printf("| --- | --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Row& row : rows) {
    const std::string command = row.door.substr(0, row.door.find(','));
    std::printf("| %s | %s | %.0f %s | %.1f | ", row.door.c_str(), row.target.c_str(), row.rate(),
                row.unit.c_str(), row.cycles_each());
    row.floor > 0 ? std::printf("%.0f | ", row.floor) : std::printf(" | ");
    row.target != "single" && single.contains(command) ? std::printf("%.1f | ", row.rate() / single[command])
                                                       : std::printf(" | ");
    row.unit == "vertices" && yardstick.contains(row.target)
        ? std::printf("%.0f %% |\n", 100 * row.rate() / yardstick[row.target])
        : std::printf(" |\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  int rounds = 15;
  if (argc > 2 ||
      (argc == 2 &&
       (std::from_chars(argv[1], argv[1] + std::strlen(argv[1]), rounds).ec != std::errc{} || rounds < 1))) {
    std::fprintf(stderr, "bench_gte: expected nothing or a number of rounds, 15 by default\n");
    return 2;
  }
  const Workload workload;
  std::vector<Row> rows;
  add_single_rows(rows, workload);
  const auto targets = gte::batch_targets();
  for (const char* target : targets) add_batch_rows(rows, workload, target);
  measure(rows, rounds);
  gte::use_batch_target(targets.front());
  print(rows, rounds);
  return 0;
}
