// The report in words and columns.

#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "inspect/report.h"

namespace inspect {
namespace {

constexpr std::size_t worst_pairs_shown = 8;

__attribute__((format(printf, 2, 3))) void print(std::string& out, const char* format, ...) {
  std::array<char, 512> line{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  out += line.data();
}

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

unsigned long long count(std::uint64_t n) { return n; }

// Of one frame, or of many.
template <class Counts>
void causes(std::string& out, const Counts& counts) {
  for (std::size_t c = 0; c < cause_count; ++c) {
    if (counts.raw_causes[c] == 0) continue;
    print(out, "    %-16s %9llu   (matches on %llu)\n", cause_names[c].data(), count(counts.causes[c]),
          count(counts.raw_causes[c]));
  }
}

void comparisons(std::string& out, const exact::DecisionCounts& decisions) {
  print(out, "  comparisons %llu, of which exact %llu (%.3f %%)\n",
        count(decisions.filtered + decisions.exact), count(decisions.exact),
        percent(decisions.exact, decisions.filtered + decisions.exact));
}

void pairs(std::string& out, const Report& report) {
  if (report.pairs.empty()) return;
  print(out, "  worst pairs (seen / should be)\n");
  for (std::size_t i = 0; i < report.pairs.size() && i < worst_pairs_shown; ++i) {
    const WrongPair& pair = report.pairs[i];
    const auto winner = id(report.frame, pair.winner) + half_name(pair.winner_is_folded, pair.winner_half);
    const auto owner = id(report.frame, pair.owner) + half_name(pair.owner_is_folded, pair.owner_half);
    print(out, "    %7llu px  %-16s %s / %s, depth %.2f / %.2f at (%d,%d)\n", count(pair.pixels),
          pair.has_cause ? name(pair.cause).data() : "(a bug)", winner.c_str(), owner.c_str(),
          pair.winner_depth, pair.owner_depth,
          static_cast<int>(pair.example % gpu::Vram::width) - report.picture.x,
          static_cast<int>(pair.example / gpu::Vram::width) - report.picture.y);
  }
  if (report.pairs.size() > worst_pairs_shown) {
    print(out, "    and %zu more\n", report.pairs.size() - worst_pairs_shown);
  }
}

void buckets(std::string& out, const Report& report) {
  const BucketCensus& b = report.buckets;
  if (!b.known) {
    print(out, "  buckets: not available (no ordering table is known)\n");
    return;
  }
  print(out, "  buckets: %u used, %llu draws share theirs, most in %u (%u)\n", b.used, count(b.tied),
        b.largest_bucket, b.largest);
  out += "    draws a bucket holds:";
  for (std::size_t power = 0; power < b.histogram.size(); ++power) {
    const std::uint32_t least = 1U << power, buckets = b.histogram[power];
    if (buckets == 0) continue;
    power == 0 ? print(out, " 1") : print(out, " %u-%u", least, 2 * least - 1);
    print(out, " (%u)", buckets);
  }
  out += "\n";
}

}  // namespace

DrawId draw_id(const gpu::Trace& trace, std::uint32_t draw) {
  if (draw == nobody) return {};
  const auto number = gpu::number_of(0, trace.draws[draw]);
  return {draw, number.command, number.bucket};
}

std::string half_name(bool is_folded, std::uint8_t half) {
  if (!is_folded) return {};
  return half == 0 ? " (first half)" : " (second half)";
}

std::string id(std::uint32_t frame, const DrawId& draw) {
  if (draw.draw == nobody) return "background";
  return gpu::to_text({frame, draw.command, draw.bucket});
}

std::string to_text(const Report& report) {
  std::string out;
  print(out, "%s, frame %u: %d x %d\n", report.scene.c_str(), report.frame, report.picture.width,
        report.picture.height);
  print(out, "  pixels drawn %llu, samples judged %llu, polygons judged %u", count(report.pixels_drawn),
        count(report.fragments), report.polygons_judged);
  if (report.polygons_without_depth != 0) print(out, ", without depth %u", report.polygons_without_depth);
  if (report.polygons_judged == 0) {
    out += "\n  wrong pixels not available: no polygon carries depth, so nothing could be judged\n";
  } else {
    print(out, "\n  wrong pixels %llu (%.2f %% of those drawn)\n", count(report.wrong_pixels()),
          percent(report.wrong_pixels(), report.pixels_drawn));
  }
  causes(out, report);
  pairs(out, report);
  buckets(out, report);
  comparisons(out, report.decisions);
  for (const LintItem& item : report.lint) {
    print(out, "  lint %s%s%s: %s\n", item.kind.c_str(), item.at.empty() ? "" : " at ", item.at.c_str(),
          item.text.c_str());
  }
  return out;
}

std::string to_text(const Sums& sums) {
  std::string out;
  print(out, "%llu frames\n  wrong pixels %llu (%.2f %% of %llu drawn)", count(sums.frames),
        count(sums.wrong_pixels), percent(sums.wrong_pixels, sums.pixels_drawn), count(sums.pixels_drawn));
  if (sums.worst_pixels != 0)
    print(out, ", most in frame %u: %llu", sums.worst_frame, count(sums.worst_pixels));
  out += "\n";
  causes(out, sums);
  comparisons(out, sums.decisions);
  return out;
}

}  // namespace inspect
