#include "app/viewer.h"

#include <algorithm>
#include <map>
#include <utility>

#include "app/commands/describe.h"
#include "gpu/canvas/canvas.h"
#include "scene/plan.h"

namespace app {

Viewer::Viewer(scene::Scene scene, const scene::Knobs& knobs)
    : scene_(std::move(scene)), animate_(scene_.animate), base_(scene_.world.camera) {
  // The scene's own animation first, then the user's hand on the camera; with an offset of nothing the frame
  // is exactly the scene's.
  scene_.animate = [this, still = base_](scene::World& world, double seconds) {
    world.camera = still;
    if (animate_) animate_(world, seconds);
    base_ = world.camera;
    world.camera = moved(base_, offset_, pivot_distance_);
  };
  {
    auto first = scene_.world;
    scene_.animate(first, 0);
    first.camera = base_;
    pivot_distance_ = pivot_distance(first);
  }
  builder_ = &machine_.builder(knobs);
}

scene::Scene Viewer::scene_as_given() const {
  auto scene = scene_;
  scene.animate = animate_;
  return scene;
}

base::Result<scene::FrameStats> Viewer::draw(std::int64_t frame, const scene::Knobs& knobs,
                                             const CameraOffset& camera) {
  if (auto checked = scene::check_knobs(knobs); !checked) return tl::make_unexpected(checked.error());
  offset_ = camera;
  builder_ = &machine_.builder(knobs);
  builder_->set_keep_going(keep_going_);
  const bool continues = frame == last_frame_ + 1 && knobs == last_knobs_;
  if (!continues) machine_.presenter().forget();
  const int before = continues ? 0 : machine::Presenter::frames_before(knobs);
  last_frame_ = frame;
  last_knobs_ = knobs;
  base::Result<scene::FrameStats> stats;
  for (std::int64_t f = frame - before; f <= frame; ++f) {
    const auto seconds = static_cast<double>(std::max<std::int64_t>(f, 0)) / 60.0;
    stats = machine_.draw(seconds, knobs);
    if (!stats) return stats;
  }
  last_stats_ = *stats;
  return stats;
}

base::Result<debug::Clip> Viewer::clip(std::int64_t frame, const scene::Knobs& knobs,
                                       const CameraOffset& camera) {
  if (auto checked = scene::check_knobs(knobs); !checked) return tl::make_unexpected(checked.error());
  if (knobs.visibility == scene::Visibility::bsp) {
    return base::fail(
        "visibility bsp: its pieces have limits that no packet holds; expected another to take apart");
  }
  offset_ = camera;
  builder_ = &machine_.builder(knobs);
  if (builder_->needs_upload(knobs)) {
    builder_->prepare(knobs);
    builder_->upload(machine_.gpu());
  }
  const auto seconds = static_cast<double>(std::max<std::int64_t>(frame, 0)) / 60.0;
  const auto built = builder_->build(seconds, knobs, machine_.ram(), scene::Annotate::always);
  if (!built) return tl::make_unexpected(built.error());
  gpu::Gpu before;
  debug::go_on_from(machine_.gpu().save(), before);
  before.gp1(scene::FrameBuilder::show_gp1(*built));
  std::optional<inspect::TableRange> table;
  if (built->buckets != 0) table = {built->table_address, built->buckets};
  auto clip = debug::clip_of_list(machine_.ram(), built->head, table, before.save());
  if (built->nearer_lists != 0) {
    clip.lint.push_back({"lists", "",
                         "the frame does not fit into RAM at once; this is the farthest of its " +
                             std::to_string(built->nearer_lists + 1) + " lists"});
  }
  name_origins(clip, seconds, knobs);
  return clip;
}

// Packets are made one behind the other, so their addresses tell which polygon each is.
void Viewer::name_origins(debug::Clip& clip, double seconds, const scene::Knobs& knobs) {
  std::vector<scene::ScreenPolygon> polygons;
  builder_->polygons(seconds, knobs, polygons);
  std::vector<debug::Item*> items;
  for (auto& item : clip.items) {
    const auto at = item.command_at();
    if (item.is_drawing() && ot::gp0::command_of(item.words[at]) == ot::gp0::Command::polygon)
      items.push_back(&item);
  }
  if (items.size() != polygons.size()) return;
  std::sort(items.begin(), items.end(), [](const auto* a, const auto* b) { return a->address < b->address; });
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> pieces;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto& polygon = polygons[i];
    items[i]->key = polygon.otz;
    items[i]->origin = "i" + std::to_string(polygon.instance) + "/f" + std::to_string(polygon.face);
    const int piece = pieces[{polygon.instance, polygon.face}]++;
    if (piece != 0) items[i]->origin += "/p" + std::to_string(piece);
  }
}

std::unique_ptr<Subject> Viewer::another(const scene::Knobs& knobs) const {
  return std::make_unique<Viewer>(scene_as_given(), knobs);
}

std::unique_ptr<Subject> Viewer::apart(std::int64_t /*frame*/, const scene::Knobs& knobs) {
  return another(knobs);
}

std::string Viewer::why_empty() const { return app::why_empty(last_stats_); }

void Viewer::set_keep_going(std::function<bool(double)> keep_going) { keep_going_ = std::move(keep_going); }

std::vector<const scene::KnobInfo*> Viewer::unwatched_knobs(const scene::Knobs& knobs) {
  const auto& builder = machine_.builder(knobs);
  std::vector<const scene::KnobInfo*> asking;
  for (const auto& knob : scene::knob_table()) {
    scene::Knobs alone;
    knob.set(alone, knob.get(knobs));
    const auto options = builder.plan_of(alone).canvas;
    if (options && !options->can_be_watched()) asking.push_back(&knob);
  }
  return asking;
}

std::vector<std::uint16_t> Viewer::vram() const {
  const auto pixels = gpu().vram().pixels();
  std::vector<std::uint16_t> copy(pixels.begin(), pixels.end());
  const auto* canvas = gpu().canvas();
  if (canvas != nullptr && canvas->options().can_be_watched()) canvas->put_into(copy);
  return copy;
}

void Viewer::fly(CameraOffset& camera, glm::vec3 step) const {
  app::fly(camera, base_, step, pivot_distance_);
}

}  // namespace app
