// Attributes of X3D nodes as numbers, and what to say when they are none.

#include <algorithm>
#include <cstring>

#include "load/faces.h"
#include "load/text.h"
#include "load/x3d/x3d.h"

namespace load::x3d {
namespace {

constexpr std::string_view separators = " \t\r\n,";
constexpr std::size_t most_warnings = 100;

}  // namespace

Context::Context(std::string_view bytes, const Source& source, std::vector<std::string>& warnings)
    : split_work_left(split_work), bytes_(bytes), source_(source), warnings_(warnings) {}

void Context::collect_names(const pugi::xml_node& root) {
  for (pugi::xml_node node = root; node;) {
    if (const char* name = node.attribute("DEF").value(); *name != '\0') names_.emplace(name, node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != root && !node.next_sibling()) node = node.parent();
    node = node == root ? pugi::xml_node() : node.next_sibling();
  }
}

std::size_t Context::line_of(const pugi::xml_node& at) const {
  const auto offset = static_cast<std::size_t>(std::max<std::ptrdiff_t>(at.offset_debug(), 0));
  const std::string_view before = bytes_.substr(0, std::min(offset, bytes_.size()));
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string Context::place(const pugi::xml_node& at) const {
  return source_.name + ":" + std::to_string(line_of(at)) + ": ";
}

void Context::fail(const pugi::xml_node& at, const std::string& text) {
  if (!error_) error_ = base::Error{place(at) + at.name() + ": " + text, base::Exit::bad_input};
}

void Context::warn(const pugi::xml_node& at, const std::string& text) {
  if (warnings_.size() < most_warnings && said_.insert(text).second) warnings_.push_back(place(at) + text);
}

void Context::unsupported(const pugi::xml_node& node) {
  warn(node, std::string("node ") + in_quotes(node.name()) + " is not supported and left out");
}

pugi::xml_node Context::named(const char* name) const {
  const auto found = names_.find(std::string_view(name));
  return found == names_.end() ? pugi::xml_node() : found->second;
}

bool Context::look(const pugi::xml_node& at, std::size_t count) {
  return spend(at, looks_left_, count, "100,000,000 looks at nodes and attributes, each USE counted");
}

pugi::xml_attribute Context::attribute(const pugi::xml_node& node, const char* name) {
  std::size_t looked = 0;
  pugi::xml_attribute found;
  for (const pugi::xml_attribute& a : node.attributes()) {
    ++looked;
    if (std::strcmp(a.name(), name) == 0) {
      found = a;
      break;
    }
  }
  return look(node, looked) ? found : pugi::xml_attribute();
}

pugi::xml_node Context::direct_child(const pugi::xml_node& node, const char* name) {
  for (const pugi::xml_node& child : node.children()) {
    if (!look(node)) break;
    if (std::strcmp(child.name(), name) == 0) return child;
  }
  return {};
}

pugi::xml_node Context::resolve(const pugi::xml_node& node) {
  const pugi::xml_attribute use = attribute(node, "USE");
  if (!use) return node;
  const pugi::xml_node meant = named(use.value());
  if (!meant) {
    warn(node, "USE=" + in_quotes(use.value()) + " names no DEF; left out");
  } else if (std::strcmp(meant.name(), node.name()) != 0) {
    warn(node, "USE=" + in_quotes(use.value()) + " names a node of another kind; left out");
    return {};
  }
  return meant;
}

pugi::xml_node Context::child(const pugi::xml_node& node, const char* name) {
  const pugi::xml_node found = direct_child(node, name);
  return found ? resolve(found) : found;
}

bool Context::flag(const pugi::xml_node& node, const char* field, bool otherwise) {
  std::string_view text = attribute(node, field).value();
  if (!look(node, text.size() / 8)) return otherwise;
  const std::string_view token = next_token(text, separators);
  if (token.empty()) return otherwise;
  if (token == "true" || token == "TRUE") return true;
  if (token == "false" || token == "FALSE") return false;
  fail(node, std::string(field) + " is " + in_quotes(token) + ", expected true or false");
  return otherwise;
}

std::vector<float> Context::floats(const pugi::xml_node& node, const char* field) {
  std::vector<float> values;
  if (error_) return values;
  std::string_view rest = attribute(node, field).value();
  if (!look(node, rest.size() / 8)) return {};
  for (std::string_view token; !(token = next_token(rest, separators)).empty();) {
    const auto value = number(token);
    if (!value) {
      fail(node, std::string(field) + ": " + value.error().text);
      return {};
    }
    if (!spend(node, numbers_left_, 1, "50,000,000 numbers")) return {};
    values.push_back(*value);
  }
  return values;
}

std::vector<std::int32_t> Context::wholes(const pugi::xml_node& node, const char* field) {
  std::vector<std::int32_t> values;
  if (error_) return values;
  std::string_view rest = attribute(node, field).value();
  if (!look(node, rest.size() / 8)) return {};
  for (std::string_view token; !(token = next_token(rest, separators)).empty();) {
    const auto value = whole(token);
    if (!value) {
      fail(node, std::string(field) + ": " + in_quotes(token) + " is not a whole number");
      return {};
    }
    if (!spend(node, numbers_left_, 1, "50,000,000 numbers")) return {};
    values.push_back(*value);
  }
  return values;
}

float Context::scalar(const pugi::xml_node& node, const char* field, float otherwise) {
  const std::vector<float> values = floats(node, field);
  return values.empty() ? otherwise : values[0];
}

glm::vec3 Context::vector(const pugi::xml_node& node, const char* field, const glm::vec3& otherwise) {
  const std::vector<float> v = floats(node, field);
  if (v.empty()) return otherwise;
  if (v.size() != 3) {
    fail(node, std::string(field) + " has " + std::to_string(v.size()) + " numbers, expected 3");
    return otherwise;
  }
  return {v[0], v[1], v[2]};
}

std::vector<glm::vec2> Context::pairs(const pugi::xml_node& node, const char* field) {
  const std::vector<float> v = floats(node, field);
  std::vector<glm::vec2> out;
  if (v.size() % 2 != 0)
    fail(node, std::string(field) + " has " + std::to_string(v.size()) + " numbers, expected pairs");
  for (std::size_t i = 0; i + 1 < v.size(); i += 2) out.emplace_back(v[i], v[i + 1]);
  return out;
}

std::vector<glm::vec3> Context::triples(const pugi::xml_node& node, const char* field) {
  const std::vector<float> v = floats(node, field);
  std::vector<glm::vec3> out;
  if (v.size() % 3 != 0)
    fail(node, std::string(field) + " has " + std::to_string(v.size()) + " numbers, expected triples");
  for (std::size_t i = 0; i + 2 < v.size(); i += 3) out.emplace_back(v[i], v[i + 1], v[i + 2]);
  return out;
}

std::vector<std::string> Context::strings(const pugi::xml_node& node, const char* field) {
  const std::string_view text = attribute(node, field).value();
  std::vector<std::string> out;
  if (!look(node, text.size() / 8)) return out;
  for (std::size_t at = text.find('"'); at != text.npos; at = text.find('"', at)) {
    const std::size_t end = text.find('"', at + 1);
    if (end == text.npos) break;
    out.emplace_back(text.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  if (out.empty()) {
    const std::size_t begin = text.find_first_not_of(separators);
    if (begin != text.npos)
      out.emplace_back(text.substr(begin, text.find_last_not_of(separators) + 1 - begin));
  }
  return out;
}

bool Context::spend(const pugi::xml_node& at, std::size_t& budget, std::size_t count, const char* of_what) {
  if (error_) return false;
  if (count > budget) {
    fail(at, std::string("the scene is over the limit of ") + of_what);
    return false;
  }
  budget -= count;
  return true;
}

bool is_element(const pugi::xml_node& node) { return node.type() == pugi::node_element; }

bool is_silent(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.starts_with("Metadata") || name == "WorldInfo";
}

}  // namespace load::x3d
