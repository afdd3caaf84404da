#include "load/obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "base/read_file.h"
#include "load/distinct.h"
#include "load/faces.h"
#include "load/pictures.h"
#include "load/text.h"
#include "scene/angle.h"

namespace load {
namespace {

constexpr std::string_view blank = " \t\r\v\f\\\n";  // a back slash before the line's end continues it
constexpr double seconds_per_turn = 16;
constexpr double first_turn = 0.1;         // a flat model is not seen edge on
constexpr double camera_elevation = 0.05;  // turns

struct Corner {
  std::uint32_t position = none, uv = none, normal = none;
};

class Reader {
 public:
  Reader(std::string_view bytes, const Source& source, LoadedScene& out)
      : rest_(bytes), source_(source), out_(out), pictures_(source, out) {
    world().materials.clear();
    materials_of_names_[""] = use({.material = {.lit = true}});
  }

  base::Result<void> read() {
    while (!rest_.empty()) {
      std::string_view line = next_line();
      const std::string_view word = next_token(line, blank);
      if (auto done = statement(word, line); !done) {
        return base::fail(source_.name + ":" + std::to_string(line_) + ": " + done.error().text);
      }
      line_ += lines_joined_;
    }
    if (corners_.empty()) add_point_cloud();
    if (mesh_.faces.empty() && mesh_.lines.empty()) {
      return base::fail(source_.name + ": not one face, line or point in it; is it a Wavefront OBJ file?");
    }
    return {};
  }

  // The turning scene, once all is read.
  void finish() {
    share_corners();
    cull_closed_surfaces();
    World& w = world();
    w.camera = framing_turned(mesh_, camera_elevation);
    Bounds bounds;
    for (const glm::vec3& p : mesh_.positions) bounds.include(p);
    w.meshes.push_back(std::move(mesh_));
    w.instances.push_back({0, glm::mat4(1)});
    const float third = 1 / std::sqrt(3.0F);
    w.lights = {{.direction = {third, -third, -third}, .colour = glm::vec3(0.7F), .at_camera = true}};
    w.ambient = glm::vec3(0.5F);
    w.background = {32, 40, 56};  // neither a black nor a white model is lost on it
    out_.scene.shows = "A Wavefront OBJ model, turning";
    out_.scene.animate = [centre = bounds.centre()](World& moved, double seconds) {
      moved.instances[0].model =
          translation(centre) * rotation_y(first_turn + seconds / seconds_per_turn) * translation(-centre);
    };
    out_.scene.animate(w, 0);
  }

 private:
  World& world() { return out_.scene.world; }

  std::string_view next_line() {
    std::size_t end = 0;
    lines_joined_ = 1;
    for (;; ++end, ++lines_joined_) {
      end = rest_.find('\n', end);
      if (end == rest_.npos) break;
      const std::size_t before = end > 0 && rest_[end - 1] == '\r' ? end - 1 : end;
      if (before == 0 || rest_[before - 1] != '\\') break;
    }
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + 1);
    return line;
  }

  base::Result<void> statement(std::string_view word, std::string_view line) {
    if (word.empty() || word[0] == '#') return {};
    if (word == "v") return position(line);
    if (word == "vt") return uv(line);
    if (word == "vn") return normal(line);
    if (word == "f" || word == "fo") return face(line);
    if (word == "l") return segments(line);
    if (word == "p") return points(line);
    if (word == "usemtl") return use_material(rest_of(line));
    if (word == "mtllib") return library(line);
    if (word.find('\0') != word.npos) return base::fail("a zero byte, expected text");
    static constexpr std::array<std::string_view, 11> surfaces{
        "curv", "curv2", "surf", "cstype", "deg", "bmat", "parm", "vp", "trim", "hole", "con"};
    if (std::find(surfaces.begin(), surfaces.end(), word) != surfaces.end() && !warned_of_surfaces_) {
      warned_of_surfaces_ = true;
      warn("curves and surfaces (" + std::string(word) + ") are left out");
    }
    return {};  // groups, names, smoothing, display attributes: nothing to draw
  }

