#include "app/window/status.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/commands/describe.h"
#include "base/printed.h"

namespace app {
namespace {

constexpr std::size_t gap = 2;

const char* pace_name(Pace pace) {
  constexpr std::array names{"vsync", "60 Hz", "50 Hz", "slow"};
  return names[static_cast<std::size_t>(pace)];
}

// What describe() has said already.
bool is_described(std::string_view knob, scene::Visibility visibility) {
  using scene::Visibility;
  if (knob == "visibility") return true;
  if (knob == "buckets") return visibility == Visibility::ot;
  if (knob == "key") return visibility == Visibility::ot || visibility == Visibility::sorted;
  return visibility == Visibility::zbuffer && (knob == "depth" || knob == "depth-mapping");
}

// "paused at frame 12, command 3": so far it is drawn.
std::string paused_text(const WindowState& state) {
  auto text = "paused at frame " + std::to_string(state.frame);
  if (state.lens.shown) text += ", command " + std::to_string(*state.lens.shown);
  return text;
}

}  // namespace

std::vector<StatusPiece> status_pieces(const WindowState& state, const Status& status) {
  std::vector<StatusPiece> pieces;
  if (state.paused) pieces.push_back({paused_text(state), Tone::accent});
  if (state.live.is_recording) pieces.push_back({"recording", Tone::mark});
  if (state.live.fast) pieces.push_back({"fast", Tone::accent});
  if (state.live.program_keys) pieces.push_back({"keys: the program's", Tone::accent});
  if (!state.lens.edits.is_empty()) pieces.push_back({"changed", Tone::mark});
  pieces.push_back({status.scene, Tone::accent});
  const bool is_recorded = state.recorded.last != 0 && state.knobs.visibility == scene::Visibility::ot;
  pieces.push_back({is_recorded ? "as it was sent" : describe(state.knobs), Tone::plain});
  static const scene::Knobs console;
  for (const auto& knob : scene::knob_table()) {
    const auto value = knob.get(state.knobs);
    if (value == knob.get(console) || is_described(knob.name, state.knobs.visibility)) continue;
    const bool is_switch = knob.values == "off|on";
    pieces.push_back({std::string(knob.name) + (is_switch ? "" : " " + value), Tone::plain});
  }
  if (status.different) pieces.push_back({with_commas(*status.different) + " differ", Tone::mark});
  const auto add = [&pieces](std::string text) { pieces.push_back({std::move(text), Tone::dim, false}); };
  add(with_commas(status.stats.primitives) + " primitives");
  add(base::printed("GTE %.2f  OT %.2f  raster %.2f ms", status.stats.gte_ms, status.stats.ot_ms,
                    status.stats.raster_ms));
  if (!state.paused) add(base::printed("%.0f/s %s", status.frames_per_second, pace_name(state.pace)));
  return pieces;
}

std::vector<std::vector<StatusPiece>> status_rows(const std::vector<StatusPiece>& pieces, int columns) {
  const auto width = static_cast<std::size_t>(std::max(columns, 8));
  std::vector<std::vector<StatusPiece>> rows(1);
  std::size_t used = 0;
  const auto add = [&](StatusPiece piece) {
    used += piece.text.size() + gap;
    rows.back().push_back(std::move(piece));
  };
  for (const auto& piece : pieces) {
    if (used + piece.text.size() <= width) {
      add(piece);
      continue;
    }
    if (!piece.must_show) break;  // nothing after the first piece left out, or the order would lie
    for (std::size_t from = 0; from < piece.text.size(); from += width) {
      if (!rows.back().empty()) rows.emplace_back();
      used = 0;
      add({piece.text.substr(from, width), piece.tone});
    }
  }
  return rows;
}

std::string window_title(const WindowState& state, const std::string& scene) {
  auto title = "Otter: " + scene;
  if (state.split) title += ", split";
  if (state.paused) title += ", " + paused_text(state);
  return title;
}

}  // namespace app
