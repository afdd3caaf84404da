#include "load/x3d/x3d.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "load/faces.h"
#include "load/pictures.h"
#include "load/text.h"
#include "load/x3d/animation.h"

namespace load::x3d {
namespace {

using pugi::xml_node;

constexpr float most_self_light = 7;  // BK is 1.3.12

glm::vec3 saturated(const glm::vec3& rgb) { return glm::clamp(rgb, 0.0F, 1.0F); }

class Reader {
 public:
  Reader(Context& context, const Source& source, LoadedScene& out)
      : context_(context), out_(out), pictures_(source, out) {
    world().materials.clear();
  }

  void read(const xml_node& root, const xml_node& scene) {
    context_.collect_names(root);
    walk_children(scene, 0);
    if (context_.error()) return;
    is_lit_ = layout_.has_headlight || !layout_.lights.empty();
    layout_.is_mirrored = !shapes_.empty() && std::all_of(shapes_.begin(), shapes_.end(),
                                                          [&](const Shape& s) { return is_flat(s.node); });
    for (const Shape& shape : shapes_) place_shape(shape);
    targets_.view = view_;
    animation_ = read_animation(context_, root, targets_);
    if (context_.error()) return;
    finish(scene);
  }

 private:
  struct Shape {
    xml_node node;
    std::uint32_t place;
  };
  struct MaterialFields {
    float transparency = 0;
    glm::vec3 diffuse{0.8F}, emissive{0.0F};
  };
  World& world() { return out_.scene.world; }

  // ---- the tree

  void walk_children(const xml_node& node, std::uint32_t place) {
    if (uses_open_ > 0) {
      for (const xml_node& child : drawn_children(node)) {
        if (context_.error()) return;
        walk(child, place);
      }
      return;
    }
    for (const xml_node& child : node.children()) {
      if (!context_.look(node)) return;
      if (is_element(child)) walk(child, place);
    }
  }
  // Of a node that is used, and so perhaps often: what is silent is left out once and for all.
  const std::vector<xml_node>& drawn_children(const xml_node& node) {
    const auto [known, is_new] = children_.try_emplace(node);
    if (is_new) {
      for (const xml_node& child : node.children()) {
        if (!context_.look(node)) break;
        if (is_element(child) && !is_silent(child)) known->second.push_back(child);
      }
    }
    return known->second;
  }

  void walk(const xml_node& given, std::uint32_t place) {
    const xml_node node = context_.resolve(given);
    if (!node || is_silent(node)) return;
    if (!context_.spend(given, context_.visits_left, 1, "1,000,000 elements after USE")) return;
    if (std::find(open_.begin(), open_.end(), node) != open_.end()) {
      return context_.fail(
          given, "USE=" + in_quotes(given.attribute("USE").value()) + " stands inside the node it names");
    }
    if (open_.size() >= limits::depth) return context_.fail(node, "nested deeper than the limit of 128");
    open_.push_back(node);
    uses_open_ += node != given ? 1 : 0;
    visit(node, place);
    uses_open_ -= node != given ? 1 : 0;
    open_.pop_back();
  }

  void visit(const xml_node& node, std::uint32_t place) {
    const std::string_view name = node.name();
    if (name == "Transform") {
      walk_children(node, transformed(node, place));
    } else if (name == "Group" || name == "StaticGroup" || name == "Anchor" || name == "Collision") {
      walk_children(node, place);
    } else if (name == "Switch") {
      choose(node, place);
    } else if (name == "Shape") {
      shapes_.push_back({node, place});
    } else if (name == "Viewpoint") {
      viewpoint(node, place);
    } else if (name == "NavigationInfo") {
      if (!has_navigation_) layout_.has_headlight = context_.flag(node, "headlight", true);
      has_navigation_ = true;
    } else if (name == "DirectionalLight") {
      light(node, place);
    } else if (name == "Background") {
      background(node);
    } else if (name != "ROUTE" && name != "TimeSensor" && !name.ends_with("Interpolator")) {
      context_.unsupported(node);
    }
  }

