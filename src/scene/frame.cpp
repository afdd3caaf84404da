#include "scene/frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "gpu/gpu.h"
#include "ot/gp0.h"
#include "ot/gp1.h"
#include "scene/angle.h"
#include "scene/lists.h"
#include "scene/model.h"
#include "scene/split_order.h"
#include "scene/submit.h"
#include "scene/tessellate.h"

namespace scene {
namespace {

double now_ms() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(since).count();
}

// The longest image of a unit axis.
double scale_of(const glm::mat4& m) {
  double most = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 column(m[axis]);
    most = std::max(most, glm::dot(column, column));
  }
  return std::isfinite(most) ? std::sqrt(most) : 0;
}

// True if the map keeps angles and scales evenly: normals can go through the light matrix as they are.
bool is_even(const glm::dmat3& m) {
  const double size = glm::dot(m[0], m[0]);
  const double tolerance = size * 1e-4;
  return std::abs(glm::dot(m[1], m[1]) - size) <= tolerance &&
         std::abs(glm::dot(m[2], m[2]) - size) <= tolerance && std::abs(glm::dot(m[0], m[1])) <= tolerance &&
         std::abs(glm::dot(m[0], m[2])) <= tolerance && std::abs(glm::dot(m[1], m[2])) <= tolerance;
}

std::uint32_t draw_mode_of(const Knobs& knobs) {
  ot::DrawMode mode;
  mode.dither = knobs.colour == Colour::bits15_dither;
  mode.draw_to_display = knobs.height == 480;
  std::array<std::uint32_t, 1> word{};
  ot::encode(mode, word);
  return word[0];
}

std::uint8_t fraction_mask(Position position) {
  constexpr std::array<std::uint8_t, 4> masks{0, 0xc0, 0xf0, 0xff};
  return masks[static_cast<std::size_t>(position)];
}

}  // namespace

bool needs_depth(const Knobs& knobs) {
  return knobs.visibility == Visibility::zbuffer || knobs.texture == TextureAddress::perspective ||
         knobs.fog == Fog::pixel || needs_fractions(knobs);
}

bool needs_fractions(const Knobs& knobs) { return knobs.position != Position::integer; }

struct FrameBuilder::State {
  State(const Scene& scene, const Knobs& knobs)
      : name(scene.name), world(scene.world), animate(scene.animate) {
    prepare(knobs);
  }

  // Everything that depends on size and subdivision, too.
  void prepare(const Knobs& knobs) {
    width = knobs.width;
    height = knobs.height;
    subdivide = knobs.subdivide.pieces();
    report.clear();
    move(0);
    units = choose_units(world);
    pack = pack_textures(world.textures, width);
    report = pack.report;
    materials = packet_materials(world.materials, pack.textures);
    models.clear();
    for (std::size_t i = 0; i < world.meshes.size(); ++i) add_model(static_cast<std::uint32_t>(i));
  }

  void add_model(std::uint32_t index) {
    double largest = 0;
    for (const auto& instance : world.instances)
      if (instance.mesh == index) largest = std::max(largest, scale_of(instance.model));
    const double wanted = units * (largest > 0 ? largest : 1);
    const Mesh& mesh = world.meshes[index];
    const auto cut = tessellate(mesh, world.materials, pack.textures, subdivide, report);
    models.push_back(make_model(cut ? cut->mesh : mesh,
                                cut ? std::span(cut->sources) : std::span<const std::uint32_t>{},
                                world.materials, pack.textures, wanted, world.depth_cue.on));
    const double scale = models.back().scale;
    if (scale < wanted * 0.999) {
      report.push_back("mesh " + std::to_string(index) + ": scaled to " + std::to_string(scale / wanted) +
                       " of its size to fit 16 bits");
    }
  }

  void move(double seconds) {
    if (animate) animate(world, seconds);
    if (camera) world.camera = *camera;
  }

