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

base::Result<double> total_ms(Subject& subject, const scene::Knobs& knobs) {
  const auto drawn = subject.draw(knobs);
  if (!drawn) return tl::make_unexpected(drawn.error());
  return drawn->stages.total();
}

base::Result<double> vertex_ms(Subject& subject, const scene::Knobs& knobs) {
  const auto drawn = subject.draw(knobs);
  if (!drawn) return tl::make_unexpected(drawn.error());
  return drawn->stages.gte + drawn->stages.ot;
}

/// The scene with its fog lifted, and with its lamps put out as well.
enum class Without : std::uint8_t { fog, fog_and_light };
scene::Scene stripped(const scene::Scene& scene, Without what) {
  const auto strip = [what](scene::World& world) {
    world.depth_cue.on = false;
    if (what == Without::fog) return;
    for (auto& material : world.materials) material.lit = false;
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

/// "filter bilinear".
std::string said_of(const scene::Knobs& knobs, std::string_view name) {
  for (const auto& knob : scene::knob_table()) {
    if (knob.name == name) return joined({name, " ", knob.get(knobs)});
  }
  return {};
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
bool time_all(std::initializer_list<Chain*> chains, int rounds, const KeepGoing& keep_going) {
  constexpr int least = 9;
  constexpr int most = 201;
  constexpr std::chrono::milliseconds budget(1500);
  const auto begin = std::chrono::steady_clock::now();
  std::size_t done = 0, timings = 0;
  for (const Chain* chain : chains) timings += chain->timings();
  const auto all = static_cast<std::size_t>(rounds > 0 ? rounds : least) * timings;
  bool goes_on = true;
  const auto ask = [&] {
    return goes_on = goes_on && (!keep_going || keep_going(std::min(done++, all), all));
  };
  for (int round = 0; round < (rounds > 0 ? rounds : most); ++round) {
    if (rounds == 0 && round >= least && std::chrono::steady_clock::now() - begin > budget) break;
    for (Chain* chain : chains) chain->run(round, ask);
    if (!goes_on) break;
  }
  return goes_on;
}

/// Draws whose texels lie where the canvas stands in for VRAM: they see what VRAM holds, not what was drawn.
bool reads_frame(const gpu::Primitive& p, const scene::Knobs& knobs) {
  return p.is_textured() && p.state.page_x() < knobs.width && p.state.page_y() < 480;
}

/// What no plan of a frame shows: what is cut before any, and what works on finished pictures.
bool matters_beside_the_plan(std::string_view name, const scene::Knobs& knobs, const scene::Plan& plan) {
  using scene::AntialiasKind;
  const auto kind = knobs.antialias.kind;
  const bool has_samples = kind != AntialiasKind::off && kind != AntialiasKind::fxaa && plan.shown.polygons;
  if (name == "size") return true;
  if (name == "subdivide") return knobs.subdivide.pieces() > 1 && plan.shown.textured;
  if (name == "antialias") return kind == AntialiasKind::fxaa;
  if (name == "aa-filter") return has_samples && kind != AntialiasKind::taa;
  return name == "aa-space" && has_samples;
}

}  // namespace

void Chain::run(int round, const std::function<bool()>& keep_going) {
  const bool forth = round % 2 == 0;
  std::vector<std::optional<double>> times(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    if (!keep_going()) return;
    const std::size_t k = forth ? i : steps_.size() - 1 - i;
    if (const auto time = steps_[k].time()) times[k] = *time;
  }
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    if (!times[k]) continue;
    steps_[k].times.push_back(*times[k]);
    if (k > 0 && times[k - 1]) steps_[k].differences.push_back(*times[k - 1] - *times[k]);
  }
}

double Chain::whole() const { return steps_[0].times.empty() ? 0 : median(steps_[0].times); }

double Chain::remainder() const {
  double left = whole();
  for (const Step& step : steps_) left -= step.differences.empty() ? 0 : median(step.differences);
  return left;
}

void Chain::report(std::vector<Effect>& out) const {
  for (const Step& step : steps_) {
    if (step.differences.empty()) continue;  // the whole, or stopped before it had a turn
    out.push_back(step.effect);
    out.back().ms = median(step.differences);
    out.back().spread = spread(step.differences);
  }
}

std::vector<std::string> knobs_not_needed(Subject& subject, const scene::Knobs& knobs) {
  std::vector<std::string> list;
  const scene::Plan plan = subject.plan_of(knobs);
  for (const auto& name : raised(knobs)) {
    const scene::Knobs less = lowered(knobs, name);
    if (subject.plan_of(less) == plan && !matters_beside_the_plan(name, knobs, plan))
      list.push_back(said_of(knobs, name));
  }
  return list;
}

base::Result<EffectReport> find_effects(const scene::Scene& scene, std::uint32_t frame,
                                        const scene::Knobs& knobs, int rounds, const KeepGoing& keep_going) {
  Subject subject(scene, frame);
  EffectReport report;
  report.scene = scene.name;
  report.frame = frame;
  report.width = knobs.width;
  report.height = knobs.height;
  const auto drawn = subject.draw(knobs);
  if (!drawn) return tl::make_unexpected(drawn.error());
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

  report.not_needed = knobs_not_needed(subject, knobs);
  Chain frames([&] { return total_ms(subject, knobs); });
  scene::Knobs console = knobs;
  for (const auto& name : raised(knobs)) {
    console = lowered(console, name);
    const auto said = said_of(knobs, name);
    if (std::ranges::find(report.not_needed, said) != report.not_needed.end()) continue;
    frames.add(counted(said, trace, written, is_polygon),
               [&, less = console] { return total_ms(subject, less); });
  }
  if (auto ready = subject.draw(console); !ready) return tl::make_unexpected(ready.error());
  auto words = subject.words(console);
  if (!words) return tl::make_unexpected(words.error());

  Chain packets([&] { return subject.draw_words(console, *words); });
  const auto asked = packet_effects();
  std::vector<std::vector<std::uint32_t>> edited(asked.size());
  const auto* left = &*words;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto effect = counted(std::string(asked[i].name), trace, written, asked[i].asks);
    if (effect.primitives == 0) continue;
    edited[i] = without(*left, i);
    left = &edited[i];
    packets.add(effect, [&, i] { return subject.draw_words(console, edited[i]); });
  }

  Subject clear(stripped(scene, Without::fog), frame);
  Subject bare(stripped(scene, Without::fog_and_light), frame);
  Chain vertices([&] { return vertex_ms(subject, console); });
  if (scene.world.depth_cue.on) {
    vertices.add(counted("depth cue (fog)", trace, written, is_polygon),
                 [&] { return vertex_ms(clear, console); });
  }
  const auto lit = lit_polygons(subject, scene, knobs);
  if (!lit.empty()) {
    vertices.add(
        counted("lighting", trace, written,
                [&lit](const gpu::Primitive& p) { return is_polygon(p) && lit.contains(corners_of(p)); }),
        [&] { return vertex_ms(bare, console); });
  }
  report.is_complete = time_all({&frames, &packets, &vertices}, rounds, keep_going);
  report.ms = frames.whole();
  for (const Chain* chain : {&packets, &frames, &vertices}) chain->report(report.effects);
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
    std::snprintf(line.data(), line.size(), "  %-28s %10llu %10llu", e.name.c_str(),
                  static_cast<unsigned long long>(e.primitives), static_cast<unsigned long long>(e.pixels));
    text += line.data();
    if (e.is_within_noise()) {
      text += "    within noise\n";
      continue;
    }
    std::snprintf(line.data(), line.size(), " %9.4f %9.4f\n", e.ms, e.spread);
    text += line.data();
  }
  if (!report.effects.empty()) {
    std::snprintf(line.data(), line.size(), "  %-50s %9.4f\n", "the frame without any of them",
                  report.rest_ms());
    text += line.data();
  }
  if (report.effects.empty()) text += "  none: flat polygons in list order\n";
  for (std::size_t i = 0; i < report.not_needed.size(); ++i)
    text += joined({i == 0 ? "\nasked for, not needed\n" : "", "  ", report.not_needed[i], "\n"});
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
                       {"ms", std::max(0.0, e.ms)},
                       {"spread_ms", e.spread},
                       {"within_noise", e.is_within_noise()}});
  }
  Json buffers = Json::array();
  for (const auto& b : report.buffers) buffers.push_back({{"name", b.name}, {"bytes", b.bytes}});
  const Json json{
      {"schema", "otter.effects/1"}, {"scene", report.scene},       {"frame", report.frame},
      {"width", report.width},       {"height", report.height},     {"ms", report.ms},
      {"effects", effects},          {"kernels", report.kernels},   {"buffers", buffers},
      {"notes", report.notes},       {"rest_ms", report.rest_ms()}, {"not_needed", report.not_needed}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cost