  // Some child of the Shape is a 2D node.
  bool is_flat(const xml_node& shape) {
    const auto [known, is_new] = flat_.try_emplace(shape, false);
    if (is_new) {
      known->second = std::any_of(shape.begin(), shape.end(), [&](const xml_node& n) {
        return context_.look(shape) && is_2d_node(n.name());
      });
    }
    return known->second;
  }

  std::uint32_t transformed(const xml_node& node, std::uint32_t place) {
    const auto [entry, is_new] =
        targets_.transforms.try_emplace(node, static_cast<std::uint32_t>(fields_.transforms.size()));
    if (is_new) {
      fields_.transforms.push_back({.centre = context_.vector(node, "center", glm::vec3(0)),
                                    .scale = context_.vector(node, "scale", glm::vec3(1)),
                                    .translation = context_.vector(node, "translation", glm::vec3(0)),
                                    .rotation = read_rotation(context_, node, "rotation"),
                                    .scale_orientation = read_rotation(context_, node, "scaleOrientation")});
    }
    layout_.places.push_back({place, entry->second});
    return static_cast<std::uint32_t>(layout_.places.size() - 1);
  }

  void choose(const xml_node& node, std::uint32_t place) {
    const auto [chosen, is_new] = chosen_.try_emplace(node);
    if (is_new) chosen->second = choice(node);
    if (chosen->second) walk(chosen->second, place);
  }
  xml_node choice(const xml_node& node) {
    const std::vector<std::int32_t> which = context_.wholes(node, "whichChoice");
    std::int32_t left = which.empty() ? -1 : which[0];
    for (const xml_node& child : node.children()) {
      if (!context_.look(node)) break;
      if (is_element(child) && !is_silent(child) && left-- == 0) return child;
    }
    return {};
  }

  void viewpoint(const xml_node& node, std::uint32_t place) {
    if (layout_.view != none) return;  // the first one is bound
    layout_.view = place;
    view_ = node;
    fields_.view.position = context_.vector(node, "position", {0, 0, 10});
    fields_.view.orientation = read_rotation(context_, node, "orientation");
    fields_.view.field_of_view = context_.scalar(node, "fieldOfView", fields_.view.field_of_view);
    if (!(fields_.view.field_of_view > 0 && fields_.view.field_of_view < 3.1416F)) {
      context_.fail(node, "fieldOfView is not between 0 and pi");
    }
  }

  void light(const xml_node& node, std::uint32_t place) {
    // A light that is used again shines again, as its first one says.
    if (const auto known = targets_.lights.find(node); known != targets_.lights.end()) {
      fields_.lights.push_back(fields_.lights[known->second]);
      layout_.lights.push_back(place);
      world().ambient = saturated(world().ambient + ambient_of_[node]);
      return;
    }
    if (dark_.contains(node)) return;
    if (!context_.flag(node, "on", true)) {
      dark_.insert(node);
      return;
    }
    targets_.lights.emplace(node, static_cast<std::uint32_t>(fields_.lights.size()));
    const glm::vec3 colour = context_.vector(node, "color", glm::vec3(1));
    const float intensity = context_.scalar(node, "intensity", 1);
    fields_.lights.push_back({context_.vector(node, "direction", {0, 0, -1}), colour, intensity});
    layout_.lights.push_back(place);
    // Material's ambientIntensity is 0.2 of its colour unless it says otherwise; the console has one for all.
    ambient_of_[node] = 0.2F * context_.scalar(node, "ambientIntensity", 0) * colour;
    world().ambient = saturated(world().ambient + ambient_of_[node]);
  }

  void background(const xml_node& node) {
    if (has_background_) return;
    has_background_ = true;
    const std::vector<glm::vec3> sky = context_.triples(node, "skyColor");
    if (!sky.empty()) world().background = Look{}.stored(sky[0]);
    if (sky.size() > 1 || context_.attribute(node, "groundColor") || context_.attribute(node, "backUrl")) {
      context_.warn(node, "Background: only the first sky colour is drawn");
    }
  }

  // ---- shapes

