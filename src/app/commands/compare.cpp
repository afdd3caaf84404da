// otter compare: where two dumps part.

#include "debug/compare.h"

#include <cstdio>
#include <memory>
#include <string>

#include "app/commands/arguments.h"
#include "app/commands/commands.h"
#include "app/commands/interrupt.h"
#include "app/commands/json.h"
#include "app/commands/progress.h"
#include "app/source.h"
#include "base/message.h"

namespace app {
namespace {

struct CompareOptions {
  std::string a, b, json, frame_by;
};

base::Result<std::unique_ptr<debug::Timeline>> open_compared(const std::string& name,
                                                             const std::string& frame_by) {
  auto source = open_source(name, {.head = {}, .table = {}, .vram_in = {}, .frame_by = frame_by});
  if (!source) return tl::make_unexpected(source.error());
  if (!source->is_recording())
    return base::fail(name + ": expected a dump; otter record makes one of a scene");
  auto timeline = open_timeline(*source, {});
  if (!timeline) return timeline;
  if (auto read = (*timeline)->read_all(); !read) return tl::make_unexpected(read.error());
  warn_of_fault(**timeline);
  return timeline;
}

std::string writer_text(const std::optional<debug::Writer>& writer) {
  if (!writer) return "nothing wrote it";
  return debug::to_text(writer->number) + " " + std::string(debug::name(writer->kind));
}

void print_parting(const debug::Parting& parting) {
  if (parting.is_none()) {
    std::printf("no difference in %llu frames, %llu commands\n",
                static_cast<unsigned long long>(parting.frames),
                static_cast<unsigned long long>(parting.commands_compared));
    return;
  }
  const auto print_side = [](const char* name, const debug::Side& side) {
    std::printf("  %s %s  %s\n", name, debug::to_text(side.number).c_str(), side.text.c_str());
  };
  if (parting.commands) {
    std::puts("commands differ from here on:");
    print_side("A", parting.commands->a);
    print_side("B", parting.commands->b);
  }
  if (parting.state) {
    std::printf("registers differ at the end of frame %llu, A and B:\n",
                static_cast<unsigned long long>(parting.state->frame));
    for (const auto& text : parting.state->registers) std::printf("  %s\n", text.c_str());
  }
  if (parting.pixels) {
    const auto& p = *parting.pixels;
    std::printf("%llu pixels differ at the end of frame %llu, the first is VRAM %u,%u:\n",
                static_cast<unsigned long long>(p.count), static_cast<unsigned long long>(p.frame),
                static_cast<unsigned>(p.first % gpu::Vram::width),
                static_cast<unsigned>(p.first / gpu::Vram::width));
    std::printf("  A %04X  %s\n  B %04X  %s\n", p.a, writer_text(p.writer_a).c_str(), p.b,
                writer_text(p.writer_b).c_str());
  }
}

Json side_json(const debug::Side& side) {
  return {{"number", debug::to_text(side.number)}, {"text", side.text}};
}

Json parting_json(const CompareOptions& options, const debug::Parting& parting) {
  Json json{{"schema", "otter.compare/1"},
            {"scene", options.a},
            {"frame", parting.frames},
            {"width", gpu::Vram::width},
            {"height", gpu::Vram::height},
            {"other", options.b},
            {"equal", parting.is_none()},
            {"command", nullptr},
            {"state", nullptr},
            {"pixel", nullptr}};
  if (parting.commands)
    json["command"] = {{"a", side_json(parting.commands->a)}, {"b", side_json(parting.commands->b)}};
  if (parting.state)
    json["state"] = {{"frame", parting.state->frame}, {"registers", parting.state->registers}};
  if (parting.pixels) {
    const auto& p = *parting.pixels;
    const auto writer = [](const std::optional<debug::Writer>& w) {
      return w ? Json(debug::to_text(w->number)) : Json(nullptr);
    };
    json["pixel"] = {{"frame", p.frame},
                     {"count", p.count},
                     {"vram", {p.first % gpu::Vram::width, p.first / gpu::Vram::width}},
                     {"a", p.a},
                     {"b", p.b},
                     {"writer_a", writer(p.writer_a)},
                     {"writer_b", writer(p.writer_b)}};
  }
  return json;
}

base::Result<int> run_compare(const CompareOptions& options) {
  auto a = open_compared(options.a, options.frame_by);
  if (!a) return tl::make_unexpected(a.error());
  auto b = open_compared(options.b, options.frame_by);
  if (!b) return tl::make_unexpected(b.error());
  const Interrupt interrupt;
  Progress progress("compare", static_cast<std::size_t>(std::min((*a)->frames(), (*b)->frames())));
  const auto parting = debug::compare(**a, **b, [&](std::uint64_t frame) {
    progress.at(static_cast<std::size_t>(frame));
    return !interrupt.was_asked();
  });
  if (!parting.is_complete) return base::fail("interrupted", base::Exit::interrupted);
  if (options.json != "-") print_parting(parting);
  if (!options.json.empty()) {
    if (auto written = write_json(options.json, parting_json(options, parting)); !written)
      return tl::make_unexpected(written.error());
  }
  return parting.is_none() ? 0 : static_cast<int>(base::Exit::failed);
}

}  // namespace

Action add_compare(Arguments arguments) {
  const auto options = std::make_shared<CompareOptions>();
  arguments.positional("a", "A", options->a, "a GPU dump", Presence::required);
  arguments.positional("b", "B", options->b, "another one", Presence::required);
  add_frame_by(arguments, options->frame_by);
  arguments.text("--json", "FILE", options->json, "the report as JSON; - is standard output");
  return [options] { return run_compare(*options); };
}

}  // namespace app
