#pragma once
// The options of one subcommand. Commands see nothing of the command-line library: its headers take longer to
// compile than any of them.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/knobs.h"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace app {

enum class Presence : std::uint8_t { optional, required };

/// Declares options; what they are read into must live until the command line is read. `names`:
/// "-o,--output". `type`: what --help calls the value. `help`: one line, the default in [brackets]. Given
/// twice, the last one counts.
class Arguments {
 public:
  explicit Arguments(CLI::App& sub) : sub_(sub) {}

  /// What comes without a dash.
  void positional(const char* name, const char* type, std::string& value, const char* help,
                  Presence presence = Presence::optional);
  void positionals(const char* name, const char* type, std::vector<std::string>& values, const char* help);

  /// Everything behind what comes without a dash, as it was given.
  void rest(std::vector<std::string>& values);

  void text(const char* names, const char* type, std::string& value, const char* help,
            Presence presence = Presence::optional);
  /// A text that may be left out behind its option: then it is `otherwise`.
  void text_or(const char* names, const char* type, std::string& value, const char* otherwise,
               const char* help);
  /// Words with commas between them.
  void words(const char* names, const char* type, std::vector<std::string>& values, const char* help);
  void choice(const char* names, std::string& value, std::initializer_list<const char*> values,
              const char* help);
  void flag(const char* names, bool& value, const char* help);
  /// A whole number, low..high. T: int, std::int64_t, std::uint32_t, std::uint64_t.
  template <class T>
  void number(const char* names, const char* type, T& value, T low, T high, const char* help);
  template <class T>
  void number(const char* names, const char* type, std::optional<T>& value, T low, T high, const char* help);

  /// An option that stands for itself: `a` beside `b` is refused.
  void exclude(const char* a, const char* b);

  /// Every knob of scene::knob_table(), in the group "Knobs"; a wrong value ends parsing with the knob's own
  /// message. `names`: only these knobs; empty: all. `given`: the names of those on the command line are
  /// added.
  void knobs(scene::Knobs& knobs, std::initializer_list<std::string_view> names = {},
             std::vector<std::string>* given = nullptr);
  void knobs(scene::Knobs& knobs, std::span<const std::string_view> names,
             std::vector<std::string>* given = nullptr);

  /// Text under the options of --help in place of the examples.
  void footer(std::function<std::string()> text);

 private:
  CLI::App& sub_;
};

/// Before a parsed subcommand runs: no file may be written twice, or read and written, by whatever names
/// (base/same_file.h). Outputs are the options whose type is FILE. Error (exit 2).
base::Result<void> guard_outputs(const CLI::App& sub);
/// The same for files that an input names (pictures, materials): they must be none of the outputs.
base::Result<void> guard_inputs(std::span<const std::filesystem::path> files);

/// The error of reading a command line in one line, naming the option and what was expected.
std::string one_line(const CLI::ParseError& error);

}  // namespace app