  xml_node texture_node(const xml_node& appearance) {
    for (const xml_node& child : appearance.children()) {
      if (!context_.look(appearance)) break;
      const std::string_view name = child.name();
      if (!is_element(child) || is_silent(child) || name == "Material" || name == "UnlitMaterial" ||
          name == "ImageTexture" || name == "TextureTransform") {
        continue;
      }
      context_.unsupported(child);
    }
    return context_.child(appearance, "ImageTexture");
  }

  void wear_picture(const xml_node& node, Look& look) {
    if (!node) return;
    const bool repeats = context_.flag(node, "repeatS", true) || context_.flag(node, "repeatT", true);
    const std::vector<std::string> urls = context_.strings(node, "url");
    if (urls.empty()) context_.warn(node, "ImageTexture has no url");
    for (const std::string& url : urls) {
      if (url.find("://") != url.npos) {
        context_.warn(node, "texture " + in_quotes(url) + " is left out: nothing is fetched from the net");
        continue;
      }
      look.material.texture = pictures_.load(url, repeats);
      if (look.material.texture != none) break;
    }
    if (look.material.texture == none) return;
    if (look.material.blend != Blend::opaque)
      look.material.texture = pictures_.see_through(look.material.texture);
    if (pictures_.is_partly_transparent(look.material.texture)) look.material.blend = Blend::average;
  }

  void move_picture(const xml_node& node, Look& look) {
    if (!node) return;
    const auto pair = [&](const char* field, const glm::vec2& otherwise) {
      const std::vector<glm::vec2> values = context_.pairs(node, field);
      return values.empty() ? otherwise : values[0];
    };
    look.uv_scale = pair("scale", glm::vec2(1));
    look.uv_centre = pair("center", glm::vec2(0));
    look.uv_offset = pair("translation", glm::vec2(0));
    look.uv_turns = turns(double{context_.scalar(node, "rotation", 0)});
  }

  // Without a material a surface is its own white, or the colours and texture it has. [ISO/IEC
  // 19775-1, 17.2.2]
  Look read_look(const xml_node& shape, bool has_colours) {
    Look look;
    const xml_node appearance = context_.child(shape, "Appearance");
    if (!appearance) return look;
    const auto [known, is_new] = appearances_.try_emplace({appearance, has_colours});
    if (is_new) known->second = read_appearance(appearance, has_colours);
    return known->second;
  }

  Look read_appearance(const xml_node& appearance, bool has_colours) {
    Look look;
    const xml_node material = context_.child(appearance, "Material");
    const xml_node unlit = context_.child(appearance, "UnlitMaterial");
    const xml_node any = material ? material : unlit;
    const float transparency = any ? material_fields(any).transparency : 0;
    look.is_invisible = transparency >= 1;
    look.material.blend = transparency > 0 ? Blend::average : Blend::opaque;
    wear_picture(texture_node(appearance), look);
    move_picture(context_.child(appearance, "TextureTransform"), look);
    if (unlit) look.colour = look.line_colour = material_fields(unlit).emissive;
    if (material) light_up(material, has_colours, look);
    return look;
  }

  // Read once, however many appearances use the material.
  const MaterialFields& material_fields(const xml_node& node) {
    const auto [known, is_new] = material_fields_.try_emplace(node);
    if (is_new) {
      const bool is_unlit = std::string_view(node.name()) == "UnlitMaterial";
      known->second = {context_.scalar(node, "transparency", 0),
                       is_unlit ? glm::vec3(1) : context_.vector(node, "diffuseColor", glm::vec3(0.8F)),
                       context_.vector(node, "emissiveColor", glm::vec3(is_unlit ? 1.0F : 0.0F))};
    }
    return known->second;
  }

