#include "scene/frame.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "gpu/gpu.h"
#include "ot/gp1.h"
#include "ot/packet.h"
#include "scene/angle.h"
#include "scene/content.h"
#include "scene/lists.h"
#include "scene/pass.h"
#include "scene/plan.h"
#include "scene/split_order.h"

namespace scene {
namespace {

// The first node of every list: where to draw, and the picture cleared.
std::vector<std::uint32_t> environment(const Plan& plan, Rgb8 background, std::int32_t buffer_y) {
  std::vector<std::uint32_t> words(16);
  const std::span all(words);
  const auto y = static_cast<std::uint16_t>(buffer_y);
  const auto w = static_cast<std::uint16_t>(plan.width);
  const auto h = static_cast<std::uint16_t>(plan.height);
  std::size_t n = 0;
  words[n++] = plan.style.draw_mode;
  n += ot::encode(ot::TextureWindow{}, all.subspan(n));
  n +=
      ot::encode(ot::DrawArea{0, y, static_cast<std::uint16_t>(w - 1), static_cast<std::uint16_t>(y + h - 1)},
                 all.subspan(n));
  n += ot::encode(ot::DrawOffset{{0, static_cast<std::int16_t>(y)}}, all.subspan(n));
  n += ot::encode(ot::MaskBits{}, all.subspan(n));
  n += ot::encode(ot::Fill{{background.r, background.g, background.b}, 0, y, w, h}, all.subspan(n));
  words.resize(n);
  return words;
}

}  // namespace

struct FrameBuilder::State {
  State(const Scene& scene, const Knobs& knobs) : world(scene.world), animate(scene.animate) {
    prepare(knobs);
  }

  void prepare(const Knobs& knobs) {
    move(0);
    content = Content(world, knobs.width, knobs.height, knobs.subdivide.pieces());
  }

  void move(double seconds) {
    if (animate) animate(world, seconds);
    if (camera) world.camera = *camera;
  }

  [[nodiscard]] Plan plan_of(const Knobs& knobs, Annotate annotate, Pieces pieces) const {
    return plan_frame(knobs,
                      {world, content.units, content.pack.uses_windows, content.shown, annotate, pieces});
  }

  // Everything that goes into the list of this frame, in the order in which it is inserted.
  template <class Sink>
  void feed(FrameStats& stats, Sink& sink) {
    if (plan.sorting != Sorting::split) return Pass(world, content, plan, memory).run(stats, sink);
    const auto& ordered = split.far_to_near();
    for (std::size_t i = 0; i < ordered.size(); ++i) {
      sink.add(ordered[i].primitive, static_cast<std::uint32_t>(ordered.size() - 1 - i));
    }
  }

  World world;
  std::function<void(World&, double)> animate;
  std::optional<Camera> camera;
  Content content;
  std::function<bool(double)> keep_going;

  // Memory that frames use one after the other.
  PassMemory memory;
  ListBuilder list;
  SplitOrder split;

