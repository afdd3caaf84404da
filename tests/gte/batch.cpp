// The batch door gives the bits of the single commands: every instruction set, every
// output, every kind of input.

#include "gte/batch.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include "tests/gte/random_registers.h"

namespace {

using tests::Kind;
using tests::Random;

/// Puts the fastest instruction set back, whatever a test has chosen.
struct EachTarget {
  std::vector<const char*> names = gte::batch_targets();
  EachTarget() = default;
  EachTarget(const EachTarget&) = delete;
  EachTarget& operator=(const EachTarget&) = delete;
  ~EachTarget() { gte::use_batch_target(names.front()); }
};

/// An output array of any alignment with a guard behind it; some are not wanted at all.
template <class T>
class Array {
 public:
  Array(std::size_t count, std::size_t offset, bool wanted)
      : bytes_(sizeof(T) * (count + offset + 64), std::byte{0xa5}), offset_(offset), wanted_(wanted) {}
  T* get() { return wanted_ ? reinterpret_cast<T*>(bytes_.data()) + offset_ : nullptr; }
  friend bool operator==(const Array& a, const Array& b) { return a.bytes_ == b.bytes_; }
  [[nodiscard]] std::size_t first_difference(const Array& other) const {
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      if (bytes_[i] != other.bytes_[i]) return (i / sizeof(T)) - offset_;
    }
    return bytes_.size();
  }

 private:
  std::vector<std::byte> bytes_;
  std::size_t offset_;
  bool wanted_;
};

struct Shape {
  std::size_t count, offset;
  std::uint32_t wanted;
  [[nodiscard]] bool wants(unsigned bit) const { return ((wanted >> bit) & 1u) != 0; }
};

/// Every array that some door fills. Constructed alike, they are equal until the doors fill them differently.
struct Outputs {
  Array<gte::ScreenXy> sxy;
  Array<std::uint16_t> sz, otz;
  Array<std::uint32_t> flag, flag2, z;
  Array<std::int16_t> ir0;
  Array<std::uint8_t> fx, fy;
  Array<std::int32_t> mac[3];
  Array<std::int16_t> ir[3];
  Array<gte::Colour> rgb;

  explicit Outputs(Shape s)
      : sxy(3 * s.count, s.offset, s.wants(0)),
        sz(3 * s.count, s.offset, s.wants(1)),
        otz(s.count, s.offset, s.wants(2)),
        flag(s.count, s.offset, s.wants(3)),
        flag2(s.count, s.offset, s.wants(4)),
        z(s.count, s.offset, s.wants(5)),
        ir0(s.count, s.offset, s.wants(6)),
        fx(s.count, s.offset, s.wants(7)),
        fy(s.count, s.offset, s.wants(8)),
        mac{{s.count, s.offset, s.wants(9)},
            {s.count, s.offset, s.wants(10)},
            {s.count, s.offset, s.wants(11)}},
        ir{{s.count, s.offset, s.wants(12)},
           {s.count, s.offset, s.wants(13)},
           {s.count, s.offset, s.wants(14)}},
        rgb(3 * s.count, s.offset, s.wants(15)) {}

  /// The first array in which the two differ, and where; empty when they are equal.
  [[nodiscard]] std::string difference(const Outputs& o) const {
    const auto name = [](const char* what, const auto& a, const auto& b) {
      return a == b ? std::string() : std::string(what) + "[" + std::to_string(a.first_difference(b)) + "] ";
    };
    std::string all = name("sxy", sxy, o.sxy) + name("sz", sz, o.sz) + name("otz", otz, o.otz) +
                      name("flag", flag, o.flag) + name("flag2", flag2, o.flag2) + name("z_20_12", z, o.z) +
                      name("ir0", ir0, o.ir0) + name("fraction_x", fx, o.fx) + name("fraction_y", fy, o.fy) +
                      name("rgb", rgb, o.rgb);
    for (std::size_t i = 0; i < 3; ++i) all += name("mac", mac[i], o.mac[i]) + name("ir", ir[i], o.ir[i]);
    return all;
  }
};

/// One random batch for one door.
struct Case {
  gte::Registers setup;
  gte::Command command;
  std::vector<gte::Vertex> vertices;
  std::vector<gte::Colour> colours;
  std::vector<std::int16_t> ir0;
  bool own_colours, own_ir0;
  gte::Light light;
};