  [[nodiscard]] PacketStyle style(const Knobs& knobs, Annotate annotate) const {
    PacketStyle s;
    s.windows = pack.uses_windows;
    s.depth = annotate == Annotate::always || needs_depth(knobs);
    s.fractions = needs_fractions(knobs);  // depth is that of the corners as drawn
    if (needs_fractions(knobs)) s.fraction_mask = fraction_mask(knobs.position);
    s.draw_mode = draw_mode_of(knobs);
    return s;
  }

  // bsp needs the depths, though the words it orders do not.
  [[nodiscard]] Wanted wanted(const Knobs& knobs, const PacketStyle& style) const {
    return {style.depth || knobs.visibility == Visibility::bsp, style.fractions,
            world.depth_cue.on && knobs.fog == Fog::vertex};
  }

  [[nodiscard]] BucketRule rule(const Knobs& knobs) const {
    if (knobs.visibility == Visibility::bsp) {
      return {std::max(1U, static_cast<std::uint32_t>(split.far_to_near().size())), 0, 0};
    }
    if (knobs.visibility != Visibility::sorted)
      return {static_cast<std::uint32_t>(knobs.buckets), knobs.bias, 1};
    const auto step =
        std::max<std::int64_t>(1, std::int64_t{sort_keys} / knobs.buckets);  // a bias means the same depth
    return {sort_keys, knobs.bias * step, step};
  }

  // One trip of all instances through projection, light and submission.
  template <class Sink>
  void pass(const Knobs& knobs, const Wanted& wanted, FrameStats& stats, Sink& sink) {
    const View view = view_of(world.camera, knobs.width, knobs.height, units);
    const Clipper clipper(view.projection, knobs.transform == Transform::gte);
    Placement placement;
    placement.projection = view.projection;
    placement.transform = knobs.transform;
    if (wanted.fog) set_depth_cue(placement.registers, world.depth_cue, view);
    std::optional<Halver> halver;
    if (knobs.subdivide.by != SubdivideBy::pieces) halver.emplace(knobs.subdivide, view.projection, clipper);
    Submission submission;
    submission.halver = halver ? &*halver : nullptr;
    submission.placement = &placement;
    submission.projected = &projected;
    submission.materials = materials;
    submission.clipper = &clipper;
    submission.key = knobs.key;
    if (needs_fractions(knobs)) submission.fraction_mask = fraction_mask(knobs.position);
    for (std::size_t i = 0; i < world.instances.size(); ++i) {
      const auto& instance = world.instances[i];
      if (instance.mesh >= models.size()) continue;
      const Model& model = models[instance.mesh];
      const double start = now_ms();
      placement.model = &model;
      if (!place(view, instance, placement)) {
        const auto faces = static_cast<std::uint32_t>(model.faces.size() + model.lines.size());
        stats.faces += faces;
        stats.dropped[static_cast<std::size_t>(Drop::unrepresentable)] += faces;
        continue;
      }
      project(placement, wanted, projected);
      stats.vertices += static_cast<std::uint32_t>(model.vertices.size());
      light(instance, model, placement);
      shader.shade(placement, projected, wanted.fog, colours);
      submission.colours = colours;
      submission.mirrored = glm::determinant(placement.exact.linear) * view_sign < 0;
      submission.instance = static_cast<std::uint32_t>(i);
      const double middle = now_ms();
      Submitter<Sink>(submission, stats, sink).submit();
      stats.gte_ms += middle - start;
      stats.ot_ms += now_ms() - middle;
    }
  }

  // Everything that goes into the list of this frame, in the order in which it is inserted.
  template <class Sink>
  void feed(const Knobs& knobs, const Wanted& wanted, FrameStats& stats, Sink& sink) {
    if (knobs.visibility != Visibility::bsp) return pass(knobs, wanted, stats, sink);
    const auto& ordered = split.far_to_near();
    for (std::size_t i = 0; i < ordered.size(); ++i) {
      sink.add(ordered[i].primitive, static_cast<std::uint32_t>(ordered.size() - 1 - i));
    }
  }

