#include "sdk/report.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "display/scanout.h"

namespace sdk {
namespace {

std::vector<std::string> places(const std::vector<Finding>& findings) {
  std::vector<CallSite> sites;
  for (const auto& finding : findings) sites.push_back(finding.site);
  return describe(sites);
}

const char* word(Ending::Kind kind) {
  switch (kind) {
    case Ending::Kind::reached:
      return "reached";
    case Ending::Kind::ended:
      return "ended";
    case Ending::Kind::crashed:
      return "crashed";
  }
  return "";
}

}  // namespace

std::string to_text(Console& console, const Ending& ending, const std::string& program) {
  std::ostringstream out;
  out << program << ": " << console.blanks << " frames, " << console.lists << " lists, " << console.nodes
      << " tags, " << console.words << " words\n";
  if (console.depth.is_on()) {
    out << program << ": " << to_text(console.depth.shares()) << "\n";
  }
  if (ending.never_waited) out << program << ": never calls VSync: the blanks come from the clock\n";
  if (ending.kind == Ending::Kind::ended) out << program << ": ended at frame " << console.blanks << "\n";
  if (ending.kind == Ending::Kind::crashed) {
    out << program << ": " << ending.place << ": " << ending.signal << " at frame " << console.blanks << "\n";
  }
  const auto& findings = console.lint.findings();
  const auto where = places(findings);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    out << where[i] << ": " << findings[i].kind << ": " << to_text(findings[i]) << "\n";
  }
  return out.str();
}

std::string to_json(Console& console, const Ending& ending, const std::string& program) {
  const auto& shares = console.depth.shares();
  const auto area = display::area_of(console.gpu.display());
  nlohmann::ordered_json json{{"schema", "otter.play/1"},
                              {"scene", program},
                              {"frame", console.blanks.load()},
                              {"width", area.width},
                              {"height", area.height},
                              {"end", word(ending.kind)},
                              {"signal", ending.signal},
                              {"place", ending.place},
                              {"never_waited", ending.never_waited},
                              {"lists", console.lists},
                              {"tags", console.nodes},
                              {"words", console.words},
                              {"depth",
                               {{"polygons", shares.polygons()},
                                {"by_address", shares.by_address},
                                {"by_value", shares.by_value},
                                {"by_packet", shares.by_packet},
                                {"none", shares.none},
                                {"partly", shares.partly},
                                {"stale_vertices", shares.stale},
                                {"ambiguous_values", shares.ambiguous}}},
                              {"lint", nlohmann::ordered_json::array()}};
  const auto& findings = console.lint.findings();
  const auto where = places(findings);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const auto& f = findings[i];
    json["lint"].push_back(
        {{"kind", f.kind}, {"at", where[i]}, {"text", f.text}, {"frame", f.frame}, {"times", f.times}});
  }
  return json.dump(2) + "\n";
}

}  // namespace sdk
