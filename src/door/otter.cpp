// The C library over door::Device: every argument is checked here, nothing is thrown across.

#include "otter/otter.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "display/scanout.h"
#include "door/device.h"
#include "door/knobs.h"
#include "door/lint.h"
#include "ot/gp0.h"

struct otter {
  door::Device device;
  std::string error;
  std::vector<std::string> lint;
  // The words of a command that comes one by one, while nothing but the GPU wants them: it does nothing
  // before the command is whole, and whatever else is called sends them first.
  std::array<std::uint32_t, 16> begun{};
  std::size_t begun_count = 0, needed = 0;

  void send_begun() {
    if (begun_count != 0) device.gp0(std::span(begun).first(std::exchange(begun_count, 0)));
  }
  void take(std::uint32_t word) {
    if (begun_count == 0) {
      needed = device.is_plain() && device.gpu().is_between_commands() ? ot::gp0::command_words(word) : 1;
      if (needed == 1 || needed > begun.size()) return device.gp0(std::span(&word, 1));
    }
    begun[begun_count++] = word;
    if (begun_count == needed) send_begun();
  }
};

namespace {

#define OTTER_TEXT(x) #x
#define OTTER_VERSION_TEXT(major, minor, patch) OTTER_TEXT(major) "." OTTER_TEXT(minor) "." OTTER_TEXT(patch)
constexpr const char* version =
    OTTER_VERSION_TEXT(OTTER_VERSION_MAJOR, OTTER_VERSION_MINOR, OTTER_VERSION_PATCH);

std::string& error_without_handle() {
  thread_local std::string text;
  return text;
}

/// Keeps the text, unless there is no memory even for that. A text is no part of what a const handle keeps.
int fail(const otter* gpu, int code, std::string_view text) noexcept {
  try {
    (gpu != nullptr ? const_cast<otter*>(gpu)->error : error_without_handle()) = text;
  } catch (...) {  // the code says enough
  }
  return code;
}

// Apart from what is called word by word: inlined there, they would cost every call their registers.
[[gnu::cold, gnu::noinline]] int no_handle(const char* function) noexcept {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%s: the handle is null", function);
  return fail(nullptr, OTTER_NO_HANDLE, text.data());
}
/// In a catch clause: what was thrown as a code.
[[gnu::cold, gnu::noinline]] int thrown(const otter* gpu) noexcept {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return fail(gpu, OTTER_NO_MEMORY, "no memory is left");
  } catch (const std::exception& e) {
    return fail(gpu, OTTER_NO_MEMORY, e.what());
  } catch (...) {
    return fail(gpu, OTTER_NO_MEMORY, "something was thrown");
  }
}

/// Runs `body`, which returns a code; what it throws becomes one.
template <class Handle, class Body>
int guarded(Handle* gpu, const char* function, Body&& body) noexcept {
  if (gpu == nullptr) return no_handle(function);
  try {
    if constexpr (!std::is_const_v<Handle>) gpu->send_begun();
    return body(*gpu);
  } catch (...) {
    return thrown(gpu);
  }
}

int bad_argument(const otter& gpu, const char* function, const char* text) {
  return fail(&gpu, OTTER_BAD_ARGUMENT, std::string(function) + ": " + text);
}

/// Main RAM that links can be resolved in.
bool is_ram(const std::uint32_t* ram, std::size_t bytes) {
  constexpr std::size_t most = std::size_t{8} << 20;
  return ram != nullptr && bytes >= 4 && bytes <= most && std::has_single_bit(bytes);
}
constexpr const char* ram_text = "main RAM must be a power of two of bytes, from 4 to 8 MiB, and not null";

bool is_pixel(int x, int y) { return x >= 0 && x < gpu::Vram::width && y >= 0 && y < gpu::Vram::height; }

