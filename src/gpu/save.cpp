// Saved states. A head of 8 words (magic, version, bytes in all), then the numbers in the order in which the
// functions below name them, then blocks: palettes, VRAM, depth keys.

#include <array>
#include <utility>

#include "gpu/canvas/canvas.h"
#include "gpu/depth_queue.h"
#include "gpu/gpu.h"
#include "gpu/raster.h"
#include "gpu/state_bytes.h"
#include "ot/gp0.h"

namespace gpu {

namespace gp0 = ot::gp0;

namespace {

constexpr std::array<std::uint32_t, 4> magic{0x4554544f, 0x50472d52, 0x54532d55,
                                             0x00455441};  // OTTER-GPU-STATE
constexpr std::uint32_t version = 2;
constexpr std::size_t head_bytes = 8 * 4, size_at = 5 * 4;
constexpr std::size_t vram_bytes = Vram::size * sizeof(std::uint16_t);
constexpr std::size_t keys_bytes = Vram::size * sizeof(std::uint32_t);

void fields(auto& a, auto& display) requires requires { display.vertical_range; }
{
  a.number("the display mode", display.mode, 0, 0xff);
  a.number("the start of the display", display.start, 0, 0x7ffff);
  a.number("the horizontal range", display.horizontal_range, 0, 0xffffff);
  a.number("the vertical range", display.vertical_range, 0, 0xfffff);
  a.number("the display's switch", display.is_off, 0, 1);
  a.number("the field", display.odd_field, 0, 1);
  a.number("the field's number", display.odd_frame, 0, 1);
}

void fields(auto& a, auto& state) requires requires { state.texture_window; }
{
  a.number("the draw mode", state.draw_mode, 0, 0x3fff);
  a.number("the texture window", state.texture_window, 0, 0xfffff);
  a.number("the drawing area", state.area_top_left, 0, 0xfffff);
  a.number("the drawing area", state.area_bottom_right, 0, 0xfffff);
  a.number("the drawing offset", state.offset, 0, 0x3fffff);
  a.number("the mask bits", state.mask, 0, 3);
  a.number("the skipped rows", state.skipped_rows, 0, 2);
}

void fields(auto& a, auto& vertex) requires requires { vertex.fx; }
{
  a.number("x of a vertex", vertex.x, -2048, 2047);
  a.number("y of a vertex", vertex.y, -2048, 2047);
  for (auto* byte : {&vertex.r, &vertex.g, &vertex.b, &vertex.u, &vertex.v, &vertex.fx, &vertex.fy})
    a.number("a colour, texture coordinate or fraction", *byte, 0, 255);
  for (auto* rest : {&vertex.du, &vertex.dv}) a.number("the rest of a texture coordinate", *rest, -8, 7);
  a.word(vertex.z);
}

void fields(auto& a, auto& primitive) requires requires { primitive.vertex_count; }
{
  a.number("the kind of a primitive", primitive.kind, 0, kind_count - 1);
  a.word(primitive.command);
  a.word(primitive.command_number);
  a.word(primitive.bucket);
  fields(a, primitive.state);
  a.number("a palette's name", primitive.clut, 0, 0xffff);
  a.number("the number of vertices", primitive.vertex_count, 0, 4);
  a.number("the mark of depth", primitive.has_depth, 0, 1);
  a.number("the mark of fractions", primitive.has_fractions, 0, 1);
  a.number("the mark of rests", primitive.has_texel_rests, 0, 1);
  a.number("a width", primitive.width, 0, Vram::width);
  a.number("a height", primitive.height, 0, Vram::height);
  for (auto& vertex : primitive.vertices) fields(a, vertex);
}

void fields(auto& a, auto& transfer) requires requires { transfer.column; }
{
  a.number("x of a transfer", transfer.x, 0, Vram::width - 1);
  a.number("y of a transfer", transfer.y, 0, Vram::height - 1);
  a.number("the width of a transfer", transfer.width, 0, Vram::width);
  a.number("the height of a transfer", transfer.height, 0, Vram::height);
  a.number("the column of a transfer", transfer.column, 0, transfer.width == 0 ? 0 : transfer.width - 1);
  a.number("the row of a transfer", transfer.row, 0, transfer.height);
}

void fields(auto& a, auto& options) requires requires { options.near_z; }
{
  a.number("the depth format", options.format, 0, 3);
  a.number("the depth mapping", options.mapping, 0, 1);
  a.number("the depth test", options.test, 0, 1);
  a.number("the direction of depth", options.reversed, 0, 1);
  a.real(options.near_z);
  a.real(options.far_z);
}

/// Entries and palettes one behind the other.
void fields(StateWriter& a, const DepthQueue& queue) {
  DepthQueue::visit(queue, [&](const auto& entries, const auto& palettes, std::uint32_t last_load) {
    a.word(last_load);
    a.word(static_cast<std::uint32_t>(palettes.size()));
    for (const auto& palette : palettes) a.block(palette);
    a.word(static_cast<std::uint32_t>(entries.size()));
    for (const DepthQueue::Entry& entry : entries) {
      fields(a, entry.primitive);
      a.word(entry.palette);
      a.word(entry.farthest);
    }
  });
}

void fields(StateReader& a, DepthQueue& queue) {
  DepthQueue::visit(queue, [&](auto& entries, auto& palettes, std::uint32_t& last_load) {
    a.word(last_load);
    std::uint32_t count = 0;
    a.count("the number of palettes", count, sizeof(DepthQueue::Palette));
    palettes.resize(count);
    for (auto& palette : palettes) a.block(palette);
    constexpr std::size_t least_bytes = 4 * (4 + 7 + 7 + 4 * 12 + 2);
    a.count("the number of queued polygons", count, least_bytes);
    entries.resize(count);
    for (DepthQueue::Entry& entry : entries) {
      const std::size_t at = a.position();
      fields(a, entry.primitive);
      a.word(entry.palette);
      a.word(entry.farthest);
      const Primitive& p = entry.primitive;
      if (p.kind != Kind::polygon || gp0::command_of(p.command) != gp0::Command::polygon ||
          p.vertex_count != gp0::polygon::vertices(p.command) || entry.palette >= palettes.size())
        a.fail(at, "a queued primitive is not a polygon with a palette");
    }
  });
}

}  // namespace

struct Gpu::Saved {
  /// What a state has beside the numbers of its GPU.
  std::uint32_t has_depth = 0;
  DepthOptions options;
  std::span<const std::byte> vram, keys;

