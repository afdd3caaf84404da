#include "gte/commands.h"

#include "gte/divide.h"
#include "gte/limits.h"

namespace gte {
namespace {

using Vector = std::array<std::int16_t, 3>;
using Sums = std::array<std::int64_t, 3>;
using Offsets = std::array<std::int32_t, 3>;

Vector vector(const Vertex& v) { return {v.x, v.y, v.z}; }
Vector ir_vector(const Registers& r) { return {r.ir[1], r.ir[2], r.ir[3]}; }

template <class Format>
Offsets raw(const std::array<Format, 3>& of) {
  return {of[0].raw, of[1].raw, of[2].raw};
}

std::int64_t product(S3_12 m, std::int16_t x) { return std::int64_t{m.raw} * x; }

/// Three products are below 3 * 2^30, so a translation below 2^30 cannot take the sum out of 44 bits, and no
/// partial sum needs its check.
bool cannot_overflow(const Offsets& t) {
  const auto magnitude = [](std::int32_t v) { return static_cast<std::uint32_t>(v ^ (v >> 31)); };
  return (magnitude(t[0]) | magnitude(t[1]) | magnitude(t[2])) < 1u << 30;
}

/// Translation + matrix * vector, every partial sum checked.
struct Checked {
  std::uint32_t bits = 0;
  Sums sums{};
};
[[gnu::noinline, gnu::cold]] Checked transform_checked(const Matrix& m, const Offsets& t, const Vector& x) {
  Limits limits;
  Sums a{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int component = static_cast<int>(i) + 1;
    a[i] = limits.mac(component, std::int64_t{t[i]} * 4096 + product(m[i][0], x[0]));
    a[i] = limits.mac(component, a[i] + product(m[i][1], x[1]));
    a[i] = limits.mac(component, a[i] + product(m[i][2], x[2]));
  }
  return {limits.bits, a};
}

[[gnu::always_inline]] inline Sums transform(Limits& limits, const Matrix& m, const Offsets& t,
                                             const Vector& x) {
  if (!cannot_overflow(t)) [[unlikely]] {
    const Vector copy = x;
    const Offsets offsets = t;
    const Checked checked = transform_checked(m, offsets, copy);
    limits.bits |= checked.bits;
    return checked.sums;
  }
  const auto row = [&](std::size_t i) {
    return std::int64_t{t[i]} * 4096 + product(m[i][0], x[0]) + product(m[i][1], x[1]) +
           product(m[i][2], x[2]);
  };
  return {row(0), row(1), row(2)};
}

/// The far colour in MVMVA: the hardware loses the first part of the sum, but not its flags.
[[gnu::noinline]] Sums transform_far_colour(Limits& limits, const Matrix& m, const Offsets& t,
                                            const Vector& x, int shift) {
  Sums a{};
  for (std::size_t i = 0; i < 3; ++i) {
    const int component = static_cast<int>(i) + 1;
    const std::int64_t lost = limits.mac(component, std::int64_t{t[i]} * 4096 + product(m[i][0], x[0]));
    limits.ir(component, static_cast<std::int32_t>(lost >> shift), -0x8000);
    a[i] = limits.mac(component, product(m[i][1], x[1]));
    a[i] = limits.mac(component, a[i] + product(m[i][2], x[2]));
  }
  return a;
}

/// Three of a kind by name: an array would be copied through memory where this stays in CPU registers.
template <class T>
struct Three {
  T x{}, y{}, z{};
};

/// MAC1..3 and IR1..3 on their way: registers are written once, when a command is done.
struct Result {
  Three<std::int32_t> mac{};
  Three<std::int16_t> ir{};
};

Vector vector(const Three<std::int16_t>& v) { return {v.x, v.y, v.z}; }

[[gnu::always_inline]] inline Result limited(Limits& limits, Three<std::int32_t> mac, std::int32_t lowest) {
  return {mac, {limits.ir(1, mac.x, lowest), limits.ir(2, mac.y, lowest), limits.ir(3, mac.z, lowest)}};
}
/// The same where it is the exception. Values in, values out: a reference would keep
/// the usual case in memory too.
struct Exception {
  std::uint32_t bits = 0;
  Three<std::int16_t> ir{};
};
[[gnu::noinline, gnu::cold]] Exception limited_rarely(std::int32_t mac1, std::int32_t mac2, std::int32_t mac3,
                                                      std::int32_t lowest) {
  Limits limits;
  const Three<std::int16_t> ir = limited(limits, {mac1, mac2, mac3}, lowest).ir;
  return {limits.bits, ir};
}

[[gnu::always_inline]] inline Three<std::int32_t> shifted(Command c, const Sums& sums) {
  const auto mac = [&](std::size_t i) { return static_cast<std::int32_t>(sums[i] >> c.shift()); };
  return {mac(0), mac(1), mac(2)};
}

/// MACi and IRi from sums. IR is limited from the low 32 bits, as the hardware does. One test tells that
/// nothing is to be limited: MAC - lowest has no bit above those of 7FFFh - lowest, which is 7FFFh or FFFFh.
[[gnu::always_inline]] inline Result result(Limits& limits, Command c, const Sums& sums,
                                            std::int32_t lowest) {
  const auto [x, y, z] = shifted(c, sums);
  const auto above = [&](std::int32_t m) {
    return static_cast<std::uint32_t>(m) - static_cast<std::uint32_t>(lowest);
  };
  const auto kept = [](std::int32_t m) { return static_cast<std::int16_t>(m); };
  Result out{{x, y, z}, {kept(x), kept(y), kept(z)}};
  if (((above(x) | above(y) | above(z)) & ~above(0x7fff)) != 0) [[unlikely]] {
    const Exception rare = limited_rarely(x, y, z, lowest);
    limits.bits |= rare.bits;
    out.ir.x = rare.ir.x;
    out.ir.y = rare.ir.y;
    out.ir.z = rare.ir.z;
  }
  return out;
}
[[gnu::always_inline]] inline Result result(Limits& limits, Command c, const Sums& sums) {
  return result(limits, c, sums, c.lowest_ir());
}

[[gnu::always_inline]] inline void store(Registers& r, const Result& out) {
  r.mac[1] = out.mac.x;
  r.mac[2] = out.mac.y;
  r.mac[3] = out.mac.z;
  r.ir[1] = out.ir.x;
  r.ir[2] = out.ir.y;
  r.ir[3] = out.ir.z;
}

void push_screen(Registers& r, ScreenXy xy) {
  r.sxy[0] = r.sxy[1];
  r.sxy[1] = r.sxy[2];
  r.sxy[2] = xy;
}

void push_depth(Registers& r, std::uint16_t z) {
  r.sz[0] = r.sz[1];
  r.sz[1] = r.sz[2];
  r.sz[2] = r.sz[3];
  r.sz[3] = z;
}

/// One vertex of RTPS or RTPT; the quotient is what the depth cue of the last one needs.
[[gnu::always_inline]] inline std::uint32_t project(Registers& r, Limits& limits, Command c,
                                                    const Vertex& v) {
  const Sums a = transform(limits, r.rt, r.tr, vector(v));
  const Three<std::int32_t> mac = shifted(c, a);
  const std::int16_t ir1 = limits.ir(1, mac.x, c.lowest_ir());
  const std::int16_t ir2 = limits.ir(2, mac.y, c.lowest_ir());
  const auto z = static_cast<std::int32_t>(a[2] >> 12);
  limits.ir(3, z, -0x8000);  // FLAG looks at >> 12 whatever sf and lm say, IR3 does not
  const std::uint16_t sz3 = limits.depth(z);

  const Quotient q = divide(r.h, sz3);
  limits.bits |= q.overflow ? flag::divide_overflow : 0;
  const std::int64_t x = r.ofx.raw + std::int64_t{q.value} * ir1;
  const std::int64_t y = r.ofy.raw + std::int64_t{q.value} * ir2;
  limits.mac0(x);
  limits.mac0(y);
  store(r, {mac, {ir1, ir2, static_cast<std::int16_t>(std::clamp(mac.z, c.lowest_ir(), 0x7fff))}});
  push_depth(r, sz3);
  push_screen(r, {limits.screen_x(x >> 16), limits.screen_y(y >> 16)});
  return q.value;
}

void depth_cue(Registers& r, Limits& limits, std::uint32_t quotient) {
  const std::int64_t p = r.dqb.raw + std::int64_t{quotient} * r.dqa.raw;
  r.mac[0] = limits.mac0(p);
  r.ir[0] = limits.ir0(p >> 12);
}

[[gnu::always_inline]] inline void push_colour(Registers& r, Limits& limits, const Result& pushed) {
  // One store of 32 bits: four of a byte each would make whoever reads the colour back wait for all of them.
  const auto bits = [](std::int32_t m) { return static_cast<std::uint32_t>(m); };
  const auto [x, y, z] = pushed.mac;
  std::uint32_t newest = 0;
  if (((bits(x) | bits(y) | bits(z)) & ~0xfffu) == 0) [[likely]] {
    newest = bits(x) >> 4 | (bits(y) & 0xff0) << 4 | (bits(z) & 0xff0) << 12;
  } else {
    newest = std::uint32_t{limits.colour(1, x)} | std::uint32_t{limits.colour(2, y)} << 8 |
             std::uint32_t{limits.colour(3, z)} << 16;
  }
  newest |= std::uint32_t{r.rgbc.code} << 24;
  r.rgb[0] = r.rgb[1];
  r.rgb[1] = r.rgb[2];
  r.rgb[2] = detail::colour(newest);
}

Result light(const Registers& r, Limits& limits, Command c, std::size_t k) {
  // Never by a branch: half of all normals look away from a light, in no order a processor could learn.
  return limited(limits, shifted(c, transform(limits, r.llm, {}, vector(r.v[k]))), c.lowest_ir());
}

Result colour(const Registers& r, Limits& limits, Command c, const Vector& ir) {
  return result(limits, c, transform(limits, r.lcm, raw(r.bk), ir));
}

/// The primitive's colour times IR1..3.
Sums modulated(const Registers& r, const Vector& ir) {
  const auto term = [](std::uint8_t channel, std::int16_t x) { return std::int64_t{channel} * x * 16; };
  return {term(r.rgbc.r, ir[0]), term(r.rgbc.g, ir[1]), term(r.rgbc.b, ir[2])};
}

Sums from_bytes(Colour c) {
  return {std::int64_t{c.r} << 16, std::int64_t{c.g} << 16, std::int64_t{c.b} << 16};
}

/// Moves `in` toward the far colour by IR0. `in` is below 2^28, so neither sum comes
/// near 44 bits unless FC does.
[[gnu::always_inline]] inline Result cue(const Registers& r, Limits& limits, Command c, const Sums& in) {
  const auto distance = [&](std::size_t i) { return std::int64_t{r.fc[i].raw} * 4096 - in[i]; };
  Sums distances{distance(0), distance(1), distance(2)};
  if (!cannot_overflow(raw(r.fc))) [[unlikely]] {
    distances = {limits.mac(1, distances[0]), limits.mac(2, distances[1]), limits.mac(3, distances[2])};
  }
  const Vector ir = vector(result(limits, c, distances, -0x8000).ir);
  const auto moved = [&](std::size_t i) { return in[i] + std::int64_t{ir[i]} * r.ir[0]; };
  return result(limits, c, {moved(0), moved(1), moved(2)});
}

}  // namespace

void rtps(Registers& r, Command c) {
  Limits limits;
  depth_cue(r, limits, project(r, limits, c, r.v[0]));
  r.flag = limits.finish();
}

void rtpt(Registers& r, Command c) {
  Limits limits;
  project(r, limits, c, r.v[0]);
  project(r, limits, c, r.v[1]);
  depth_cue(r, limits, project(r, limits, c, r.v[2]));
  r.flag = limits.finish();
}

void nclip(Registers& r, Command) {
  Limits limits;
  r.mac[0] = limits.mac0(signed_area(r.sxy[0], r.sxy[1], r.sxy[2]));
  r.flag = limits.finish();
}

void avsz3(Registers& r, Command) {
  Limits limits;
  const DepthAverage average = depth_average(r.zsf3, r.sz[1] + r.sz[2] + r.sz[3]);
  r.mac[0] = limits.mac0(average.mac0);
  r.otz = limits.depth(average.otz);
  r.flag = limits.finish();
}

void avsz4(Registers& r, Command) {
  Limits limits;
  const DepthAverage average = depth_average(r.zsf4, r.sz[0] + r.sz[1] + r.sz[2] + r.sz[3]);
  r.mac[0] = limits.mac0(average.mac0);
  r.otz = limits.depth(average.otz);
  r.flag = limits.finish();
}

Matrix mvmva_matrix(const Registers& r, Command c) {
  const auto row = [](std::int16_t x, std::int16_t y, std::int16_t z) {
    return std::array<S3_12, 3>{S3_12{x}, S3_12{y}, S3_12{z}};
  };
  const auto same = [&](S3_12 m) { return row(m.raw, m.raw, m.raw); };
  switch (c.mx()) {
    case 0:
      return r.rt;
    case 1:
      return r.llm;
    case 2:
      return r.lcm;
    default:
      break;
  }
  const auto red = static_cast<std::int16_t>(r.rgbc.r << 4);
  return {row(static_cast<std::int16_t>(-red), red, r.ir[0]), same(r.rt[0][2]), same(r.rt[1][1])};
}

std::array<std::int32_t, 3> mvmva_translation(const Registers& r, Command c) {
  switch (c.cv()) {
    case 0:
      return r.tr;
    case 1:
      return raw(r.bk);
    case 2:
      return raw(r.fc);
    default:
      return {};
  }
}

void mvmva(Registers& r, Command c) {
  Limits limits;
  const Vector x = c.v() == 3 ? ir_vector(r) : vector(r.v[c.v()]);
  const Matrix garbage = c.mx() == 3 ? mvmva_matrix(r, c) : Matrix{};
  const std::array<const Matrix*, 4> matrices{&r.rt, &r.llm, &r.lcm, &garbage};
  const Matrix& m = *matrices[c.mx()];
  Sums sums;
  switch (c.cv()) {
    case 0:
      sums = transform(limits, m, r.tr, x);
      break;
    case 1:
      sums = transform(limits, m, raw(r.bk), x);
      break;
    case 2:
      sums = transform_far_colour(limits, m, raw(r.fc), x, c.shift());
      break;
    default:
      sums = transform(limits, m, {}, x);
      break;
  }
  store(r, result(limits, c, sums));
  r.flag = limits.finish();
}

void op(Registers& r, Command c) {
  Limits limits;
  const Vector d{r.rt[0][0].raw, r.rt[1][1].raw, r.rt[2][2].raw};
  const Vector x = ir_vector(r);
  const auto cross = [&](std::size_t i, std::size_t j) {
    return std::int64_t{d[i]} * x[j] - std::int64_t{d[j]} * x[i];
  };
  store(r, result(limits, c, {cross(1, 2), cross(2, 0), cross(0, 1)}));
  r.flag = limits.finish();
}

void sqr(Registers& r, Command c) {
  Limits limits;
  const auto square = [&](std::size_t i) { return std::int64_t{r.ir[i]} * r.ir[i]; };
  store(r, result(limits, c, {square(1), square(2), square(3)}));
  r.flag = limits.finish();
}

void gpf(Registers& r, Command c) {
  Limits limits;
  const auto scaled = [&](std::size_t i) { return std::int64_t{r.ir[0]} * r.ir[i]; };
  const Result out = result(limits, c, {scaled(1), scaled(2), scaled(3)});
  store(r, out);
  push_colour(r, limits, out);
  r.flag = limits.finish();
}

void gpl(Registers& r, Command c) {
  Limits limits;
  const auto added = [&](std::size_t i) {
    const std::int64_t base = std::int64_t{r.mac[i]} * (std::int64_t{1} << c.shift());
    return limits.mac(static_cast<int>(i), base + std::int64_t{r.ir[0]} * r.ir[i]);
  };
  const Result out = result(limits, c, {added(1), added(2), added(3)});
  store(r, out);
  push_colour(r, limits, out);
  r.flag = limits.finish();
}

namespace {

/// A light or depth cue command: its steps, then the push, once for each of its vertices.
template <std::size_t count = 1, class Steps>
[[gnu::always_inline]] inline void coloured(Registers& r, const Steps& steps) {
  Limits limits;
  for (std::size_t k = 0; k < count; ++k) {
    const Result out = steps(limits, k);
    push_colour(r, limits, out);
    if (k + 1 == count) store(r, out);
  }
  r.flag = limits.finish();
}

[[gnu::always_inline]] inline Result lit(const Registers& r, Limits& limits, Command c, std::size_t k) {
  return colour(r, limits, c, vector(light(r, limits, c, k).ir));
}

template <std::size_t count>
void lit_only(Registers& r, Command c) {
  coloured<count>(r, [&](Limits& limits, std::size_t k) { return lit(r, limits, c, k); });
}
template <std::size_t count>
void lit_modulated(Registers& r, Command c) {
  coloured<count>(r, [&](Limits& limits, std::size_t k) {
    return result(limits, c, modulated(r, vector(lit(r, limits, c, k).ir)));
  });
}
template <std::size_t count>
void lit_cued(Registers& r, Command c) {
  coloured<count>(r, [&](Limits& limits, std::size_t k) {
    return cue(r, limits, c, modulated(r, vector(lit(r, limits, c, k).ir)));
  });
}

}  // namespace

void ncs(Registers& r, Command c) { lit_only<1>(r, c); }
void nct(Registers& r, Command c) { lit_only<3>(r, c); }
void nccs(Registers& r, Command c) { lit_modulated<1>(r, c); }
void ncct(Registers& r, Command c) { lit_modulated<3>(r, c); }
void ncds(Registers& r, Command c) { lit_cued<1>(r, c); }
void ncdt(Registers& r, Command c) { lit_cued<3>(r, c); }

void cc(Registers& r, Command c) {
  coloured(r, [&](Limits& limits, std::size_t) {
    return result(limits, c, modulated(r, vector(colour(r, limits, c, ir_vector(r)).ir)));
  });
}

void cdp(Registers& r, Command c) {
  coloured(r, [&](Limits& limits, std::size_t) {
    return cue(r, limits, c, modulated(r, vector(colour(r, limits, c, ir_vector(r)).ir)));
  });
}

void dcpl(Registers& r, Command c) {
  coloured(r, [&](Limits& limits, std::size_t) { return cue(r, limits, c, modulated(r, ir_vector(r))); });
}

void dpcs(Registers& r, Command c) {
  coloured(r, [&](Limits& limits, std::size_t) { return cue(r, limits, c, from_bytes(r.rgbc)); });
}

void dpct(Registers& r, Command c) {  // each push moves the next colour into RGB0
  coloured<3>(r, [&](Limits& limits, std::size_t) { return cue(r, limits, c, from_bytes(r.rgb[0])); });
}

void intpl(Registers& r, Command c) {
  coloured(r, [&](Limits& limits, std::size_t) {
    const auto widened = [&](std::size_t i) { return std::int64_t{r.ir[i]} * 4096; };
    return cue(r, limits, c, {widened(1), widened(2), widened(3)});
  });
}

namespace {

void unlisted(Registers& r, Command) { r.flag = 0; }

constexpr std::array<CommandInfo, 22> commands{{
    {0x01, "RTPS", 15, rtps},  {0x06, "NCLIP", 8, nclip}, {0x0c, "OP", 6, op},      {0x10, "DPCS", 8, dpcs},
    {0x11, "INTPL", 8, intpl}, {0x12, "MVMVA", 8, mvmva}, {0x13, "NCDS", 19, ncds}, {0x14, "CDP", 13, cdp},
    {0x16, "NCDT", 44, ncdt},  {0x1b, "NCCS", 17, nccs},  {0x1c, "CC", 11, cc},     {0x1e, "NCS", 14, ncs},
    {0x20, "NCT", 30, nct},    {0x28, "SQR", 5, sqr},     {0x29, "DCPL", 8, dcpl},  {0x2a, "DPCT", 17, dpct},
    {0x2d, "AVSZ3", 5, avsz3}, {0x2e, "AVSZ4", 6, avsz4}, {0x30, "RTPT", 23, rtpt}, {0x3d, "GPF", 5, gpf},
    {0x3e, "GPL", 5, gpl},     {0x3f, "NCCT", 39, ncct},
}};

constexpr std::array<CommandInfo, 64> by_opcode() {
  std::array<CommandInfo, 64> table{};
  for (unsigned i = 0; i < 64; ++i) table[i] = {i, "", 0, unlisted};
  for (const CommandInfo& c : commands) table[c.opcode] = c;
  // Two that no document lists do what another does. [observed in one emulator; no capture]
  table[0x00].run = rtps;
  table[0x1a].run = dcpl;
  return table;
}

}  // namespace

constinit const std::array<CommandInfo, 64> command_table = by_opcode();

void execute(Registers& r, Command c) { command_table[c.opcode()].run(r, c); }

}  // namespace gte
