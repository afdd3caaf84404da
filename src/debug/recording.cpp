#include "debug/recording.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "dump/bucket_note.h"
#include "ot/gp1.h"
#include "ot/packet.h"
#include "ot/walker.h"

namespace debug {
namespace {

/// A list does not say what is displayed: 320 x 240 from 0,0, or the drawing area that it ends with.
void show_what_is_drawn(gpu::Gpu& gpu, std::span<const std::uint32_t> words) {
  using ot::gp1::Command, ot::gp1::make;
  gpu::Gpu drawn;
  drawn.gp0(words);
  const gpu::DrawState& state = drawn.state();
  int x = 0, y = 0, width = 320, height = 240;
  if (state.area_bottom_right != 0 && state.right() - state.left() < 640) {
    x = state.left();
    y = state.top();
    width = state.right() - x + 1;
    height = std::max(state.bottom() - y + 1, 1);
  }
  // Never interlaced: the rows of a field would be left out.
  gpu.gp1(ot::gp1::display_off::make(false));
  gpu.gp1(make(Command::display_mode, ot::gp1::display_mode::put_width(width)));
  gpu.gp1(ot::gp1::display_start::make(x, y));
  gpu.gp1(ot::gp1::vertical_range::make(0x10, 0x10 + static_cast<std::uint32_t>(std::min(height, 512))));
}

}  // namespace

base::Result<Recording> Recording::open(const std::filesystem::path& path) {
  auto file = dump::DumpFile::open(path);
  if (!file) return tl::make_unexpected(file.error());
  Recording recording;
  recording.file_ = std::move(*file);
  return recording;
}

Recording::Recording(dump::Dump dump) : memory_(std::move(dump)) { take_notes(); }

void Recording::take_notes() {
  const auto& packets = dump().packets;
  for (; packets_noted_ < packets.size(); ++packets_noted_) {
    const auto& packet = packets[packets_noted_];
    const auto note = dump::bucket_note(dump(), packet);
    if (!note) continue;
    nodes_.push_back({packet.first + packet.count, 0, note->length == 0 ? gpu::no_bucket : note->bucket});
    noted_buckets_ = std::max(noted_buckets_, note->length);
  }
}

base::Result<Recording> Recording::of_list(RamImage image, std::vector<std::uint16_t> vram) {
  Recording recording;
  std::uint32_t bucket = gpu::no_bucket;
  std::vector<std::uint32_t> words;
  const auto walked =
      ot::walk(image.ram, image.head, [&](std::uint32_t address, std::span<const std::uint32_t> payload) {
        const auto at = address & (image.ram.size_bytes() - 4);
        if (image.table && at >= image.table->address &&
            (at - image.table->address) / 4 < image.table->length)
          bucket = (at - image.table->address) / 4;
        recording.nodes_.push_back({static_cast<std::uint32_t>(words.size()), at, bucket});
        words.insert(words.end(), payload.begin(), payload.end());
      });
  if (!walked) return base::fail("the list: " + walked.message());
  recording.memory_.add(dump::PacketType::port0, words);
  recording.image_ = std::move(image);

  gpu::Gpu gpu;
  if (!vram.empty()) std::ranges::copy(vram, gpu.vram().pixels().begin());
  std::array<std::uint32_t, 2> everywhere{};
  ot::encode(ot::DrawArea{}, everywhere);
  gpu.gp0(everywhere);
  show_what_is_drawn(gpu, words);
  recording.start_ = gpu.save();
  return recording;
}

bool Recording::read_some(std::size_t bytes) {
  if (!file_) return false;
  const bool is_more = file_->read_some(bytes);
  take_notes();
  return is_more;
}

base::Result<void> Recording::read_all() {
  while (read_some(std::size_t{1} << 20)) {
  }
  if (!fault().empty() && dump().vsyncs == 0) return base::fail(fault());
  return {};
}

const Node* Recording::node_at(std::uint32_t index) const {
  const auto next = std::ranges::upper_bound(nodes_, index, {}, &Node::first);
  return next == nodes_.begin() ? nullptr : &*std::prev(next);
}

}  // namespace debug