  /// A word that counts or that nobody will look at, which is saved as 0.
  static void word_if(bool counts, StateWriter& a, std::uint32_t word) { a.word(counts ? word : 0); }
  static void word_if(bool, StateReader& a, std::uint32_t& word) { a.word(word); }

  /// Everything but the blocks at the end, and the queue.
  static void numbers(auto& a, auto& gpu) {
    fields(a, gpu.display_);
    fields(a, gpu.current_);
    a.number("the annotation words seen", gpu.annotation_.seen, 0, 0x3ff);
    for (std::size_t n = 0; n < gpu.annotation_.words.size(); ++n)
      word_if((gpu.annotation_.seen >> n & 1) != 0, a, gpu.annotation_.words[n]);
    a.number("the words of an open command", gpu.gathered_count_, 0,
             static_cast<std::int64_t>(gpu.gathered_.size()) - 1);
    for (std::size_t n = 0; n < gpu.gathered_.size(); ++n)
      word_if(n < gpu.gathered_count_, a, gpu.gathered_[n]);
    a.number("the mark of an open polyline", gpu.polyline_open_, 0, 1);
    a.word(gpu.polyline_colour_);
    a.number("the mark of a waiting colour", gpu.polyline_has_colour_, 0, 1);
    fields(a, gpu.upload_);
    fields(a, gpu.download_);
    a.number("the permission to disable textures", gpu.texture_disable_allowed_, 0, 1);
    a.number("the interrupt", gpu.irq_, 0, 1);
    a.number("the DMA direction", gpu.dma_direction_, 0, 3);
    a.word(gpu.latch_);
    a.word(gpu.next_command_);
    a.word(gpu.frame_.polygons_without_depth);
    a.word(gpu.frame_.first_without_depth);
    a.word(gpu.frame_.queued);
    ClutCache::visit(gpu.clut_, [&](auto& entries, auto& loads, auto& tag, auto& loaded) {
      a.word(loads);
      a.word(tag);
      a.number("the format of the palette", loaded, 0, 2);
      a.block(entries);
    });
  }