  // The frame being drawn.
  Plan plan;
  std::vector<BucketRange> ranges;
  std::size_t next_range = 0;
};

FrameBuilder::FrameBuilder(const Scene& scene, const Knobs& knobs)
    : state_(std::make_unique<State>(scene, knobs)) {}
FrameBuilder::~FrameBuilder() = default;
FrameBuilder::FrameBuilder(FrameBuilder&&) noexcept = default;
FrameBuilder& FrameBuilder::operator=(FrameBuilder&&) noexcept = default;

const std::vector<std::string>& FrameBuilder::report() const { return state_->content.report; }
double FrameBuilder::units_per_world() const { return state_->content.units; }
const World& FrameBuilder::world() const { return state_->world; }
const Plan& FrameBuilder::plan() const { return state_->plan; }
Plan FrameBuilder::plan_of(const Knobs& knobs) const {
  return state_->plan_of(knobs, Annotate::when_needed, Pieces::limited);
}
void FrameBuilder::set_keep_going(std::function<bool(double)> keep_going) {
  state_->keep_going = std::move(keep_going);
}
void FrameBuilder::set_camera(const Camera* camera) {
  state_->camera = camera != nullptr ? std::optional(*camera) : std::nullopt;
}

bool FrameBuilder::needs_upload(const Knobs& knobs) const {
  return knobs.width != state_->content.width || knobs.height != state_->content.height ||
         knobs.subdivide.pieces() != state_->content.pieces;
}

void FrameBuilder::prepare(const Knobs& knobs) {
  if (needs_upload(knobs)) state_->prepare(knobs);
}

std::vector<std::uint32_t> FrameBuilder::upload_gp0() const { return scene::upload_gp0(state_->content); }
std::vector<std::uint32_t> FrameBuilder::display_gp1() const { return scene::display_gp1(state_->content); }

void FrameBuilder::upload(gpu::Gpu& gpu) {
  gpu.gp0(upload_gp0());
  for (const auto word : display_gp1()) gpu.gp1(word);
}

base::Result<Frame> FrameBuilder::build(double seconds, const Knobs& knobs, ot::MainRam& ram,
                                        Annotate annotate, Pieces pieces) {
  State& s = *state_;
  if (needs_upload(knobs))
    return base::fail("the size or subdivide knob changed: prepare and upload first", base::Exit::failed);
  s.ranges.clear();
  s.next_range = 0;
  Frame frame;
  const double start = base::now_ms();
  s.move(seconds);
  frame.stats.gte_ms = base::now_ms() - start;
  frame.number = round_saturated<std::uint32_t>(seconds * 60);
  s.plan = s.plan_of(knobs, annotate, pieces);
  Plan& plan = s.plan;
  frame.buffer_y = plan.buffer_y(frame.number);
  const auto words = environment(plan, s.world.background, frame.buffer_y);
  FrameStats collected;
  if (plan.sorting == Sorting::split) {
    s.split.begin();
    Pass(s.world, s.content, plan, s.memory).run(collected, s.split);
    const double before_split = base::now_ms();
    if (auto split =
            s.split.finish(plan.width, plan.height, plan.fraction_mask, plan.split_scale, s.keep_going);
        !split)
      return tl::make_unexpected(split.error());
    collected.was_stopped = s.split.was_stopped();
    collected.ot_ms += base::now_ms() - before_split;
    collected.splits = s.split.splits();
    if (pieces == Pieces::snapped) collected.snapped = s.split.snap_pieces();
    plan.rule.length = std::max(1U, static_cast<std::uint32_t>(s.split.far_to_near().size()));
  }
  collected.gte_ms += frame.stats.gte_ms;
  frame.stats = collected;
  const double before_clear = base::now_ms();
  s.list.begin(ram, plan, {0, plan.rule.length - 1}, words);
  frame.stats.ot_ms += base::now_ms() - before_clear;
  s.feed(frame.stats, s.list);
  if (s.list.is_full()) {
    BucketSizes sizes(plan.rule, plan.style);
    collected.gte_ms = frame.stats.gte_ms;
    collected.ot_ms = frame.stats.ot_ms;
    frame.stats = collected;
    s.feed(frame.stats, sizes);
    auto ranges = sizes.ranges(ListBuilder::room(ram, s.list.table_length()));
    if (!ranges) return tl::make_unexpected(ranges.error());
    s.ranges = std::move(*ranges);
    FrameStats again;
    s.list.begin(ram, plan, s.ranges[0], words);
    s.feed(again, s.list);
    s.next_range = 1;
    frame.nearer_lists = static_cast<std::uint32_t>(s.ranges.size() - 1);
  }
  const double before_end = base::now_ms();
  s.list.end();
  frame.stats.ot_ms += base::now_ms() - before_end;
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
  // The environment stays as it is, but the picture must not be filled again.
  auto words = environment(s.plan, s.world.background, frame.buffer_y);
  words.resize(words.size() - 3);
  FrameStats again;
  s.list.begin(ram, s.plan, s.ranges[s.next_range++], words);
  s.feed(again, s.list);
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
  const bool is_split = state_->plan.sorting == Sorting::split;
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
  Plan plan = s.plan_of(knobs, Annotate::always, Pieces::limited);
  plan.wanted.depth = plan.wanted.fractions = true;
  FrameStats stats;
  const auto collect = [&](const Primitive& p) {
    if (p.count == 2) return;
    ScreenPolygon polygon;
    polygon.packet = polygon_of(p);
    polygon.depth = depth_of(p, plan.style.fraction_mask, true);
    polygon.otz = p.otz;
    polygon.bucket = plan.rule.of(p);
    polygon.instance = p.instance;
    polygon.face = p.face;
    if (p.material->texture != nullptr) {
      polygon.window = p.material->texture->window;
    } else {
      polygon.packet.texpage = p.material->texpage;
    }
    out.push_back(polygon);
  };
  Pass(s.world, s.content, plan, s.memory).run(stats, collect);
}

std::uint32_t FrameBuilder::show_gp1(const Frame& frame) {
  return ot::gp1::display_start::make(0, frame.buffer_y);
}

}  // namespace scene
