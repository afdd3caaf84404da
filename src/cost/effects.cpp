#include "cost/effects.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "cost/axes.h"
#include "cost/metrics.h"
#include "cost/packet_edit.h"
#include "cost/text.h"
#include "scene/plan.h"

namespace cost {
namespace {

using Json = nlohmann::ordered_json;

using Timed = std::function<base::Result<double>()>;  // draws once; milliseconds

/// A frame as it is, and without one effect after the other. Each is timed beside the whole frame, before and
/// after it in turn, so that what a busy machine adds falls on both alike.
class Variants {
 public:
  explicit Variants(Timed whole) : whole_(std::move(whole)) {}
  void add(Effect effect, Timed without) { variants_.push_back({std::move(effect), std::move(without), {}}); }
  /// `keep_going` is asked before each timing.
  void run(int round, const std::function<bool()>& keep_going) {
    if (variants_.empty() && keep_going()) time_whole();
    for (Variant& v : variants_) {
      if (!keep_going()) return;
      const bool whole_first = round % 2 == 0;
      const double before = whole_first ? time_whole() : 0;
      const auto without = v.without();
      const double with = whole_first ? before : time_whole();
      if (without) v.differences.push_back(with - *without);
    }
  }
  [[nodiscard]] std::size_t timings() const { return std::max<std::size_t>(1, variants_.size()); }
  [[nodiscard]] double whole_ms() const { return wholes_.empty() ? 0 : median(wholes_); }
  void report(std::vector<Effect>& out) const {
    for (const Variant& v : variants_) {
      if (v.differences.empty()) continue;  // stopped before it had a turn
      out.push_back(v.effect);
      out.back().ms = median(v.differences);
      out.back().spread = spread(v.differences);
    }
  }

 private:
  struct Variant {
    Effect effect;
    Timed without;
    std::vector<double> differences;
  };
  double time_whole() {
    wholes_.push_back(whole_().value_or(0));
    return wholes_.back();
  }

