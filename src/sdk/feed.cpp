#include "sdk/feed.h"

#include <algorithm>
#include <array>

#include "dump/bucket_note.h"
#include "gpu/canvas/canvas.h"
#include "gpu/depth.h"
#include "ot/gp0.h"
#include "ot/gp1.h"

namespace sdk {

namespace gp0 = ot::gp0;
using dump::PacketType;

void Feed::record(bool with_depth) {
  constexpr std::uint32_t second_chip = 2;
  dump_.emplace();
  records_depth_ = with_depth;
  dump_->add(PacketType::gpu_version, std::span(&second_chip, 1));
  dump_->add(PacketType::trace_begin);
}

const std::optional<dump::Dump>& Feed::recording() {
  flush();
  return dump_;
}

void Feed::flush() {
  if (dump_ && !unrecorded_.empty()) dump_->add(PacketType::port0, unrecorded_);
  unrecorded_.clear();
}

void Feed::gp1(std::uint32_t word) {
  flush();
  if (dump_) dump_->add(PacketType::port1, std::span(&word, 1));
  if (keeps_) keep(std::span(&word, 1), true);
  if (ot::gp1::aborts_command(word)) stream_.abort();
  gpu_.gp1(word);
}

void Feed::send(std::span<const std::uint32_t> words, bool is_depth) {
  if (dump_ && (!is_depth || records_depth_))
    unrecorded_.insert(unrecorded_.end(), words.begin(), words.end());
  if (keeps_ && !words.empty()) keep(words, false);
  gpu_.gp0(words);
}

void Feed::note_bucket() {
  const dump::BucketNote note{hook_.length == 0 ? 0 : hook_.bucket, hook_.length};
  if (note == noted_) return;
  flush();
  dump_->add_text(PacketType::comment, dump::to_text(note));
  noted_ = note;
}

void Feed::keep(std::span<const std::uint32_t> words, bool is_control) {
  const bool goes_on = !kept_.empty() && !is_control && !kept_.back().is_control &&
                       kept_.back().address == packet_ && kept_.back().bucket == hook_.bucket &&
                       kept_.back().table == hook_.address;
  if (!goes_on) {
    kept_.push_back({is_control,
                     hook_.bucket,
                     hook_.address,
                     hook_.length,
                     packet_,
                     packet_ == 0 ? nullptr : lint_.site_of(packet_),
                     {}});
  }
  auto& all = kept_.back().words;
  all.insert(all.end(), words.begin(), words.end());
}

void Feed::gp0(std::span<const std::uint32_t> words) { packet(words, 0); }

void Feed::packet(std::span<const std::uint32_t> words, std::uint32_t address) {
  packet_ = address == 0 ? 0 : address - 4;
  if (dump_) note_bucket();
  if (targets_.depth_of_bucket) {
    gpu_.set_default_depth(
        hook_.length == 0 ? std::nullopt : std::optional(gpu::depth_of_bucket(hook_.bucket, hook_.length)));
  }
  std::size_t begin = 0, at = 0;  // words[begin..at) belong to a command that is not whole here
  while (at < words.size()) {
    const auto length = gp0::command_words(words[at]);
    const auto kind = gp0::command_of(words[at]);
    const bool is_whole = !stream_.is_open() && at + length <= words.size() && kind != gp0::Command::upload &&
                          kind != gp0::Command::polyline;
    if (is_whole) {
      send(words.subspan(begin, at - begin));
      command(words.subspan(at, length), address + 4 * static_cast<std::uint32_t>(at));
      begin = at += length;
      continue;
    }
    if (!stream_.is_open() && gp0::is_drawing(kind)) place_canvas();
    const auto pixels = stream_.skip_pixels(words.size() - at);
    if (pixels == 0) stream_.take(words[at]);
    at += std::max<std::size_t>(pixels, 1);
  }
  send(words.subspan(begin));
}

void Feed::command(std::span<const std::uint32_t> words, std::uint32_t address) {
  const auto kind = gp0::command_of(words[0]);
  if (gp0::is_drawing(kind)) {
    place_canvas();
    frame_is_open_ = true;
  }
  if (kind == gp0::Command::polygon || kind == gp0::Command::rectangle) check_texture(words);
  if (kind == gp0::Command::polygon && depth_.is_on()) {
    const auto found = depth_.find(words, address);
    if (found && targets_.annotate) {
      std::array<std::uint32_t, gp0::annotation::max_words> depth{};
      const auto count = ot::encode(*found, depth);
      send(std::span(depth).first(count), true);
    }
  }
  send(words);
}

void Feed::check_texture(std::span<const std::uint32_t> words) {
  namespace texcoord = gp0::texcoord;
  std::uint32_t u = 0;
  if (gp0::command_of(words[0]) == gp0::Command::rectangle) {
    if (gp0::rectangle::IsTextured::get(words[0]) == 0) return;
    constexpr std::array<std::uint32_t, 4> sizes{0, 1, 8, 16};
    const auto size = gp0::rectangle::Size::get(words[0]);
    const std::uint32_t width = size == 0 ? gp0::rectangle::Width::get(words[3]) : sizes[size];
    u = std::min<std::uint32_t>(texcoord::U::get(words[2]) + width, 256);
    lint_.textured(gpu_.state().draw_mode, u == 0 ? 0 : u - 1);
    return;
  }
  if (gp0::polygon::IsTextured::get(words[0]) == 0) return;
  const std::size_t step = 2 + gp0::polygon::IsGouraud::get(words[0]);
  for (std::size_t v = 0; v < gp0::polygon::vertices(words[0]); ++v) {
    u = std::max(u, texcoord::U::get(words[2 + v * step]));
  }
  lint_.textured(texcoord::Texpage::get(words[2 + step]), u);
}

void Feed::place_canvas() {
  if (!targets_.canvas || canvas_is_open_) return;
  const auto corner = machine::place_canvas(gpu_, *targets_.canvas);
  if (!corner) {
    canvas_fault_ = corner.error();
    targets_.canvas.reset();
    return;
  }
  if (!*corner) return;
  corner_ = *corner;
  canvas_is_open_ = true;
}

void Feed::read(std::span<std::uint32_t> words) {
  std::ranges::generate(words, [this] { return gpu_.read(); });
  flush();
  const auto count = static_cast<std::uint32_t>(words.size());
  if (dump_) dump_->add(PacketType::discard, std::span(&count, 1));
}

void Feed::end_frame() {
  const bool has_depth = gpu_.depth_plane() != nullptr;
  if (canvas_is_open_ || (has_depth && frame_is_open_))
    without_depth_ += gpu_.end_frame().polygons_without_depth;
  if (has_depth && frame_is_open_) gpu_.begin_frame();
  canvas_is_open_ = false;
  frame_is_open_ = false;
}

void Feed::next_field() {
  end_frame();
  flush();
  if (dump_) dump_->add(PacketType::vsync);
  gpu_.next_field();
}

}  // namespace sdk