Case make_case(Random& random, Kind kind, std::size_t count) {
  Case c;
  c.setup = tests::registers(random, kind);
  c.command = random.word();
  if (kind == Kind::tame) c.command = c.command.word | (1u << 19);
  c.vertices = tests::vertices(random, kind, 3 * count);
  c.colours.resize(3 * count);
  for (auto& colour : c.colours) colour = gte::detail::colour(random.hostile_word());
  c.ir0.resize(3 * count);
  for (auto& ir0 : c.ir0) {
    ir0 = static_cast<std::int16_t>(kind == Kind::tame ? random.below(0x1001) : random.hostile_word());
  }
  c.own_colours = random.below(3) != 0;
  c.own_ir0 = random.below(3) != 0;
  c.light = static_cast<gte::Light>(random.below(3));
  return c;
}

template <class T>
std::span<const T> first(const std::vector<T>& v, std::size_t count, bool wanted = true) {
  return wanted ? std::span<const T>(v).first(count) : std::span<const T>();
}

using Door = void (*)(const Case&, std::size_t count, Outputs&);

void project(const Case& c, std::size_t count, Outputs& o) {
  gte::project(c.setup, first(c.vertices, count),
               {o.sxy.get(), o.sz.get(), o.flag.get(), o.ir0.get(), o.z.get(), o.fx.get(), o.fy.get()},
               c.command);
}
void project_triangles(const Case& c, std::size_t count, Outputs& o) {
  gte::project_triangles(
      c.setup, first(c.vertices, 3 * count),
      {o.sxy.get(), o.sz.get(), o.flag.get(), o.ir0.get(), o.mac[0].get(), o.otz.get(), o.flag2.get()},
      c.command);
}
void light(const Case& c, std::size_t count, Outputs& o) {
  gte::light(c.setup, c.light, first(c.vertices, count), first(c.colours, count, c.own_colours),
             first(c.ir0, count, c.own_ir0), {o.rgb.get(), o.flag.get()}, c.command);
}
void cue(const Case& c, std::size_t count, Outputs& o) {
  gte::cue(c.setup, first(c.colours, count), first(c.ir0, count, c.own_ir0), {o.rgb.get(), o.flag.get()},
           c.command);
}
void cue_triples(const Case& c, std::size_t count, Outputs& o) {
  gte::cue_triples(c.setup, first(c.colours, 3 * count), first(c.ir0, count, c.own_ir0),
                   {o.rgb.get(), o.flag.get()}, c.command);
}
void multiply(const Case& c, std::size_t count, Outputs& o) {
  gte::multiply(c.setup, c.command, first(c.vertices, count),
                {{o.mac[0].get(), o.mac[1].get(), o.mac[2].get()},
                 {o.ir[0].get(), o.ir[1].get(), o.ir[2].get()},
                 o.flag.get()});
}

/// Runs `door` on at least `total` elements of every kind with every instruction set,
/// and with the single commands.
void equal_the_single_commands(Door door, std::size_t total) {
  const EachTarget targets;
  for (int kind = 0; kind < static_cast<int>(Kind::count); ++kind) {
    Random random(static_cast<std::uint64_t>(kind) + 1);
    std::size_t done = 0;
    while (done < total) {
      const std::size_t count = random.below(8) == 0 ? random.below(600) : random.below(40);
      const Case c = make_case(random, static_cast<Kind>(kind), count);
      const Shape shape{count, random.below(9), random.below(4) == 0 ? random.word() : 0xffffffff};
      Outputs expected(shape);
      REQUIRE(gte::use_batch_target("scalar"));
      door(c, count, expected);
      for (const char* name : targets.names) {
        Outputs got(shape);
        REQUIRE(gte::use_batch_target(name));
        door(c, count, got);
        const std::string difference = got.difference(expected);
        if (!difference.empty()) {
          FAIL_CHECK(std::string(name), ", kind ", kind, ", ", count, " elements, command ", c.command.word,
                     ": ", difference);
          return;
        }
      }
      done += count + 1;
    }
  }
}

constexpr std::size_t few = 30'000;      // per kind and target
constexpr std::size_t many = 2'000'000;  // five kinds: 10 million per target

}  // namespace

