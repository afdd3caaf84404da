#include "inspect/json.h"

#include <array>
#include <nlohmann/json.hpp>

namespace inspect {
namespace {

using Json = nlohmann::ordered_json;

Json by_cause(const std::array<std::uint64_t, cause_count>& counts) {
  Json object = Json::object();
  for (std::size_t c = 0; c < cause_count; ++c) object[std::string(cause_names[c])] = counts[c];
  return object;
}

Json number_or_null(std::uint32_t value) { return value == nobody ? Json(nullptr) : Json(value); }
static_assert(nobody == gpu::no_bucket);

Json id_or_null(std::uint32_t frame, const DrawId& draw) {
  return draw.draw == nobody ? Json(nullptr) : Json(id(frame, draw));
}

Json pairs(const Report& report) {
  Json list = Json::array();
  for (const WrongPair& pair : report.pairs) {
    list.push_back({{"winner", id_or_null(report.frame, pair.winner)},
                    {"owner", id_or_null(report.frame, pair.owner)},
                    {"cause", pair.has_cause ? Json(name(pair.cause)) : Json(nullptr)},
                    {"pixels", pair.pixels},
                    {"winner_bucket", number_or_null(pair.winner.bucket)},
                    {"owner_bucket", number_or_null(pair.owner.bucket)},
                    {"winner_depth", pair.winner_depth},
                    {"owner_depth", pair.owner_depth},
                    {"winner_half", pair.winner_half + 1},
                    {"owner_half", pair.owner_half + 1},
                    {"example",
                     {static_cast<int>(pair.example % gpu::Vram::width) - report.picture.x,
                      static_cast<int>(pair.example / gpu::Vram::width) - report.picture.y}}});
  }
  return list;
}

Json lint(const Report& report) {
  Json list = Json::array();
  for (const LintItem& item : report.lint)
    list.push_back({{"kind", item.kind}, {"at", item.at}, {"text", item.text}});
  return list;
}

Json buckets(const BucketCensus& b) {
  if (!b.known) return "not available";
  return {{"used", b.used},
          {"tied", b.tied},
          {"largest", b.largest},
          {"largest_bucket", b.largest_bucket},
          {"histogram", b.histogram}};
}

void header(Json& json, const Report& report) {
  json["schema"] = "otter.inspect/1";
  json["scene"] = report.scene;
  json["frame"] = report.frame;
  json["width"] = report.picture.width;
  json["height"] = report.picture.height;
}

void counts(Json& json, const Report& report) {
  json["pixels_drawn"] = report.pixels_drawn;
  json["wrong_pixels"] = report.wrong_pixels();
  json["causes"] = by_cause(report.causes);
  json["raw_causes"] = by_cause(report.raw_causes);
}

void details(Json& json, const Report& report) {
  json["pairs"] = pairs(report);
  json["lint"] = lint(report);
  json["polygons_judged"] = report.polygons_judged;
  json["polygons_without_depth"] = report.polygons_without_depth;
  json["samples"] = report.fragments;
  json["comparisons"] = {{"filtered", report.decisions.filtered}, {"exact", report.decisions.exact}};
  json["buckets"] = buckets(report.buckets);
}

// Names of files may hold any bytes; they must not make the output fail.
std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string to_json(const Report& report) {
  Json json;
  header(json, report);
  counts(json, report);
  details(json, report);
  return dump(json);
}

FramesJson::FramesJson() : spool_(std::tmpfile()) {}

bool FramesJson::add(const Report& report) {
  if (sums_.frames == 0) {
    first_.scene = report.scene;
    first_.frame = report.frame;
    first_.picture = report.picture;
    single_ = to_json(report);
  }
  sums_.add(report);
  if (spool_ == nullptr) return sums_.frames == 1;
  Json frame;
  frame["frame"] = report.frame;
  counts(frame, report);
  details(frame, report);
  std::string lines = dump(frame);
  lines.pop_back();  // the last newline
  std::string text = sums_.frames == 1 ? "\n    " : ",\n    ";
  for (const char c : lines) c == '\n' ? text.append("\n    ") : text.append(1, c);
  return std::fwrite(text.data(), 1, text.size(), spool_.get()) == text.size();
}

void FramesJson::write(std::FILE* to) {
  if (sums_.frames == 1) {
    std::fputs(single_.c_str(), to);
    return;
  }
  Json json;
  header(json, first_);
  json["pixels_drawn"] = sums_.pixels_drawn;
  json["wrong_pixels"] = sums_.wrong_pixels;
  json["causes"] = by_cause(sums_.causes);
  json["raw_causes"] = by_cause(sums_.raw_causes);
  json["pairs"] = Json::array();
  json["lint"] = Json::array();
  json["frames"] = Json::array();
  const std::string around = dump(json);
  const auto inside = around.rfind(']');
  std::fwrite(around.data(), 1, inside, to);
  std::array<char, 65536> block{};
  std::rewind(spool_.get());
  while (const auto n = std::fread(block.data(), 1, block.size(), spool_.get()))
    std::fwrite(block.data(), 1, n, to);
  std::fputs("\n  ", to);
  std::fputs(around.c_str() + inside, to);
}

}  // namespace inspect