  static bool place(const View& view, const Instance& instance, Placement& placement) {
    placement.exact = to_view(view, instance.model, glm::dvec3(0), 1);
    const Model& model = *placement.model;
    return set_transform(placement.registers, to_view(view, instance.model, model.centre, model.scale),
                         view.projection);
  }

  void light(const Instance& instance, const Model& model, Placement& placement) {
    if (model.colours.lit == 0) return;
    const glm::dmat3 linear{glm::dvec3(instance.model[0]), glm::dvec3(instance.model[1]),
                            glm::dvec3(instance.model[2])};
    if (is_even(linear) || !(std::abs(glm::determinant(linear)) > 0)) {
      shader.use_model_normals();
      const double size = std::sqrt(glm::dot(linear[0], linear[0]));
      set_lights(placement.registers, world, size > 0 ? linear / size : glm::dmat3(1.0));
    } else {
      shader.use_world_normals(model, glm::transpose(glm::inverse(linear)));
      set_lights(placement.registers, world, glm::dmat3(1.0));
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> environment(const Knobs& knobs, std::int32_t buffer_y) const {
    std::vector<std::uint32_t> words(16);
    const std::span all(words);
    const auto y = static_cast<std::uint16_t>(buffer_y);
    const auto w = static_cast<std::uint16_t>(knobs.width);
    const auto h = static_cast<std::uint16_t>(knobs.height);
    std::size_t n = 0;
    words[n++] = draw_mode_of(knobs);
    n += ot::encode(ot::TextureWindow{}, all.subspan(n));
    n += ot::encode(
        ot::DrawArea{0, y, static_cast<std::uint16_t>(w - 1), static_cast<std::uint16_t>(y + h - 1)},
        all.subspan(n));
    n += ot::encode(ot::DrawOffset{{0, static_cast<std::int16_t>(y)}}, all.subspan(n));
    n += ot::encode(ot::MaskBits{}, all.subspan(n));
    const Rgb8 b = world.background;
    n += ot::encode(ot::Fill{{b.r, b.g, b.b}, 0, y, w, h}, all.subspan(n));
    words.resize(n);
    return words;
  }

  std::string name;
  World world;
  std::function<void(World&, double)> animate;
  std::optional<Camera> camera;

  int width = 0, height = 0, subdivide = 1;
  double units = 1;
  TexturePack pack;
  std::vector<PacketMaterial> materials;
  std::vector<Model> models;
  std::vector<std::string> report;
  static constexpr double view_sign = 1;  // x right, y down, z in: the axes of view space keep orientation

  // Memory that frames use one after the other.
  Projected projected;
  std::vector<gte::Colour> colours;
  Shader shader;
  ListBuilder list;
  SplitOrder split;  // visibility bsp

  // The frame being drawn.
  Knobs frame_knobs;
  Annotate frame_annotate = Annotate::when_needed;
  std::vector<BucketRange> ranges;
  std::size_t next_range = 0;
};

FrameBuilder::FrameBuilder(const Scene& scene, const Knobs& knobs)
    : state_(std::make_unique<State>(scene, knobs)) {}
FrameBuilder::~FrameBuilder() = default;
FrameBuilder::FrameBuilder(FrameBuilder&&) noexcept = default;
FrameBuilder& FrameBuilder::operator=(FrameBuilder&&) noexcept = default;

const std::vector<std::string>& FrameBuilder::report() const { return state_->report; }
double FrameBuilder::units_per_world() const { return state_->units; }
const World& FrameBuilder::world() const { return state_->world; }
void FrameBuilder::set_camera(const Camera* camera) {
  state_->camera = camera != nullptr ? std::optional(*camera) : std::nullopt;
}

bool FrameBuilder::needs_upload(const Knobs& knobs) const {
  return knobs.width != state_->width || knobs.height != state_->height ||
         knobs.subdivide.pieces() != state_->subdivide;
}

void FrameBuilder::prepare(const Knobs& knobs) {
  if (needs_upload(knobs)) state_->prepare(knobs);
}

std::vector<std::uint32_t> FrameBuilder::upload_gp0() const {
  std::vector<std::uint32_t> words{
      ot::gp0::clear_cache};  // the CLUT cache must not keep what was there before
  for (const auto& block : state_->pack.blocks) {
    std::array<std::uint32_t, 3> header{};
    ot::encode(block.area, header);
    words.insert(words.end(), header.begin(), header.end());
    for (std::size_t i = 0; i < block.halfwords.size(); i += 2) {
      const std::uint32_t high = i + 1 < block.halfwords.size() ? block.halfwords[i + 1] : 0U;
      words.push_back(block.halfwords[i] | high << 16);
    }
  }
  return words;
}

std::vector<std::uint32_t> FrameBuilder::display_gp1() const {
  const bool tall = state_->height == 480;
  namespace gp1 = ot::gp1;
  using namespace gp1::display_mode;
  // 480 lines come as two interlaced fields. The ranges are those of a 240-line NTSC picture.
  return {gp1::display_mode::make(put_width(state_->width) | Is480Lines::put(tall) | IsInterlaced::put(tall)),
          gp1::horizontal_range::make(0x260, 0xc60), gp1::vertical_range::make(0x10, 0x100),
          gp1::display_start::make(0, 0), gp1::display_off::make(false)};
}

void FrameBuilder::upload(gpu::Gpu& gpu) {
  gpu.gp0(upload_gp0());
  for (const auto word : display_gp1()) gpu.gp1(word);
}

base::Result<Frame> FrameBuilder::build(double seconds, const Knobs& knobs, ot::MainRam& ram,
                                        Annotate annotate, Pieces pieces) {
  State& s = *state_;
  if (needs_upload(knobs))
    return base::fail("the size or subdivide knob changed: prepare and upload first", base::Exit::failed);
  s.frame_knobs = knobs;
  s.frame_annotate = annotate;
  s.ranges.clear();
  s.next_range = 0;
  Frame frame;
  const double start = now_ms();
  s.move(seconds);
  frame.stats.gte_ms = now_ms() - start;
  frame.number = round_saturated<std::uint32_t>(seconds * 60);
  frame.buffer_y = knobs.height == 240 && frame.number % 2 == 1 ? 240 : 0;

  const auto style = s.style(knobs, annotate);
  const auto environment = s.environment(knobs, frame.buffer_y);
  const Wanted wanted = s.wanted(knobs, style);
  FrameStats collected;
  if (knobs.visibility == Visibility::bsp) {
    s.split.begin();
    s.pass(knobs, wanted, collected, s.split);
    const double before_split = now_ms();
    s.split.finish(knobs.width, knobs.height, style.fractions ? style.fraction_mask : std::uint8_t{0},
                   pieces == Pieces::snapped ? 1 : knobs.resolution);
    collected.ot_ms += now_ms() - before_split;
    collected.splits = s.split.splits();
    if (pieces == Pieces::snapped) collected.snapped = s.split.snap_pieces();
  }
  collected.gte_ms += frame.stats.gte_ms;
  frame.stats = collected;
  const auto rule = s.rule(knobs);
  const double before_clear = now_ms();
  s.list.begin(ram, knobs, rule, style, {0, rule.length - 1}, environment);
  frame.stats.ot_ms += now_ms() - before_clear;
  s.feed(knobs, wanted, frame.stats, s.list);
  if (s.list.is_full()) {
    BucketSizes sizes(rule, style);
    collected.gte_ms = frame.stats.gte_ms;
    collected.ot_ms = frame.stats.ot_ms;
    frame.stats = collected;
    s.feed(knobs, wanted, frame.stats, sizes);
    auto ranges = sizes.ranges(ListBuilder::room(ram, s.list.table_length()));
    if (!ranges) return tl::make_unexpected(ranges.error());
    s.ranges = std::move(*ranges);
    FrameStats again;
    s.list.begin(ram, knobs, rule, style, s.ranges[0], environment);
    s.feed(knobs, wanted, again, s.list);
    s.next_range = 1;
    frame.nearer_lists = static_cast<std::uint32_t>(s.ranges.size() - 1);
  }
  const double before_end = now_ms();
  s.list.end();
  frame.stats.ot_ms += now_ms() - before_end;
  frame.head = s.list.head();
  frame.table_address = s.list.table_address();
  frame.buckets = s.list.table_length();
  frame.stats.primitives = s.list.primitives();
  frame.stats.out_of_range = s.list.out_of_range();
  frame.stats.words = s.list.words();
  frame.stats.ram_bytes = s.list.ram_bytes();
  frame.stats.lists = 1;
  return frame;
}

base::Result<void> FrameBuilder::next(Frame& frame, ot::MainRam& ram) {
  State& s = *state_;
  if (s.next_range >= s.ranges.size()) return base::fail("no list is left of this frame", base::Exit::failed);
  const auto rule = s.rule(s.frame_knobs);
  const auto style = s.style(s.frame_knobs, s.frame_annotate);
  const Wanted wanted = s.wanted(s.frame_knobs, style);
  // The environment stays as it is, but the picture must not be filled again.
  auto environment = s.environment(s.frame_knobs, frame.buffer_y);
  environment.resize(environment.size() - 3);
  FrameStats again;
  s.list.begin(ram, s.frame_knobs, rule, style, s.ranges[s.next_range++], environment);
  s.feed(s.frame_knobs, wanted, again, s.list);
  s.list.end();
  frame.stats.gte_ms += again.gte_ms;
  frame.stats.ot_ms += again.ot_ms;
  frame.stats.primitives += s.list.primitives();
  frame.stats.out_of_range += s.list.out_of_range();
  frame.stats.words += s.list.words();
  frame.stats.ram_bytes = std::max(frame.stats.ram_bytes, s.list.ram_bytes());
  ++frame.stats.lists;
  --frame.nearer_lists;
  return {};
}

std::vector<NodeMark> FrameBuilder::marks() const {
  std::vector<NodeMark> out;
  const bool is_split = state_->frame_knobs.visibility == Visibility::bsp;
  const auto& ordered = state_->split.far_to_near();
  for (const auto& node : state_->list.sorted()) {
    NodeMark mark{.tag = node.first_node, .key = node.key};
    if (is_split) {
      const OrderedPrimitive& piece = ordered[ordered.size() - 1 - node.key];
      mark.key = none;
      if (!piece.is_whole) mark.limits = gpu::Limits{piece.rows.top, piece.rows.spans};
    }
    out.push_back(mark);
  }
  return out;
}

void FrameBuilder::polygons(double seconds, const Knobs& knobs, std::vector<ScreenPolygon>& out) {
  State& s = *state_;
  prepare(knobs);
  s.move(seconds);
  out.clear();
  const auto rule = s.rule(knobs);
  const auto style = s.style(knobs, Annotate::always);
  FrameStats stats;
  const auto collect = [&](const Primitive& p) {
    if (p.count == 2) return;
    ScreenPolygon polygon;
    polygon.packet = polygon_of(p);
    polygon.depth = depth_of(p, style.fraction_mask, true);
    polygon.otz = p.otz;
    polygon.bucket = rule.of(p);
    polygon.instance = p.instance;
    polygon.face = p.face;
    if (p.material->texture != nullptr) {
      polygon.window = p.material->texture->window;
    } else {
      polygon.packet.texpage = p.material->texpage;
    }
    out.push_back(polygon);
  };
  s.pass(knobs, {true, true, s.world.depth_cue.on && knobs.fog == Fog::vertex}, stats, collect);
}

std::uint32_t FrameBuilder::show_gp1(const Frame& frame) {
  return ot::gp1::display_start::make(0, frame.buffer_y);
}

}  // namespace scene