  void light_up(const xml_node& material, bool has_colours, Look& look) {
    const glm::vec3 diffuse = saturated(material_fields(material).diffuse);
    const glm::vec3 emissive = saturated(material_fields(material).emissive);
    const bool is_replaced =
        has_colours || look.material.texture != none;  // these stand for the diffuse colour
    look.line_colour = emissive == glm::vec3(0) ? diffuse : emissive;
    if (!is_lit_) {
      look.colour = is_replaced && emissive == glm::vec3(0) ? glm::vec3(1) : emissive;
      return;
    }
    look.colour = is_replaced ? glm::vec3(1) : diffuse;
    if (look.colour == glm::vec3(0)) {
      look.colour = emissive;
      return;
    }
    look.material.lit = true;
    // colour * (light + self_light): what a channel gives off itself, through the colour that it has to have.
    look.colour = glm::max(look.colour, emissive / most_self_light);
    for (int i = 0; i < 3; ++i) {
      if (look.colour[i] > 0) look.material.self_light[i] = emissive[i] / look.colour[i];
    }
  }

  void place_shape(const Shape& shape) {
    if (context_.error()) return;
    const auto [known, is_new] = meshes_.try_emplace(shape.node, none);
    if (is_new) known->second = read_shape(shape.node);
    if (known->second == none || context_.error()) return;
    const Mesh& mesh = world().meshes[known->second];
    // Drawn again, it costs again.
    if (!is_new && (!context_.spend(shape.node, context_.faces_left, mesh.faces.size() + mesh.lines.size(),
                                    "1,000,000 faces, each USE counted") ||
                    !context_.spend(shape.node, context_.vertices_left, mesh.positions.size(),
                                    "4,000,000 vertices, each USE counted"))) {
      return;
    }
    if (!context_.spend(shape.node, context_.instances_left, 1, "65,536 shapes")) return;
    world().instances.push_back({known->second, glm::mat4(1)});
    layout_.instances.push_back(shape.place);
  }

  // The mesh of a Shape; none if there is nothing to draw.
  std::uint32_t read_shape(const xml_node& shape) {
    xml_node geometry;
    for (const xml_node& child : shape.children()) {
      if (!context_.look(shape)) return none;
      if (!is_element(child) || is_silent(child) || std::string_view(child.name()) == "Appearance") continue;
      geometry = context_.resolve(child);
      break;
    }
    if (!geometry) return none;
    const bool has_colours =
        context_.direct_child(geometry, "Color") || context_.direct_child(geometry, "ColorRGBA");
    const Look look = read_look(shape, has_colours);
    if (look.is_invisible || context_.error()) return none;
    auto read = read_geometry(context_, geometry, look);
    if (!read || (read->mesh.faces.empty() && read->mesh.lines.empty())) return none;
    dress(*read, look);
    world().meshes.push_back(std::move(read->mesh));
    return static_cast<std::uint32_t>(world().meshes.size() - 1);
  }

  void dress(Geometry& geometry, const Look& look) {
    Material material = look.material;
    if (geometry.is_2d) {
      material.lit = false;
      material.self_light = glm::vec3(0);
    }
    std::vector<bool> front_only(geometry.mesh.faces.size(), geometry.sides == Geometry::Sides::front);
    if (geometry.sides == Geometry::Sides::front_if_closed)
      front_only = faces_of_closed_surfaces(geometry.mesh);
    for (std::size_t i = 0; i < front_only.size(); ++i) {
      material.double_sided = !front_only[i];
      geometry.mesh.faces[i].material = index_of(material);
    }
    material.texture = none;
    material.lit = false;
    material.self_light = glm::vec3(0);
    material.double_sided = false;
    for (Line& line : geometry.mesh.lines) line.material = index_of(material);
  }

  std::uint32_t index_of(const Material& m) {
    const auto key = std::make_tuple(m.texture, m.blend, m.lit, m.double_sided, m.self_light.x,
                                     m.self_light.y, m.self_light.z);
    const auto [entry, is_new] =
        materials_.try_emplace(key, static_cast<std::uint32_t>(world().materials.size()));
    if (is_new) world().materials.push_back(m);
    return entry->second;
  }

  // ---- the scene

