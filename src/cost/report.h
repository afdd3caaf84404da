#pragma once
// The cost report in its forms. All are made from the same rows; none measures anything.

#include <string>
#include <vector>

#include "cost/sweep.h"

namespace cost {

/// Processor name and number of cores, as the operating system tells.
std::string machine_name();
/// What built this program: "GCC 12.2.0".
std::string compiler_name();

struct Report {
  std::string command;  ///< as typed
  std::string machine;  ///< processor and cores
  std::string target;   ///< dispatch target of the vector code
  std::string compiler = compiler_name();
  std::vector<SceneResult> scenes;
};

/// {"schema":"otter.cost/1","scene","frame","width","height","settings":[...], ...}. Of several scenes the
/// first names the report, and every setting bears its own.
std::string to_json(const Report& report);
/// One line a setting, header first.
std::string to_csv(const Report& report);
/// The table on the terminal, ratios to the console's setting, and a sentence per axis.
std::string to_text(const Report& report);

/// One page that needs nothing else: plots as inline SVG (by gnuplot), pictures as inline PNG.
struct Html {
  std::string page;
  bool has_plots = true;  ///< false: gnuplot could not be run
};
Html to_html(const Report& report);

/// A gnuplot script's SVG, without its XML prologue; empty if gnuplot cannot be run.
std::string plotted(const std::string& script);
/// `picture` as a PNG in base64: what follows "data:image/png;base64,".
std::string png_base64(const base::Picture& picture);

}  // namespace cost
