#include "inspect/report.h"

#include <algorithm>
#include <bit>
#include <map>
#include <set>
#include <tuple>

namespace inspect {
namespace {

using gpu::Kind;
using gpu::Vram;

// The drawing area that most polygons, or else most draws, were clipped to.
Rectangle picture_of(const gpu::Trace& trace) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::uint64_t, const gpu::DrawState*>> votes;
  for (const gpu::Primitive& p : trace.draws) {
    auto& [weight, state] = votes[{p.state.area_top_left, p.state.area_bottom_right}];
    weight += p.kind == Kind::polygon ? 1'000'000 : 1;
    state = &p.state;
  }
  const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
    return a.second.first < b.second.first;
  });
  if (most == votes.end()) return {0, 0, Vram::width, Vram::height};
  const gpu::DrawState& s = *most->second.second;
  const Rectangle area{s.left(), s.top(), s.right() - s.left() + 1,
                       std::min(s.bottom(), Vram::height - 1) - s.top() + 1};
  return area.is_empty() ? Rectangle{0, 0, Vram::width, Vram::height} : area;
}

std::uint64_t pixels_drawn(const gpu::Trace& trace) {
  std::vector<bool> drawn(Vram::size);
  for (const gpu::Event& event : trace.history) {
    const Kind kind = trace.draws[event.draw].kind;
    if (!event.rejected && kind <= Kind::line) drawn[event.pixel] = true;
  }
  return static_cast<std::uint64_t>(std::count(drawn.begin(), drawn.end(), true));
}

BucketCensus census(const gpu::Trace& trace) {
  std::map<std::uint32_t, std::uint32_t> buckets;
  for (const gpu::Primitive& p : trace.draws) {
    if (p.bucket != gpu::no_bucket && p.kind <= Kind::line) ++buckets[p.bucket];
  }
  BucketCensus result;
  result.known = !buckets.empty();
  result.used = static_cast<std::uint32_t>(buckets.size());
  for (const auto& [bucket, draws] : buckets) {
    if (draws > 1) result.tied += draws;
    if (draws > result.largest) {
      result.largest = draws;
      result.largest_bucket = bucket;
    }
    const auto power = static_cast<std::size_t>(std::bit_width(draws) - 1);
    result.histogram.resize(std::max(result.histogram.size(), power + 1));
    ++result.histogram[power];
  }
  return result;
}

WrongPixel as_wrong(const Verdict& verdict, std::uint32_t pixel) {
  const bool is_blend = verdict.shows_owner;
  const Fragment &winner = is_blend ? verdict.over : verdict.winner,
                 &owner = is_blend ? verdict.under : verdict.owner;
  return {pixel, winner.draw, owner.draw, winner.half, owner.half, is_blend, {}};
}

double depth_at(const Surfaces& surfaces, std::uint32_t draw, std::uint8_t half, std::uint32_t pixel) {
  return draw == nobody ? 0 : surfaces.depth({.draw = draw, .half = half}, pixel);
}

std::vector<WrongPair> find_pairs(const Report& report, const gpu::Trace& trace, const Fragments& fragments,
                                  const Surfaces& surfaces) {
  const auto named = [&](std::uint32_t draw) { return draw_id(trace, draw); };
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::optional<Cause>>, WrongPair> found;
  for (const WrongPixel& wrong : report.wrong) {
    const auto cause = wrong.causes.first();
    WrongPair& pair = found[{wrong.winner, wrong.owner, cause}];
    if (pair.pixels++ == 0) {
      pair.winner = named(wrong.winner);
      pair.owner = named(wrong.owner);
      pair.has_cause = cause.has_value();
      pair.cause = cause.value_or(Cause::blend_order);
      pair.example = wrong.pixel;
      pair.winner_depth = depth_at(surfaces, wrong.winner, wrong.winner_half, wrong.pixel);
      pair.owner_depth = depth_at(surfaces, wrong.owner, wrong.owner_half, wrong.pixel);
      pair.winner_half = wrong.winner_half;
      pair.owner_half = wrong.owner_half;
      pair.winner_is_folded = is_folded(fragments.at(wrong.pixel), wrong.winner);
      pair.owner_is_folded = is_folded(fragments.at(wrong.pixel), wrong.owner);
    }
  }
  std::vector<WrongPair> pairs;
  pairs.reserve(found.size());
  for (auto& [key, pair] : found) pairs.push_back(pair);
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const WrongPair& a, const WrongPair& b) { return a.pixels > b.pixels; });
  return pairs;
}

}  // namespace

void Sums::add(const Report& report) {
  ++frames;
  pixels_drawn += report.pixels_drawn;
  wrong_pixels += report.wrong_pixels();
  for (std::size_t c = 0; c < cause_count; ++c) {
    causes[c] += report.causes[c];
    raw_causes[c] += report.raw_causes[c];
  }
  decisions += report.decisions;
  if (report.wrong_pixels() > worst_pixels) {
    worst_pixels = report.wrong_pixels();
    worst_frame = report.frame;
  }
}

Report inspect(const gpu::Trace& trace, const Options& options) {
  Report report;
  report.scene = options.scene;
  report.frame = options.frame;
  report.picture = options.picture;
  report.order = options.order;
  if (report.picture.is_empty()) report.picture = picture_of(trace);
  for (const gpu::Primitive& p : trace.draws) {
    if (p.kind == Kind::polygon) ++(p.has_depth ? report.polygons_judged : report.polygons_without_depth);
  }
  report.pixels_drawn = pixels_drawn(trace);
  report.buckets = census(trace);
  report.lint = lint_draws(trace, options.frame);

  const Fragments fragments(trace, options.order);
  Surfaces surfaces(trace);
  report.fragments = fragments.size();
  for (std::uint32_t pixel = 0; pixel < Vram::size; ++pixel) {
    const auto here = fragments.at(pixel);
    if (here.empty()) continue;
    const Verdict verdict = judge(here, pixel, surfaces);
    if (!verdict.is_right()) report.wrong.push_back(as_wrong(verdict, pixel));
  }
  find_causes(report.wrong, trace, fragments, surfaces, options.order);
  for (const WrongPixel& wrong : report.wrong) {
    if (const auto first = wrong.causes.first()) ++report.causes[static_cast<std::size_t>(*first)];
    for (std::size_t c = 0; c < cause_count; ++c) {
      if (wrong.causes.contains(static_cast<Cause>(c))) ++report.raw_causes[c];
    }
  }
  report.pairs = find_pairs(report, trace, fragments, surfaces);
  report.decisions = surfaces.decisions;
  return report;
}

}  // namespace inspect