  // Up to N numbers; `required` of them must be there.
  template <std::size_t N>
  base::Result<std::size_t> numbers(std::string_view line, std::array<float, N>& values,
                                    std::size_t required) {
    std::size_t count = 0;
    while (count < N) {
      const std::string_view token = next_token(line, blank);
      if (token.empty()) break;
      auto value = number(token);
      if (!value) return tl::make_unexpected(value.error());
      values[count++] = *value;
    }
    if (count < required) {
      return base::fail(std::to_string(count) + " numbers, expected " + std::to_string(required));
    }
    return count;
  }

  template <class T>
  static base::Result<void> room(const std::vector<T>& list) {
    if (list.size() >= limits::vertices) return base::fail("more than the limit of 4,000,000 v, vt or vn");
    return {};
  }

  base::Result<void> position(std::string_view line) {
    if (auto fits = room(positions_); !fits) return fits;
    std::array<float, 7> n{};
    auto count = numbers(line, n, 3);
    if (!count) return tl::make_unexpected(count.error());
    positions_.emplace_back(n[0], n[1], n[2]);
    if (*count >= 6) {
      colours_.resize(positions_.size() - 1, glm::vec3(1));
      colours_.emplace_back(n[3], n[4], n[5]);
    }
    return {};
  }

  base::Result<void> uv(std::string_view line) {
    if (auto fits = room(uvs_); !fits) return fits;
    std::array<float, 2> n{};
    if (auto count = numbers(line, n, 1); !count) return tl::make_unexpected(count.error());
    uvs_.emplace_back(n[0], n[1]);
    return {};
  }

  base::Result<void> normal(std::string_view line) {
    if (auto fits = room(normals_); !fits) return fits;
    std::array<float, 3> n{};
    if (auto count = numbers(line, n, 3); !count) return tl::make_unexpected(count.error());
    const glm::vec3 given(n[0], n[1], n[2]);
    const float length = glm::length(given);
    normals_.push_back(length > 0 ? given / length : glm::vec3(0));
    return {};
  }

  // One index as the file counts (from 1, or from the end below 0) as an index into a list of `size`.
  static base::Result<std::uint32_t> index(std::string_view token, std::size_t size, const char* of_what) {
    const auto value = whole(token);
    if (!value) return base::fail(in_quotes(token) + " is no index");
    const std::int64_t at = *value < 0 ? static_cast<std::int64_t>(size) + *value : std::int64_t{*value} - 1;
    if (*value == 0 || at < 0 || at >= static_cast<std::int64_t>(size)) {
      return base::fail("index " + std::to_string(*value) + ", but there are " + std::to_string(size) + " " +
                        of_what + " so far");
    }
    return static_cast<std::uint32_t>(at);
  }

  base::Result<Corner> corner(std::string_view token) {
    Corner c;
    const std::size_t first = token.find('/');
    auto position = index(token.substr(0, first), positions_.size(), "v");
    if (!position) return tl::make_unexpected(position.error());
    c.position = *position;
    if (first == token.npos) return c;
    const std::string_view after = token.substr(first + 1);
    const std::size_t second = after.find('/');
    if (const auto text = after.substr(0, second); !text.empty()) {
      auto at = index(text, uvs_.size(), "vt");
      if (!at) return tl::make_unexpected(at.error());
      c.uv = *at;
    }
    if (second != after.npos && second + 1 < after.size()) {
      auto at = index(after.substr(second + 1), normals_.size(), "vn");
      if (!at) return tl::make_unexpected(at.error());
      c.normal = *at;
    }
    return c;
  }

  base::Result<void> corners(std::string_view line) {
    polygon_.clear();
    for (std::string_view token; !(token = next_token(line, blank)).empty();) {
      if (token[0] == '#') break;
      auto c = corner(token);
      if (!c) return tl::make_unexpected(c.error());
      polygon_.push_back(*c);
    }
    if (mesh_.faces.size() + mesh_.lines.size() + polygon_.size() > limits::faces) {
      return base::fail("more than the limit of 1,000,000 faces");
    }
    return {};
  }

  base::Result<void> face(std::string_view line) {
    if (auto got = corners(line); !got) return got;
    if (now_->is_invisible) return {};
    points_.clear();
    for (const Corner& c : polygon_) points_.push_back(positions_[c.position]);
    pieces_.clear();
    split_polygon(points_, work_, pieces_);
    for (const Piece& piece : pieces_) {
      Face f{.material = now_index_};
      for (std::size_t i = 0; i < 4 && piece[i] != none; ++i) {
        const Corner& c = polygon_[piece[i]];
        f.vertex[i] = static_cast<std::uint32_t>(corners_.size());
        corners_.push_back(c);
        if (c.uv != none) f.uv[i] = picture_position(uvs_[c.uv]);
        f.colour[i] = colour(c);
      }
      mesh_.faces.push_back(f);
    }
    return {};
  }

