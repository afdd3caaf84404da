// One function per kind of drawing command: words to a decoded primitive, and on to the rasterizer.

#include <algorithm>
#include <cstring>

#include "gpu/canvas/canvas.h"
#include "gpu/depth_queue.h"
#include "gpu/gpu.h"
#include "gpu/raster.h"
#include "ot/gp0.h"

namespace gpu {

namespace {

void put_colour(Vertex& vertex, std::uint32_t word) {
  vertex.r = static_cast<std::uint8_t>(gp0::colour::R::get(word));
  vertex.g = static_cast<std::uint8_t>(gp0::colour::G::get(word));
  vertex.b = static_cast<std::uint8_t>(gp0::colour::B::get(word));
}

void put_position(Vertex& vertex, std::uint32_t word, const DrawState& state) {
  vertex.x = gp0::vertex::X::get_signed(word) + state.offset_x();
  vertex.y = gp0::vertex::Y::get_signed(word) + state.offset_y();
}

void put_texcoord(Vertex& vertex, std::uint32_t word) {
  vertex.u = static_cast<std::uint8_t>(gp0::texcoord::U::get(word));
  vertex.v = static_cast<std::uint8_t>(gp0::texcoord::V::get(word));
}

void put_corner(Vertex& vertex, std::uint32_t word) {
  vertex.x = static_cast<std::int32_t>(gp0::transfer::X::get(word));
  vertex.y = static_cast<std::int32_t>(gp0::transfer::Y::get(word));
}

}  // namespace

void Gpu::polygon(const std::uint32_t* words) {
  Primitive& p = current_;
  p.kind = Kind::polygon;
  p.command = words[0];
  p.vertex_count = static_cast<std::uint8_t>(gp0::polygon::vertices(words[0]));
  // Per vertex: [colour,] position [, texcoord]; vertex 0 has its colour in the command word.
  const std::size_t coloured = p.is_gouraud() ? 1 : 0, textured = p.is_textured() ? 1 : 0;
  const std::size_t stride = 1 + coloured + textured;
  for (std::size_t v = 0; v < p.vertex_count; ++v) {
    const std::uint32_t* const of_vertex = words + 1 + v * stride;  // the position
    put_position(p.vertices[v], of_vertex[0], p.state);
    put_colour(p.vertices[v], coloured != 0 ? of_vertex[-1] : words[0]);
    if (textured != 0) put_texcoord(p.vertices[v], of_vertex[1]);
  }
  if (textured != 0) {
    p.clut = static_cast<std::uint16_t>(gp0::texcoord::Clut::get(words[2]));
    use_texture_page(gp0::texcoord::Texpage::get(words[2 + stride]));
    clut_.use(vram_, p.clut, p.state.texel_format());
  }
  take_depth();
  begin_command();
  note(Kind::polygon);
  if (tests_depth()) {
    draw_with_depth();
  } else {
    draw_either(surface(), p, Pass::console);
  }
}

/// Whether the target of the polygon just decoded has a z-buffer.
bool Gpu::tests_depth() const {
  if (canvas_ != nullptr && canvas_->covers(current_.state)) return canvas_->options().depth.has_value();
  return depth_ != nullptr;
}

/// On the canvas if the drawing area touches it, else in VRAM.
void Gpu::draw_either(const Surface& target, const Primitive& polygon, Pass pass) {
  if (canvas_ != nullptr && draw_on_canvas(target, polygon, pass)) return;
  draw_polygon(target, polygon, pass);
}

/// Of an E1h word or a page halfword what may be stored.
std::uint32_t Gpu::allowed_mode(std::uint32_t word) const {
  return texture_disable_allowed_ ? word : word & ~gp0::draw_mode::TextureDisable::mask;
}

/// The page halfword of a textured polygon stays in force. [docs/hardware.md#draw-mode]
void Gpu::use_texture_page(std::uint32_t halfword) {
  std::uint32_t& mode = current_.state.draw_mode;
  mode = (mode & ~gp0::draw_mode::page_bits) | (allowed_mode(halfword) & gp0::draw_mode::page_bits);
}

void Gpu::rectangle(const std::uint32_t* words) {
  Primitive& p = current_;
  p.kind = Kind::rectangle;
  p.command = words[0];
  p.vertex_count = 1;
  Vertex& corner = p.vertices[0];
  put_colour(corner, words[0]);
  put_position(corner, words[1], p.state);
  // Rectangles wrap once more after the offset.
  corner.x = sign_extend_11(static_cast<std::uint32_t>(corner.x));
  corner.y = sign_extend_11(static_cast<std::uint32_t>(corner.y));
  const std::uint32_t* at = words + 2;
  if (p.is_textured()) {
    put_texcoord(corner, *at);
    p.clut = static_cast<std::uint16_t>(gp0::texcoord::Clut::get(*at++));
    clut_.use(vram_, p.clut, p.state.texel_format());
  }
  constexpr int sizes[] = {0, 1, 8, 16};
  const auto size = gp0::rectangle::Size::get(words[0]);
  p.width = size != 0 ? sizes[size] : static_cast<int>(gp0::rectangle::Width::get(*at));
  p.height = size != 0 ? sizes[size] : static_cast<int>(gp0::rectangle::Height::get(*at));
  begin_command();
  note(Kind::rectangle);
  if (canvas_ != nullptr && draw_on_canvas(surface(), p, Pass::console)) return;
  draw_rectangle(surface(), p);
}

void Gpu::line(const std::uint32_t* words) {
  Primitive& p = current_;
  p.kind = Kind::line;
  p.command = words[0];
  p.vertex_count = 2;
  const bool is_gouraud = p.is_gouraud();
  put_colour(p.vertices[0], words[0]);
  put_position(p.vertices[0], words[1], p.state);
  put_colour(p.vertices[1], words[is_gouraud ? 2 : 0]);
  put_position(p.vertices[1], words[is_gouraud ? 3 : 2], p.state);
  polyline_open_ = gp0::command_of(words[0]) == gp0::Command::polyline;
  polyline_has_colour_ = false;
  begin_command();
  line_segment();
}

/// Vertices of an open polyline. Only the first word of a vertex can be the terminator: [colour] vertex.
const std::uint32_t* Gpu::continue_polyline(const std::uint32_t* at, const std::uint32_t* end) {
  Primitive& p = current_;
  const bool is_gouraud = p.is_gouraud();
  while (at != end) {
    const std::uint32_t word = *at++;
    if (!polyline_has_colour_) {
      if (gp0::line::is_terminator(word)) {
        polyline_open_ = false;
        return at;
      }
      if (is_gouraud) {
        polyline_colour_ = word;
        polyline_has_colour_ = true;
        continue;
      }
      polyline_colour_ = p.command;
    }
    polyline_has_colour_ = false;
    p.vertices[0] = p.vertices[1];
    put_colour(p.vertices[1], polyline_colour_);
    put_position(p.vertices[1], word, p.state);
    line_segment();
  }
  return at;
}

void Gpu::line_segment() {
  note(Kind::line);
  if (canvas_ != nullptr && draw_on_canvas(surface(), current_, Pass::console)) return;
  draw_line(surface(), current_);
}

void Gpu::fill(const std::uint32_t* words) {
  draw_queue();
  Primitive& p = current_;
  p.kind = Kind::fill;
  p.command = words[0];
  p.vertex_count = 1;
  put_corner(p.vertices[0], words[1]);
  p.vertices[0].x = static_cast<int>(gp0::fill::x(words[1]));
  p.width = static_cast<int>(gp0::fill::width(words[2]));
  p.height = static_cast<int>(gp0::fill::Height::get(words[2]));
  begin_command();
  note(Kind::fill);
  fill_rectangle(surface(), p);
  if (canvas_ != nullptr) transfer_to_canvas();
}

void Gpu::copy(const std::uint32_t* words) {
  draw_queue();
  Primitive& p = current_;
  p.kind = Kind::copy;
  p.command = words[0];
  p.vertex_count = 2;
  put_corner(p.vertices[0], words[2]);
  put_corner(p.vertices[1], words[1]);
  p.width = static_cast<int>(gp0::transfer::width(words[3]));
  p.height = static_cast<int>(gp0::transfer::height(words[3]));
  begin_command();
  note(Kind::copy);
  copy_rectangle(surface(), p);
  if (canvas_ != nullptr) transfer_to_canvas();
}

void Gpu::begin_upload(const std::uint32_t* words) {
  draw_queue();
  Primitive& p = current_;
  p.kind = Kind::upload;
  p.command = words[0];
  p.vertex_count = 1;
  put_corner(p.vertices[0], words[1]);
  p.width = static_cast<int>(gp0::transfer::width(words[2]));
  p.height = static_cast<int>(gp0::transfer::height(words[2]));
  begin_command();
  note(Kind::upload);
  upload_ = {.x = p.vertices[0].x,
             .y = p.vertices[0].y,
             .width = p.width,
             .height = p.height,
             .draw = current_draw_};
}

void Gpu::begin_download(const std::uint32_t* words) {
  Vertex corner;
  put_corner(corner, words[1]);
  download_ = {.x = corner.x,
               .y = corner.y,
               .width = static_cast<int>(gp0::transfer::width(words[2])),
               .height = static_cast<int>(gp0::transfer::height(words[2]))};
  if (pixel_counts_ != nullptr)
    pixel_counts_->downloads += static_cast<std::uint64_t>(download_.pixels_left());
}

/// The words are a stream of halfwords; only the last of an odd number is not a pixel.
const std::uint32_t* Gpu::upload(const std::uint32_t* at, const std::uint32_t* end) {
  // A frame, and its trace, may begin anew while an upload is open: the rest is then a draw of the new one.
  follow_trace();
  if (trace_ != nullptr && upload_.draw == no_draw) {
    current_.bucket = trace_->bucket;
    upload_.draw = current_draw_ = trace_->enter(current_);
  }
  Surface target = surface();
  target.draw = upload_.draw;
  const std::int64_t pixels = std::min<std::int64_t>(upload_.pixels_left(), 2 * (end - at));
  const auto* bytes = reinterpret_cast<const unsigned char*>(at);
  PixelRow row;
  for (std::int64_t done = 0; done < pixels;) {
    const int count = static_cast<int>(std::min<std::int64_t>(pixels - done, upload_.width - upload_.column));
    std::memcpy(row.data(), bytes + 2 * done, 2 * static_cast<std::size_t>(count));
    store_row(target, current_.state, upload_.x + upload_.column, upload_.y + upload_.row, row, count);
    upload_.advance(count);
    done += count;
  }
  if (canvas_ != nullptr && !upload_.is_active()) transfer_to_canvas();
  return at + (pixels + 1) / 2;
}

/// Hands the annotation over to the polygon that follows it. What did not come is 0.
void Gpu::take_depth() {
  Primitive& p = current_;
  p.has_depth = p.has_fractions = p.has_texel_rests = false;
  if (const std::uint32_t seen = annotation_.seen; seen != 0) {
    namespace annotation = gp0::annotation;
    constexpr std::uint32_t low = annotation::depth_low - annotation::depth_high,
                            fraction = annotation::fraction - annotation::depth_high;
    const auto& words = annotation_.words;
    const auto word = [&](std::size_t n) { return (seen >> n & 1) != 0 ? words[n] : 0; };
    const std::uint32_t all = (1U << p.vertex_count) - 1;
    p.has_depth = (seen >> low & all) == all;
    p.has_fractions = (seen >> fraction & 15) != 0;
    const std::uint32_t high = word(0), high3 = word(9);
    const std::array<std::uint32_t, 4> highs{annotation::High0::get(high), annotation::High1::get(high),
                                             annotation::High2::get(high), annotation::High0::get(high3)};
    for (std::size_t v = 0; v < p.vertex_count; ++v) {
      Vertex& vertex = p.vertices[v];
      vertex.z = highs[v] << 24 | annotation::DepthLow::get(word(low + v));
      const std::uint32_t fractions = word(fraction + v);
      vertex.fx = static_cast<std::uint8_t>(annotation::FractionX::get(fractions));
      vertex.fy = static_cast<std::uint8_t>(annotation::FractionY::get(fractions));
      vertex.du = static_cast<std::int8_t>(annotation::TexelRestU::get_signed(fractions));
      vertex.dv = static_cast<std::int8_t>(annotation::TexelRestV::get_signed(fractions));
      p.has_texel_rests = p.has_texel_rests || vertex.du != 0 || vertex.dv != 0;
    }
    annotation_.seen = 0;
  }
  if (!p.has_depth && default_depth_) {
    p.has_depth = true;
    for (Vertex& vertex : p.vertices) vertex.z = *default_depth_;
  }
}

void Gpu::begin_command() { current_.command_number = next_command_ - 1; }

void Gpu::note(Kind kind) {
  ++counters_.primitives[static_cast<std::size_t>(kind)];
  if (!is_noted_) return;
  if (pixel_counts_ != nullptr) pixel_counts_->add(current_);
  follow_trace();
  if (trace_ == nullptr) return;
  current_.bucket = trace_->bucket;
  current_draw_ = trace_->enter(current_);
}

/// Draw numbers kept from another trace, or from before it began anew, are forgotten.
void Gpu::follow_trace() {
  const std::uint64_t beginning = trace_ == nullptr ? 0 : trace_->beginnings();
  if (trace_ == nullptr || beginning == trace_beginning_) return;
  trace_beginning_ = beginning;
  current_draw_ = upload_.draw = no_draw;
  if (queue_) queue_->forget_draws();
}

Surface Gpu::surface() {
  return {.vram = vram_,
          .clut = clut_.entries(),
          .counters = counters_,
          .depth = depth_.get(),
          .trace = trace_,
          .draw = current_draw_,
          .limits = limits_ ? &*limits_ : nullptr};
}

}  // namespace gpu