  Timed whole_;
  std::vector<Variant> variants_;
  std::vector<double> wholes_;
};

base::Result<double> total_ms(Subject& subject, const scene::Knobs& knobs) {
  const auto drawn = subject.draw(knobs);
  if (!drawn) return tl::make_unexpected(drawn.error());
  return drawn->stages.total();
}

/// The scene with its fog lifted, or its lamps put out.
enum class Without : std::uint8_t { fog, light };
scene::Scene stripped(const scene::Scene& scene, Without what) {
  const auto strip = [what](scene::World& world) {
    if (what == Without::fog) {
      world.depth_cue.on = false;
    } else {
      for (auto& material : world.materials) material.lit = false;
    }
  };
  scene::Scene copy = scene;
  strip(copy.world);
  copy.animate = [animate = scene.animate, strip](scene::World& world, double seconds) {
    if (animate) animate(world, seconds);
    strip(world);
  };
  return copy;
}

/// Knobs that are not at the console's setting: each is an effect that can be taken away.
std::vector<std::string> raised(const scene::Knobs& knobs) {
  std::vector<std::string> names;
  const scene::Knobs console = console_knobs(knobs);
  for (const auto& knob : scene::knob_table()) {
    if (knob.get(knobs) != knob.get(console)) names.emplace_back(knob.name);
  }
  return names;
}

scene::Knobs lowered(const scene::Knobs& knobs, std::string_view name) {
  scene::Knobs less = knobs;
  for (const auto& knob : scene::knob_table()) {
    if (knob.name == name) knob.set(less, knob.get(console_knobs(knobs)));
  }
  return less;
}

/// By ot::Blend.
constexpr std::array blend_names{"", ", B/2+F/2", ", B+F", ", B-F", ", B+F/4"};

std::string kernel_name(const gpu::Mode& mode) {
  static constexpr std::array textures{"flat colour", "4-bit texture", "8-bit texture", "15-bit texture"};
  static constexpr std::array shades{"", ", Gouraud", ", raw"};
  const bool untextured = mode.surface.texture == gpu::TexelFormat::none;
  std::string name = untextured && mode.surface.shade == gpu::Shade::gouraud
                         ? "Gouraud colour"
                         : std::string(textures[static_cast<std::size_t>(mode.surface.texture)]) +
                               shades[static_cast<std::size_t>(mode.surface.shade)];
  if (mode.surface.dither) name += ", dither";
  if (mode.masked) name += ", masked";
  name += blend_names[static_cast<std::size_t>(mode.blend)];
  return mode.depth ? name + ", depth" : name;
}

std::string kernel_name(const gpu::canvas::Mode& mode) {
  static constexpr std::array textures{"colour", "4-bit texture", "8-bit texture", "15-bit texture"};
  std::string name = std::string("accurate: ") + textures[static_cast<std::size_t>(mode.texture)] +
                     blend_names[static_cast<std::size_t>(mode.blend)];
  return mode.depth ? name + ", depth" : name;
}

template <class Mode, std::size_t n>
void add_kernels(const std::array<std::uint64_t, n>& counts, const char* unit,
                 std::vector<std::string>& out) {
  std::vector<std::pair<std::uint64_t, std::size_t>> ran;
  for (std::size_t i = 0; i < n; ++i) {
    if (counts[i] != 0) ran.emplace_back(counts[i], i);
  }
  std::ranges::sort(ran, std::ranges::greater{});
  for (const auto& [count, i] : ran)
    out.push_back(kernel_name(Mode::at(i)) + ": " + std::to_string(count) + unit);
}

void find_kernels_and_buffers(const gpu::Gpu& gpu, const Drawn& drawn, EffectReport& report) {
  add_kernels<gpu::Mode>(gpu.counters().kernels, " triangles and rectangles", report.kernels);
  const auto add = [&report](std::string name, std::uint64_t bytes) {
    if (bytes != 0) report.buffers.push_back({std::move(name), bytes});
  };
  add("list in main RAM", drawn.stats.ram_bytes);
  add("depth plane", gpu.depth_bytes());
  add("queue of semi-transparent polygons", gpu.queue_bytes());
  add("accumulated picture", drawn.history_bytes);
  if (gpu.canvas() == nullptr) return;
  add_kernels<gpu::canvas::Mode>(gpu.canvas()->counters().runs, " runs", report.kernels);
  for (const auto& buffer : gpu.canvas()->buffers()) add(std::string(buffer.name), buffer.bytes);
}

/// Primitives that ask for an effect, and what they wrote.
template <class Asks>
Effect counted(std::string name, const gpu::Trace& trace, std::span<const std::uint32_t> written,
               Asks&& asks) {
  Effect effect{std::move(name)};
  for (std::size_t i = 0; i < trace.draws.size(); ++i) {
    if (!asks(trace.draws[i])) continue;
    ++effect.primitives;
    effect.pixels += written[i];
  }
  return effect;
}

bool is_polygon(const gpu::Primitive& p) { return p.kind == gpu::Kind::polygon; }

/// Where the corners of a polygon lie: tells which face it is of.
using Corners = std::array<std::int32_t, 8>;
Corners corners_of(const gpu::Primitive& p) {
  Corners c{};
  for (std::size_t i = 0; i < p.vertex_count; ++i) {
    c[2 * i] = p.vertices[i].x - p.state.offset_x();
    c[2 * i + 1] = p.vertices[i].y - p.state.offset_y();
  }
  return c;
}

/// Corners of the polygons of lit materials.
std::set<Corners> lit_polygons(Subject& subject, const scene::Scene& scene, const scene::Knobs& knobs) {
  const scene::World& world = scene.world;
  std::set<Corners> lit;
  for (const auto& polygon : subject.polygons(knobs)) {
    const auto& mesh = world.meshes[world.instances[polygon.instance].mesh];
    if (!world.materials[mesh.faces[polygon.face].material].lit) continue;
    Corners c{};
    for (std::size_t i = 0; i < (polygon.packet.quad ? 4U : 3U); ++i) {
      c[2 * i] = polygon.packet.xy[i].x;
      c[2 * i + 1] = polygon.packet.xy[i].y;
    }
    lit.insert(c);
  }
  return lit;
}

/// As often as asked, or nine times at least and then as often as fits into a second or two: the differences
/// of short frames are small beside the noise of a clock and a machine.
bool time_all(Variants& packets, Variants& frames, int rounds, const KeepGoing& keep_going) {
  constexpr int least = 9;
  constexpr int most = 201;
  constexpr std::chrono::milliseconds budget(1500);
  const auto begin = std::chrono::steady_clock::now();
  std::size_t done = 0;
  const auto all =
      static_cast<std::size_t>(rounds > 0 ? rounds : least) * (packets.timings() + frames.timings());
  bool goes_on = true;
  const auto ask = [&] {
    return goes_on = goes_on && (!keep_going || keep_going(std::min(done++, all), all));
  };
  for (int round = 0; round < (rounds > 0 ? rounds : most); ++round) {
    if (rounds == 0 && round >= least && std::chrono::steady_clock::now() - begin > budget) break;
    packets.run(round, ask);
    frames.run(round, ask);
    if (!goes_on) break;
  }
  return goes_on;
}

/// Draws whose texels lie where the canvas stands in for VRAM: they see what VRAM holds, not what was drawn.
bool reads_frame(const gpu::Primitive& p, const scene::Knobs& knobs) {
  return p.is_textured() && p.state.page_x() < knobs.width && p.state.page_y() < 480;
}

}  // namespace

base::Result<EffectReport> find_effects(const scene::Scene& scene, std::uint32_t frame,
                                        const scene::Knobs& knobs, int rounds, const KeepGoing& keep_going) {
  Subject subject(scene, frame);
  EffectReport report{scene.name, frame, knobs.width, knobs.height, 0, {}, {}, {}, {}, true};
  const auto drawn = subject.draw(knobs);
  if (!drawn) return tl::make_unexpected(drawn.error());
  auto words = subject.words(knobs);
  if (!words) return tl::make_unexpected(words.error());
  if (auto once = subject.draw_words(knobs, *words); !once) return tl::make_unexpected(once.error());
  find_kernels_and_buffers(subject.gpu(), *drawn, report);
  gpu::Trace trace;
  if (auto traced = subject.trace_console(knobs, trace); !traced) return tl::make_unexpected(traced.error());
  for (const auto& draw : trace.draws) {
    if (subject.uses_canvas(knobs) && reads_frame(draw, knobs) && report.notes.empty()) {
      report.notes.emplace_back(
          "a texture page lies in the frame buffer: it is read from VRAM, which the canvas does "
          "not draw into");
    }
  }
  const auto& written = trace.written;

  Variants packets([&] { return subject.draw_words(knobs, *words); });
  const auto asked = packet_effects();
  std::vector<std::vector<std::uint32_t>> edited(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto effect = counted(std::string(asked[i].name), trace, written, asked[i].asks);
    if (effect.primitives == 0) continue;
    edited[i] = without(*words, i);
    packets.add(effect, [&, i] { return subject.draw_words(knobs, edited[i]); });
  }
  Variants frames([&] { return total_ms(subject, knobs); });
  for (const auto& name : raised(knobs)) {
    std::string value;
    for (const auto& knob : scene::knob_table()) value += knob.name == name ? knob.get(knobs) : "";
    frames.add(counted(joined({name, " ", value}), trace, written, is_polygon),
               [&, less = lowered(knobs, name)] { return total_ms(subject, less); });
  }
  Subject clear(stripped(scene, Without::fog), frame);
  Subject unlit(stripped(scene, Without::light), frame);
  if (scene.world.depth_cue.on) {
    frames.add(counted("depth cue (fog)", trace, written, is_polygon),
               [&] { return total_ms(clear, knobs); });
  }
  const auto lit = lit_polygons(subject, scene, knobs);
  if (!lit.empty()) {
    frames.add(
        counted("lighting", trace, written,
                [&lit](const gpu::Primitive& p) { return is_polygon(p) && lit.contains(corners_of(p)); }),
        [&] { return total_ms(unlit, knobs); });
  }
  report.is_complete = time_all(packets, frames, rounds, keep_going);
  report.ms = frames.whole_ms();
  packets.report(report.effects);
  frames.report(report.effects);
  return report;
}

std::vector<std::string> kernels_that_ran(const gpu::Counters& counters) {
  std::vector<std::string> kernels;
  add_kernels<gpu::Mode>(counters.kernels, " triangles and rectangles", kernels);
  return kernels;
}

std::string to_text(const EffectReport& report) {
  std::string text =
      joined({report.scene, ", frame ", std::to_string(report.frame), ", ", std::to_string(report.width), "x",
              std::to_string(report.height), ": ", number(report.ms),
              " ms\n\neffect                         primitives     pixels        ms    spread\n"});
  std::array<char, 160> line{};
  for (const auto& e : report.effects) {
    std::snprintf(line.data(), line.size(), "  %-28s %10llu %10llu %9.4f %9.4f\n", e.name.c_str(),
                  static_cast<unsigned long long>(e.primitives), static_cast<unsigned long long>(e.pixels),
                  e.ms, e.spread);
    text += line.data();
  }
  if (report.effects.empty()) text += "  none: flat polygons in list order\n";
  text += "\nkernels that ran\n";
  for (const auto& kernel : report.kernels) text += joined({"  ", kernel, "\n"});
  text += "\nbuffers besides VRAM\n";
  for (const auto& buffer : report.buffers)
    text += joined({"  ", buffer.name, ": ", bytes(buffer.bytes), "\n"});
  for (const auto& note : report.notes) text += joined({"\nnote: ", note, "\n"});
  return text;
}

std::string to_json(const EffectReport& report) {
  Json effects = Json::array();
  for (const auto& e : report.effects) {
    effects.push_back({{"name", e.name},
                       {"primitives", e.primitives},
                       {"pixels", e.pixels},
                       {"ms", e.ms},
                       {"spread_ms", e.spread}});
  }
  Json buffers = Json::array();
  for (const auto& b : report.buffers) buffers.push_back({{"name", b.name}, {"bytes", b.bytes}});
  const Json json{{"schema", "otter.effects/1"}, {"scene", report.scene},     {"frame", report.frame},
                  {"width", report.width},       {"height", report.height},   {"ms", report.ms},
                  {"effects", effects},          {"kernels", report.kernels}, {"buffers", buffers},
                  {"notes", report.notes}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cost