  base::Result<void> segments(std::string_view line) {
    if (auto got = corners(line); !got) return got;
    for (std::size_t i = 1; i < polygon_.size(); ++i) add_line(polygon_[i - 1], polygon_[i]);
    return {};
  }

  base::Result<void> points(std::string_view line) {
    if (auto got = corners(line); !got) return got;
    for (const Corner& c : polygon_) add_line(c, c);
    return {};
  }

  // Vertices that nothing joins are a cloud of points.
  void add_point_cloud() {
    const std::size_t count = std::min(positions_.size(), limits::faces);
    for (std::uint32_t i = 0; i < count; ++i) add_line({i, none, none}, {i, none, none});
  }

  void add_line(const Corner& a, const Corner& b) {
    const auto first = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back({a.position, none, none});
    corners_.push_back({b.position, none, none});
    mesh_.lines.push_back({{first, first + 1}, {colour(a), colour(b)}, unlit()});
  }

  // The picture's origin is its bottom left here, its top left in a Face.
  [[nodiscard]] glm::vec2 picture_position(const glm::vec2& uv) const {
    const glm::vec2 moved = uv * now_->uv_scale + now_->uv_offset;
    return {moved.x, 1 - moved.y};
  }

  [[nodiscard]] Rgb8 colour(const Corner& c) const {
    glm::vec3 rgb = now_->diffuse;
    if (c.position < colours_.size()) rgb = colours_[c.position];
    const float full = now_->material.texture == none ? 255 : 128;
    return {to_byte(rgb.r, full), to_byte(rgb.g, full), to_byte(rgb.b, full)};
  }

  static std::string_view rest_of(std::string_view line) {
    const std::size_t begin = std::min(line.find_first_not_of(blank), line.size());
    line.remove_prefix(begin);
    return line.substr(0, line.find_last_not_of(blank) + 1);
  }

  base::Result<void> use_material(std::string_view name) {
    if (const auto known = materials_of_names_.find(name); known != materials_of_names_.end()) {
      now_ = &used_[known->second];
      now_index_ = known->second;
      return {};
    }
    const auto found = library_.find(name);
    if (found == library_.end() && !any_missing_library_)
      warn("material " + in_quotes(name) + " is not defined; drawn grey");
    if (used_.size() >= limits::materials) return base::fail("more than the limit of 4,096 materials");
    materials_of_names_[std::string(name)] =
        use(found == library_.end() ? ObjMaterial{.material = {.lit = true}} : found->second);
    return {};
  }

  std::uint32_t use(const ObjMaterial& material) {
    used_.push_back(material);
    now_ = &used_.back();
    now_index_ = static_cast<std::uint32_t>(used_.size() - 1);
    world().materials.push_back(material.material);
    return now_index_;
  }

  base::Result<void> library(std::string_view line) {
    const std::string_view name = rest_of(line);
    if (++libraries_named_ > 64) return base::fail("more than the limit of 64 material libraries");
    const auto file = resolve(source_.folder, name);
    if (file && !libraries_.insert(file->string()).second) return {};  // read already, by whatever name
    auto bytes = file ? base::read_regular_file(*file, limits::mtl_bytes) : tl::make_unexpected(file.error());
    if (!bytes) {
      any_missing_library_ = true;
      warn("material library " + in_quotes(name) + " cannot be read (" + bytes.error().text +
           "); its materials are drawn grey");
      return {};
    }
    out_.files.push_back(*file);
    parse_mtl(*bytes, pictures_, library_);
    return {};
  }

  // A material for lines: never lit, never textured. Made when the first line needs it.
  std::uint32_t unlit() {
    if (line_material_ == none) {
      line_material_ = static_cast<std::uint32_t>(used_.size());
      const std::uint32_t back = now_index_;
      use({.material = {.lit = false}});
      now_ = &used_[back];
      now_index_ = back;
    }
    return line_material_;
  }

