#include "app/commands/arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <utility>

#include "base/same_file.h"
#include "demos/demos.h"

namespace app {
namespace {

// Options that name a FILE to be read.
constexpr std::array<std::string_view, 5> inputs{"--vram-in", "--expect", "--mask", "--settings", "--saved"};

std::vector<base::NamedFile>& outputs() {
  static std::vector<base::NamedFile> of_this_run;  // the program runs one subcommand
  return of_this_run;
}

void set_or_throw(scene::Knobs& knobs, const std::string& name, const std::string& value) {
  if (const auto set = scene::set_knob(knobs, name, value); !set) {
    throw CLI::ValidationError(set.error().text, CLI::ExitCodes::ValidationError);
  }
}

}  // namespace

void Arguments::positional(const char* name, const char* type, std::string& value, const char* help,
                           Presence presence) {
  sub_.add_option(name, value, help)->type_name(type)->required(presence == Presence::required);
}

void Arguments::positionals(const char* name, const char* type, std::vector<std::string>& values,
                            const char* help) {
  sub_.add_option(name, values, help)->type_name(type);
}

void Arguments::rest(std::vector<std::string>& values) {
  sub_.prefix_command();
  sub_.parse_complete_callback([this_sub = &sub_, &values] { values = this_sub->remaining(); });
}

void Arguments::text(const char* names, const char* type, std::string& value, const char* help,
                     Presence presence) {
  sub_.add_option(names, value, help)->type_name(type)->required(presence == Presence::required)->take_last();
}

void Arguments::text_or(const char* names, const char* type, std::string& value, const char* otherwise,
                        const char* help) {
  sub_.add_option_function<std::vector<std::string>>(
          names,
          [&value, otherwise](const std::vector<std::string>& given) {
            value = given.empty() || given.back().empty() ? otherwise : given.back();
          },
          help)
      ->type_name(type)
      ->expected(0, 1);
}

void Arguments::words(const char* names, const char* type, std::vector<std::string>& values,
                      const char* help) {
  sub_.add_option(names, values, help)->type_name(type)->delimiter(',');
}

void Arguments::choice(const char* names, std::string& value, std::initializer_list<const char*> values,
                       const char* help) {
  std::string type;
  for (const char* word : values) type.append(type.empty() ? "" : "|").append(word);
  sub_.add_option(names, value, help)
      ->type_name(type)
      ->check(CLI::IsMember(std::vector<std::string>(values.begin(), values.end())).description(""))
      ->take_last();
}

void Arguments::flag(const char* names, bool& value, const char* help) { sub_.add_flag(names, value, help); }

template <class T>
void Arguments::number(const char* names, const char* type, T& value, T low, T high, const char* help) {
  sub_.add_option(names, value, help)
      ->type_name(type)
      ->check(CLI::Range(low, high).description(""))
      ->take_last();
}

template <class T>
void Arguments::number(const char* names, const char* type, std::optional<T>& value, T low, T high,
                       const char* help) {
  sub_.add_option(names, value, help)
      ->type_name(type)
      ->check(CLI::Range(low, high).description(""))
      ->take_last();
}

template void Arguments::number(const char*, const char*, int&, int, int, const char*);
template void Arguments::number(const char*, const char*, std::int64_t&, std::int64_t, std::int64_t,
                                const char*);
template void Arguments::number(const char*, const char*, std::uint32_t&, std::uint32_t, std::uint32_t,
                                const char*);
template void Arguments::number(const char*, const char*, std::uint64_t&, std::uint64_t, std::uint64_t,
                                const char*);
template void Arguments::number(const char*, const char*, std::optional<int>&, int, int, const char*);
template void Arguments::number(const char*, const char*, std::optional<std::uint64_t>&, std::uint64_t,
                                std::uint64_t, const char*);

void Arguments::exclude(const char* a, const char* b) { sub_.get_option(a)->excludes(sub_.get_option(b)); }

void Arguments::knobs(scene::Knobs& knobs, std::initializer_list<std::string_view> names,
                      std::vector<std::string>* given) {
  this->knobs(knobs, std::span(names.begin(), names.size()), given);
}

void Arguments::knobs(scene::Knobs& knobs, std::span<const std::string_view> names,
                      std::vector<std::string>* given) {
  const auto take = [&knobs, given](const std::string& name, const std::string& value) {
    set_or_throw(knobs, name, value);
    if (given != nullptr) given->push_back(name);
  };
  for (const auto& knob : scene::knob_table()) {
    if (names.size() != 0 && std::find(names.begin(), names.end(), knob.name) == names.end()) continue;
    const std::string name(knob.name);
    CLI::Option* option = nullptr;
    if (knob.values == "off|on") {
      option = sub_.add_flag_callback(
          "--" + name, [take, name] { take(name, "on"); }, std::string(knob.help));
    } else {
      option = sub_.add_option_function<std::string>(
          "--" + name, [take, name](const std::string& value) { take(name, value); },
          std::string(knob.help) + " [" + knob.get(knobs) + "]");
      option->type_name(std::string(knob.values))->take_last();
    }
    option->group("Knobs");
  }
}

void Arguments::footer(std::function<std::string()> text) { sub_.footer(std::move(text)); }

base::Result<void> guard_outputs(const CLI::App& sub) {
  std::vector<base::NamedFile> read;
  outputs().clear();
  for (const CLI::Option* option : sub.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_positional() ? "the input" : option->get_name();
    const bool is_input =
        option->get_positional() || std::find(inputs.begin(), inputs.end(), name) != inputs.end();
    if (!is_input && option->get_type_name() != "FILE") continue;
    for (const std::string& path : option->reduced_results()) {
      if (is_input && demos::find(path) != nullptr) continue;
      (is_input ? read : outputs()).push_back({name, path});
    }
  }
  return base::check_outputs(outputs(), read);
}

base::Result<void> guard_inputs(std::span<const std::filesystem::path> files) {
  std::vector<base::NamedFile> read;
  for (const auto& file : files) read.push_back({"the input's", file.string()});
  return base::check_outputs(outputs(), read);
}

std::string one_line(const CLI::ParseError& error) {
  std::string text = error.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace app