TEST_SUITE("gte") {
  TEST_CASE("project gives the bits of RTPS on every target") { equal_the_single_commands(project, few); }
  TEST_CASE("project_triangles gives the bits of RTPT, NCLIP and AVSZ3 on every target") {
    equal_the_single_commands(project_triangles, few);
  }
  TEST_CASE("light gives the bits of NCS, NCCS and NCDS on every target") {
    equal_the_single_commands(light, few);
  }
  TEST_CASE("cue gives the bits of DPCS on every target") { equal_the_single_commands(cue, few); }
  TEST_CASE("cue_triples gives the bits of DPCT on every target") {
    equal_the_single_commands(cue_triples, few);
  }
  TEST_CASE("multiply gives the bits of MVMVA on every target") { equal_the_single_commands(multiply, few); }

  TEST_CASE("measure_triangles and measure_quads give the bits of NCLIP, AVSZ3 and AVSZ4") {
    Random random(11);
    for (int round = 0; round < 400; ++round) {
      const gte::Registers setup =
          tests::registers(random, static_cast<Kind>(random.below(static_cast<std::uint32_t>(Kind::count))));
      std::vector<gte::ScreenXy> sxy(1 + random.below(50));
      std::vector<std::uint16_t> sz(sxy.size());
      for (auto& xy : sxy)
        xy = {static_cast<std::int16_t>(random.hostile_word()),
              static_cast<std::int16_t>(random.hostile_word())};
      for (auto& z : sz) z = static_cast<std::uint16_t>(random.hostile_word());
      for (const std::size_t corners : {3u, 4u}) {
        std::vector<std::uint32_t> indices(corners * random.below(20));
        for (auto& index : indices) index = random.below(static_cast<std::uint32_t>(sxy.size()));
        const std::size_t faces = indices.size() / corners;
        std::vector<std::int32_t> mac0(faces);
        std::vector<std::uint32_t> nclip_flag(faces), avsz_flag(faces);
        std::vector<std::uint16_t> otz(faces);
        (corners == 3 ? gte::measure_triangles : gte::measure_quads)(
            setup, sxy, sz, indices, {mac0.data(), nclip_flag.data(), otz.data(), avsz_flag.data()});
        for (std::size_t face = 0; face < faces; ++face) {
          gte::Registers r = setup;
          for (std::size_t k = 0; k < corners; ++k) {
            if (k < 3) r.sxy[k] = sxy[indices[face * corners + k]];
            r.sz[4 - corners + k] = sz[indices[face * corners + k]];
          }
          gte::nclip(r);
          REQUIRE(mac0[face] == r.mac[0]);
          REQUIRE(nclip_flag[face] == r.flag);
          corners == 3 ? gte::avsz3(r) : gte::avsz4(r);
          REQUIRE(otz[face] == r.otz);
          REQUIRE(avsz_flag[face] == r.flag);
        }
      }
    }
  }

  TEST_CASE("an empty batch and one with nothing wanted do nothing") {
    const EachTarget targets;
    const std::vector<gte::Vertex> vertices(33);
    for (const char* name : targets.names) {
      REQUIRE(gte::use_batch_target(name));
      gte::project({}, {}, {});
      gte::project({}, vertices, {});
      gte::project_triangles({}, vertices, {});
      gte::light({}, gte::Light::ncds, vertices, {}, {}, {});
      gte::multiply({}, gte::sdk::mvmva, vertices, {});
      CHECK(gte::batch_target() == std::string(name));
    }
  }

  TEST_CASE("long: project, ten million vertices per target" * doctest::skip()) {
    equal_the_single_commands(project, many);
  }
  TEST_CASE("long: project_triangles, ten million triangles per target" * doctest::skip()) {
    equal_the_single_commands(project_triangles, many);
  }
  TEST_CASE("long: light, ten million normals per target" * doctest::skip()) {
    equal_the_single_commands(light, many);
  }
  TEST_CASE("long: cue, ten million colours per target" * doctest::skip()) {
    equal_the_single_commands(cue, many);
  }
  TEST_CASE("long: cue_triples, ten million triples per target" * doctest::skip()) {
    equal_the_single_commands(cue_triples, many);
  }
  TEST_CASE("long: multiply, ten million vectors per target" * doctest::skip()) {
    equal_the_single_commands(multiply, many);
  }

  TEST_CASE("an unknown instruction set is refused and changes nothing") {
    const std::string before = gte::batch_target();
    CHECK_FALSE(gte::use_batch_target("abacus"));
    CHECK(gte::batch_target() == before);
  }
}