  // Corners with equal position and normal become one vertex of the mesh. Normals are kept only if every lit
  // corner has one: the mesh has one per position or none.
  void share_corners() {
    const bool has_normals =
        std::all_of(mesh_.faces.begin(), mesh_.faces.end(),
                    [&](const Face& f) {
                      return std::all_of(f.vertex.begin(), f.vertex.end(), [&](std::uint32_t v) {
                        return v == none || corners_[v].normal != none;
                      });
                    }) &&
        !mesh_.faces.empty();
    std::vector<std::uint64_t> keys;
    keys.reserve(corners_.size());
    const auto each_vertex = [&](auto&& visit) {
      for (Face& f : mesh_.faces) {
        for (std::uint32_t& v : f.vertex) {
          if (v != none) visit(v);
        }
      }
      for (Line& l : mesh_.lines) std::for_each(l.vertex.begin(), l.vertex.end(), visit);
    };
    each_vertex([&](std::uint32_t& v) {
      const Corner& c = corners_[v];
      keys.push_back(std::uint64_t{has_normals ? c.normal : none} << 32U | c.position);
    });
    const Distinct vertices = number_distinct(keys);
    for (const std::uint32_t key : vertices.first) {
      const auto position = static_cast<std::uint32_t>(keys[key]),
                 normal = static_cast<std::uint32_t>(keys[key] >> 32);
      mesh_.positions.push_back(positions_[position]);
      if (has_normals) mesh_.normals.push_back(normal == none ? glm::vec3(0, 1, 0) : normals_[normal]);
    }
    std::size_t at = 0;
    each_vertex([&](std::uint32_t& v) { v = vertices.number[at++]; });
    corners_ = {};
  }

  // A file does not say which sides are seen: both, unless the back is inside.
  void cull_closed_surfaces() {
    const std::vector<bool> closed = faces_of_closed_surfaces(mesh_);
    std::vector<Material>& materials = world().materials;
    const std::size_t before = materials.size();
    std::vector<std::uint32_t> two_sided(before, none);
    for (std::size_t i = 0; i < mesh_.faces.size(); ++i) {
      if (closed[i]) continue;
      std::uint32_t& twin = two_sided[mesh_.faces[i].material];
      if (twin == none) {
        twin = static_cast<std::uint32_t>(materials.size());
        materials.push_back(materials[mesh_.faces[i].material]);
        materials.back().double_sided = true;
      }
      mesh_.faces[i].material = twin;
    }
  }

  void warn(const std::string& text) {
    constexpr std::size_t most_warnings = 100;
    if (out_.warnings.size() < most_warnings) {
      out_.warnings.push_back(source_.name + ":" + std::to_string(line_) + ": " + text);
    }
  }

  std::string_view rest_;
  const Source& source_;
  LoadedScene& out_;
  Pictures pictures_;
  std::size_t line_ = 1, lines_joined_ = 1;

  std::vector<glm::vec3> positions_, normals_, colours_;
  std::vector<glm::vec2> uvs_;
  std::vector<Corner> corners_;  // until the end, a mesh's vertices are indices into this
  Mesh mesh_;

  std::map<std::string, ObjMaterial, std::less<>> library_;
  std::map<std::string, std::uint32_t, std::less<>> materials_of_names_;
  std::set<std::string> libraries_;  // the files, links followed
  std::size_t libraries_named_ = 0;
  std::vector<ObjMaterial> used_;  // parallel to World::materials while reading
  const ObjMaterial* now_ = nullptr;
  std::uint32_t now_index_ = 0, line_material_ = none;
  bool any_missing_library_ = false, warned_of_surfaces_ = false;

  std::vector<Corner> polygon_;  // of the line being read
  std::vector<glm::vec3> points_;
  std::vector<Piece> pieces_;
  std::uint64_t work_ = split_work;
};

}  // namespace

base::Result<LoadedScene> parse_obj(std::string_view bytes, const Source& source) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (bytes.starts_with("\xfe\xff") || bytes.starts_with("\xff\xfe")) {
    return base::fail(source.name + ": UTF-16 text, expected UTF-8 or ASCII");
  }
  LoadedScene loaded;
  Reader reader(bytes, source, loaded);
  if (auto read = reader.read(); !read) return tl::make_unexpected(read.error());
  reader.finish();
  return loaded;
}

}  // namespace load