  /// What is open must be what the last command opened.
  static void check_open_command(StateReader& a, const Gpu& gpu) {
    const Primitive& p = gpu.current_;
    const Vertex& corner = p.vertices[0];
    const Transfer& upload = gpu.upload_;
    if (gpu.gathered_count_ != 0 && gpu.gathered_count_ >= gp0::command_words(gpu.gathered_[0]))
      a.fail(head_bytes, "the open command is whole");
    if (gpu.polyline_open_ &&
        (p.kind != Kind::line || p.vertex_count != 2 || gp0::command_of(p.command) != gp0::Command::polyline))
      a.fail(head_bytes, "the open polyline is none");
    if (upload.is_active() && (p.kind != Kind::upload || upload.width == 0 || corner.x != upload.x ||
                               corner.y != upload.y || p.width != upload.width || p.height != upload.height))
      a.fail(head_bytes, "the open upload is none");
    if (gpu.download_.is_active() && gpu.download_.width == 0)
      a.fail(head_bytes, "the open download is empty");
  }

  /// The numbers and the queue go to `gpu`; the blocks stay where they are, a view.
  static Saved read(StateReader& a, Gpu& gpu) {
    Saved saved;
    numbers(a, gpu);
    check_open_command(a, gpu);
    a.number("the mark of a depth plane", saved.has_depth, 0, 1);
    if (saved.has_depth != 0) fields(a, saved.options);
    gpu.queue_ = std::make_unique<DepthQueue>();
    fields(a, *gpu.queue_);
    saved.vram = a.take(vram_bytes);
    if (saved.has_depth != 0) saved.keys = a.take(keys_bytes);
    return saved;
  }

  void put_pixels(Gpu& gpu) const {
    StateReader(vram).block(gpu.vram_.pixels());
    if (!gpu.depth_) return;
    gpu.depth_->clear();
    if (has_depth == 0 || gpu.depth_->options() != options) return;
    gpu.depth_->touch_all();
    StateReader a(keys);
    for (int y = 0; y < Vram::height; ++y)
      a.block(std::span(gpu.depth_->keys() + DepthPlane::offset(0, y), std::size_t{Vram::width}));
  }
};

std::vector<std::byte> Gpu::save() const {
  StateWriter a;
  a.reserve(head_bytes + vram_bytes + (depth_ ? keys_bytes : 0) + std::size_t{64} * 1024);
  for (const std::uint32_t word : magic) a.word(word);
  a.word(version);
  for (int n = 0; n < 3; ++n) a.word(0);  // the first: the size, below
  Saved::numbers(a, *this);
  a.word(depth_ ? 1 : 0);
  if (depth_) fields(a, depth_->options());
  fields(a, queue_ ? *queue_ : DepthQueue());
  a.block(vram_.pixels());
  for (int y = 0; depth_ && y < Vram::height; ++y)
    a.block(
        std::span<const std::uint32_t>(depth_->keys() + DepthPlane::offset(0, y), std::size_t{Vram::width}));
  a.put_word_at(size_at, static_cast<std::uint32_t>(a.size()));
  return a.take();
}

std::optional<StateError> Gpu::load(std::span<const std::byte> bytes) {
  StateReader a(bytes);
  for (const std::uint32_t expected : magic) {
    std::uint32_t word = 0;
    a.word(word);
    if (word != expected) return StateError{"not a saved state: expected OTTER-GPU-STATE", 0};
  }
  std::uint32_t its_version = 0, size = 0, unused = 0;
  a.word(its_version);
  a.word(size);
  a.word(unused);
  a.word(unused);
  if (!a.has_failed() && its_version != version)
    a.fail(magic.size() * 4,
           "version " + std::to_string(its_version) + ", expected " + std::to_string(version));
  if (!a.has_failed() && size != bytes.size())
    a.fail(bytes.size(), std::to_string(bytes.size()) + " bytes, expected " + std::to_string(size));
  // Into another GPU first: a state that turns out to be damaged changes nothing.
  Gpu next;
  Saved::read(a, next);
  if (!a.has_failed() && a.position() != bytes.size()) a.fail(a.position(), "expected the end of the state");
  if (a.has_failed()) return StateError{a.message(), a.offset()};

  StateReader again(bytes);
  (void)again.take(head_bytes);
  const Saved saved = Saved::read(again, *this);
  upload_.draw = no_draw;
  saved.put_pixels(*this);
  update_skipped_rows();
  note_queue();
  if (canvas_ != nullptr) {
    Primitive everything;
    everything.kind = Kind::upload;
    everything.width = Vram::width;
    everything.height = Vram::height;
    canvas_->transfer(everything, vram_);
  }
  if (!depth_ && !(canvas_ != nullptr && canvas_->options().depth)) draw_queue_in_order();
  return std::nullopt;
}

}  // namespace gpu