  void finish(const xml_node& scene) {
    World& w = world();
    if (w.materials.empty()) w.materials.emplace_back();
    if (w.instances.empty()) context_.warn(scene, "there is nothing to draw in it");
    if (layout_.lights.size() + (layout_.has_headlight ? 1 : 0) > 3) {
      context_.warn(scene, "of more than three lights the first three shine");
    }
    w.camera.position = {0, 0, 10};
    arrange(layout_, fields_, w);
    if (layout_.view == none) frame_all();
    out_.scene.shows = "An X3D scene";
    if (animation_.bindings.empty()) return;
    out_.scene.animate = [layout = layout_, fields = fields_, animation = animation_](World& moved,
                                                                                      double seconds) {
      Fields now = fields;
      animation.set(now, seconds);
      arrange(layout, now, moved);
    };
    out_.scene.animate(w, 0);
  }

  // No Viewpoint: the specified one if it sees everything, else one that does. Of a
  // picture the middle is sought.
  void frame_all() {
    World& w = world();
    if (layout_.is_mirrored) {
      w.camera.position.y = 0;
      arrange(layout_, fields_, w);
    }
    const Bounds bounds = bounds_of(w);
    if (bounds.empty) return;
    const glm::vec3 centre = bounds.centre();
    const float side = glm::length(glm::vec2(centre)) + bounds.radius(),
                depth = 10 - centre.z - bounds.radius();
    if (depth > w.camera.near_z && side <= depth * w.camera.tan_half_fov) return;
    const Camera seen = framing(bounds);
    if (layout_.is_mirrored) {
      // The mirror hangs at the camera's height: raise the camera, and the picture sinks twice as far.
      w.camera = seen;
      w.camera.position.y = -seen.position.y;
      arrange(layout_, fields_, w);
    } else {
      w.camera = seen;
    }
  }

  Context& context_;
  LoadedScene& out_;
  Pictures pictures_;
  Layout layout_;
  Fields fields_;
  Targets targets_;
  Animation animation_;
  xml_node view_;
  std::vector<xml_node> open_;  // the nodes we are inside of
  std::vector<Shape> shapes_;
  std::map<xml_node, std::uint32_t> meshes_;
  std::map<xml_node, std::vector<xml_node>> children_;  // of nodes that are used
  std::size_t uses_open_ = 0;                           // USEs that we are inside of
  std::map<xml_node, MaterialFields> material_fields_;
  std::map<xml_node, xml_node> chosen_;  // of each Switch
  std::map<xml_node, bool> flat_;        // Shapes with a 2D node
  std::map<xml_node, glm::vec3> ambient_of_;
  std::set<xml_node> dark_;                                // lights that are off
  std::map<std::pair<xml_node, bool>, Look> appearances_;  // by node, and whether the geometry has colours
  std::map<std::tuple<std::uint32_t, Blend, bool, bool, float, float, float>, std::uint32_t> materials_;
  bool is_lit_ = false, has_navigation_ = false, has_background_ = false;
};

std::size_t line_at(std::string_view bytes, std::ptrdiff_t offset) {
  const std::string_view before =
      bytes.substr(0, std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), bytes.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

}  // namespace
}  // namespace load::x3d

namespace load {

base::Result<LoadedScene> parse_x3d(std::string_view bytes, const Source& source) {
  if (bytes.size() > limits::x3d_bytes) return base::fail(source.name + ": more than the limit of 64 MiB");
  // Every element begins with '<'; the tree is not built before it is known to be of bearable size.
  if (static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '<')) > 2 * limits::elements) {
    return base::fail(source.name + ": more than the limit of 1,000,000 XML elements");
  }
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
  if (!parsed) {
    return base::fail(source.name + ":" + std::to_string(x3d::line_at(bytes, parsed.offset)) +
                      ": not well-formed XML: " + parsed.description());
  }
  const pugi::xml_node root = document.child("X3D");
  if (!root) return base::fail(source.name + ": no <X3D> element; is it an X3D scene in the XML encoding?");
  const pugi::xml_node scene = root.child("Scene");
  if (!scene) return base::fail(source.name + ": no <Scene> in its <X3D>");

  LoadedScene loaded;
  x3d::Context context(bytes, source, loaded.warnings);
  x3d::Reader reader(context, source, loaded);
  reader.read(root, scene);
  if (context.error()) return tl::make_unexpected(*context.error());
  return loaded;
}

}  // namespace load