otter_draw draw_of(const gpu::Primitive& p) {
  otter_draw draw{};
  draw.kind = static_cast<std::uint32_t>(p.kind);
  draw.command = p.command;
  draw.command_number = p.command_number;
  draw.bucket = p.bucket;
  draw.vertices = p.vertex_count;
  for (std::size_t v = 0; v < p.vertex_count; ++v) {
    draw.x[v] = p.vertices[v].x;
    draw.y[v] = p.vertices[v].y;
    draw.z[v] = p.has_depth ? p.vertices[v].z : 0;
  }
  draw.width = p.width;
  draw.height = p.height;
  return draw;
}

const char* const not_traced = "writes are not traced: otter_trace() begins it";

const char* knob_text(int n, const char* (*text)(const door::Knob&)) noexcept {
  try {
    const auto knobs = door::knobs();
    if (n < 0 || static_cast<std::size_t>(n) >= knobs.size()) return nullptr;
    return text(knobs[static_cast<std::size_t>(n)]);
  } catch (...) {
    return nullptr;
  }
}

}  // namespace

extern "C" {

const char* otter_version(void) { return version; }

const char* otter_last_error(const otter* gpu) {
  try {
    return gpu != nullptr ? gpu->error.c_str() : error_without_handle().c_str();
  } catch (...) {
    return "";
  }
}

otter* otter_create(void) {
  try {
    return new otter;
  } catch (...) {
    fail(nullptr, OTTER_NO_MEMORY, "otter_create: no memory is left");
    return nullptr;
  }
}

void otter_destroy(otter* gpu) { delete gpu; }

int otter_gp0(otter* gpu, const uint32_t* words, size_t count) {
  return guarded(gpu, "otter_gp0", [&](otter& o) {
    if (count == 0) return int{OTTER_OK};
    if (words == nullptr || count > SIZE_MAX / sizeof *words)
      return bad_argument(o, "otter_gp0", "the words are null, or more than memory holds");
    o.device.gp0(std::span(words, count));
    return int{OTTER_OK};
  });
}

int otter_gp0_word(otter* gpu, uint32_t word) {
  if (gpu == nullptr) return no_handle("otter_gp0_word");
  try {
    gpu->take(word);
    return OTTER_OK;
  } catch (...) {
    return thrown(gpu);
  }
}

int otter_gp1(otter* gpu, uint32_t word) {
  return guarded(gpu, "otter_gp1", [&](otter& o) {
    o.device.gp1(word);
    return int{OTTER_OK};
  });
}

uint32_t otter_read(otter* gpu) {
  std::uint32_t word = 0;
  guarded(gpu, "otter_read", [&](otter& o) {
    word = o.device.read();
    return int{OTTER_OK};
  });
  return word;
}

int otter_read_many(otter* gpu, uint32_t* words, size_t count) {
  return guarded(gpu, "otter_read_many", [&](otter& o) {
    if (count == 0) return int{OTTER_OK};
    if (words == nullptr || count > SIZE_MAX / sizeof *words)
      return bad_argument(o, "otter_read_many", "the words are null, or more than memory holds");
    o.device.read(std::span(words, count));
    return int{OTTER_OK};
  });
}

uint32_t otter_status(otter* gpu) {
  std::uint32_t status = 0;
  guarded(gpu, "otter_status", [&](otter& o) {
    status = o.device.status();
    return int{OTTER_OK};
  });
  return status;
}

int otter_vblank(otter* gpu) {
  return guarded(gpu, "otter_vblank", [&](otter& o) {
    o.device.vblank();
    return int{OTTER_OK};
  });
}

int otter_dma_chain(otter* gpu, const uint32_t* ram, size_t bytes, uint32_t head, uint32_t max_tags,
                    otter_list* list) {
  return guarded(gpu, "otter_dma_chain", [&](otter& o) {
    if (!is_ram(ram, bytes)) return bad_argument(o, "otter_dma_chain", ram_text);
    const auto sent = o.device.send_list(std::span(ram, bytes / 4), head & 0xffffff, max_tags);
    if (!sent.walk) fail(&o, OTTER_OK, "otter_dma_chain: " + sent.walk.message());
    if (list == nullptr) return int{OTTER_OK};
    *list = {};
    list->end = static_cast<std::uint32_t>(sent.walk.end);
    list->bad_tag = sent.walk.bad_tag;
    list->linked_from = sent.walk.linked_from;
    list->nodes = sent.walk.nodes;
    list->words = sent.walk.words;
    list->tables = static_cast<std::uint32_t>(sent.tables.size());
    for (const auto& table : sent.tables) list->buckets = std::max(list->buckets, table.length);
    return int{OTTER_OK};
  });
}

int otter_lint(otter* gpu, const uint32_t* ram, size_t bytes, uint32_t head) {
  return guarded(gpu, "otter_lint", [&](otter& o) {
    o.lint.clear();
    if (!is_ram(ram, bytes)) return bad_argument(o, "otter_lint", ram_text);
    for (const auto& item : door::lint(std::span(ram, bytes / 4), head & 0xffffff))
      o.lint.push_back(item.kind + (item.at.empty() ? "" : " " + item.at) + ": " + item.text);
    return static_cast<int>(std::min<std::size_t>(o.lint.size(), INT32_MAX));
  });
}

const char* otter_lint_text(const otter* gpu, int n) {
  if (gpu == nullptr || n < 0 || static_cast<std::size_t>(n) >= gpu->lint.size()) return nullptr;
  return gpu->lint[static_cast<std::size_t>(n)].c_str();
}

uint16_t* otter_vram(otter* gpu) {
  if (gpu == nullptr) {
    fail(nullptr, OTTER_NO_HANDLE, "otter_vram: the handle is null");
    return nullptr;
  }
  return gpu->device.gpu().vram().pixels().data();
}

int otter_display(const otter* gpu, otter_area* area) {
  return guarded(gpu, "otter_display", [&](const otter& o) {
    if (area == nullptr) return bad_argument(o, "otter_display", "the area is null");
    const display::Area shown = display::area_of(o.device.gpu().display());
    *area = {shown.x, shown.y, shown.width, shown.height, shown.is_24_bit ? 1 : 0, shown.is_off ? 1 : 0};
    return int{OTTER_OK};
  });
}

int otter_picture(otter* gpu, uint8_t* rgba, size_t bytes, int* width, int* height) {
  return guarded(gpu, "otter_picture", [&](otter& o) {
    const base::Picture picture = o.device.picture();
    if (width != nullptr) *width = picture.width;
    if (height != nullptr) *height = picture.height;
    if (rgba == nullptr) return int{OTTER_OK};
    const std::size_t needed = picture.pixels.size() * sizeof(base::Rgba);
    if (bytes < needed) {
      return fail(
          &o, OTTER_BAD_ARGUMENT,
          "otter_picture: room for " + std::to_string(bytes) + " bytes, expected " + std::to_string(needed));
    }
    if (needed > 0) std::memcpy(rgba, picture.pixels.data(), needed);
    return int{OTTER_OK};
  });
}

size_t otter_save(otter* gpu, void* state, size_t size) {
  std::size_t needed = 0;
  guarded(gpu, "otter_save", [&](otter& o) {
    const auto bytes = o.device.save();
    if (state != nullptr && size >= bytes.size()) std::memcpy(state, bytes.data(), bytes.size());
    needed = bytes.size();
    return int{OTTER_OK};
  });
  return needed;
}

int otter_load(otter* gpu, const void* state, size_t size) {
  return guarded(gpu, "otter_load", [&](otter& o) {
    if (state == nullptr) return bad_argument(o, "otter_load", "the state is null");
    const auto error = o.device.load(std::span(static_cast<const std::byte*>(state), size));
    if (!error) return int{OTTER_OK};
    return fail(&o, OTTER_BAD_DATA,
                "otter_load: byte " + std::to_string(error->offset) + ": " + error->message);
  });
}

int otter_set(otter* gpu, const char* name, const char* value) {
  return guarded(gpu, "otter_set", [&](otter& o) {
    if (name == nullptr || value == nullptr)
      return bad_argument(o, "otter_set", "the knob or its value is null");
    const door::Knob* knob = door::find_knob(name);
    if (knob == nullptr) {
      return fail(&o, OTTER_UNKNOWN_KNOB,
                  std::string("otter_set: ") + name + ": expected a knob that a stream of words can honour");
    }
    scene::Knobs knobs = o.device.knobs();
    if (!door::takes(*knob, value) || !knob->info->set(knobs, value)) {
      return fail(&o, OTTER_BAD_VALUE,
                  std::string("otter_set: ") + name + " " + value + ": expected " + knob->values);
    }
    if (knobs.near_z >= knobs.far_z) {
      return fail(&o, OTTER_BAD_VALUE,
                  std::string("otter_set: ") + name + " " + value + ": expected near to be less than far");
    }
    if (const auto used = o.device.use(knobs); !used)
      return fail(&o, OTTER_BAD_VALUE, "otter_set: " + used.error().text);
    return int{OTTER_OK};
  });
}

int otter_get(const otter* gpu, const char* name, char* value, size_t size) {
  return guarded(gpu, "otter_get", [&](const otter& o) {
    if (name == nullptr || value == nullptr || size == 0)
      return bad_argument(o, "otter_get", "the knob or the room for its value is null");
    const door::Knob* knob = door::find_knob(name);
    if (knob == nullptr) {
      return fail(&o, OTTER_UNKNOWN_KNOB,
                  std::string("otter_get: ") + name + ": expected a knob that a stream of words can honour");
    }
    const std::string text = knob->info->get(o.device.knobs());
    const std::size_t copied = std::min(text.size(), size - 1);
    std::memcpy(value, text.data(), copied);
    value[copied] = '\0';
    return int{OTTER_OK};
  });
}

// The table's texts are string literals, which end with 0.
const char* otter_knob_name(int n) {
  return knob_text(n, [](const door::Knob& knob) { return knob.info->name.data(); });
}
const char* otter_knob_values(int n) {
  return knob_text(n, [](const door::Knob& knob) { return knob.values.c_str(); });
}
const char* otter_knob_help(int n) {
  return knob_text(n, [](const door::Knob& knob) { return knob.info->help.data(); });
}

int otter_vertex(otter* gpu, uint32_t xy, uint32_t z, uint32_t fractions) {
  return guarded(gpu, "otter_vertex", [&](otter& o) {
    o.device.vertex(xy, z, static_cast<std::uint8_t>(fractions & 0xff),
                    static_cast<std::uint8_t>(fractions >> 8 & 0xff));
    return int{OTTER_OK};
  });
}

int otter_depth_found(const otter* gpu, otter_depth* depth) {
  return guarded(gpu, "otter_depth_found", [&](const otter& o) {
    if (depth == nullptr) return bad_argument(o, "otter_depth_found", "the place for the numbers is null");
    const door::DepthShares& shares = o.device.depth();
    *depth = {shares.polygons, shares.with_depth, shares.partly, shares.doubtful};
    return int{OTTER_OK};
  });
}

int otter_record(otter* gpu, const char* path) {
  return guarded(gpu, "otter_record", [&](otter& o) {
    if (path != nullptr && *path == '\0') return bad_argument(o, "otter_record", "the path is empty");
    if (o.device.is_recording()) {
      if (const auto written = o.device.end_recording(); !written)
        return fail(&o, OTTER_NOT_WRITTEN, "otter_record: " + written.error().text);
    } else if (path == nullptr) {
      return fail(&o, OTTER_NOT_AVAILABLE, "otter_record: nothing is being recorded");
    }
    if (path != nullptr) o.device.begin_recording(path);
    return int{OTTER_OK};
  });
}

int otter_trace(otter* gpu, int mode) {
  return guarded(gpu, "otter_trace", [&](otter& o) {
    if (mode < OTTER_TRACE_OFF || mode > OTTER_TRACE_HISTORY)
      return bad_argument(o, "otter_trace", "expected OTTER_TRACE_OFF, _WRITERS or _HISTORY");
    o.device.trace(static_cast<door::TraceMode>(mode));
    return int{OTTER_OK};
  });
}

int otter_last_writer(otter* gpu, int x, int y, otter_draw* draw) {
  return guarded(gpu, "otter_last_writer", [&](otter& o) {
    if (draw == nullptr || !is_pixel(x, y))
      return bad_argument(o, "otter_last_writer",
                          "expected a pixel of VRAM, 0..1023 and 0..511, and a place for it");
    const gpu::Trace* trace = o.device.trace();
    if (trace == nullptr)
      return fail(&o, OTTER_NOT_AVAILABLE, std::string("otter_last_writer: ") + not_traced);
    const std::uint32_t writer = trace->last_writer[gpu::Vram::offset(x, y)];
    if (writer == 0 || writer > trace->draws.size())
      return fail(&o, OTTER_NOT_AVAILABLE, "otter_last_writer: nobody wrote the pixel since the trace began");
    *draw = draw_of(trace->draws[writer - 1]);
    return int{OTTER_OK};
  });
}

int otter_history(otter* gpu, int x, int y, otter_write* writes, size_t max) {
  return guarded(gpu, "otter_history", [&](otter& o) {
    if (!is_pixel(x, y))
      return bad_argument(o, "otter_history", "expected a pixel of VRAM, 0..1023 and 0..511");
    const gpu::Trace* trace = o.device.trace();
    if (trace == nullptr || !trace->keep_history) {
      return fail(&o, OTTER_NOT_AVAILABLE,
                  "otter_history: no history is kept: otter_trace(gpu, OTTER_TRACE_HISTORY) begins it");
    }
    const auto pixel = static_cast<std::uint32_t>(gpu::Vram::offset(x, y));
    std::size_t count = 0;
    for (const gpu::Event& event : trace->history) {
      if (event.pixel != pixel) continue;
      if (writes != nullptr && count < max) {
        writes[count] = {event.draw,
                         event.before,
                         event.after,
                         event.fragment,
                         static_cast<std::uint8_t>(event.blended),
                         static_cast<std::uint8_t>(event.rejected)};
      }
      ++count;
    }
    return static_cast<int>(std::min<std::size_t>(count, INT32_MAX));
  });
}

int otter_draw_at(otter* gpu, uint32_t n, otter_draw* draw) {
  return guarded(gpu, "otter_draw_at", [&](otter& o) {
    if (draw == nullptr) return bad_argument(o, "otter_draw_at", "the place for the draw is null");
    const gpu::Trace* trace = o.device.trace();
    if (trace == nullptr) return fail(&o, OTTER_NOT_AVAILABLE, std::string("otter_draw_at: ") + not_traced);
    if (n >= trace->draws.size()) {
      return fail(&o, OTTER_NOT_AVAILABLE,
                  "otter_draw_at: draw " + std::to_string(n) + " of " + std::to_string(trace->draws.size()));
    }
    *draw = draw_of(trace->draws[n]);
    return int{OTTER_OK};
  });
}

int otter_pixels(otter* gpu, otter_pixel_counts* counts) {
  return guarded(gpu, "otter_pixels", [&](otter& o) {
    if (counts == nullptr) return bad_argument(o, "otter_pixels", "the place for the counts is null");
    const gpu::PixelCounts taken = o.device.take_pixel_counts();
    std::ranges::copy(taken.polygons, counts->polygons);
    std::ranges::copy(taken.rectangles, counts->rectangles);
    std::ranges::copy(taken.lines, counts->lines);
    counts->fills = taken.fills;
    counts->copies = taken.copies;
    counts->uploads = taken.uploads;
    counts->downloads = taken.downloads;
    return int{OTTER_OK};
  });
}

}  // extern "C"
