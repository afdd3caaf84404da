#include "debug/player.h"

#include <algorithm>
#include <cassert>

namespace debug {

using dump::PacketType;

namespace {

constexpr std::uint32_t piece_words = 512;  // between two questions whether to go on

}  // namespace

Player::Player(const Recording& recording, const dump::Frames& frames, const DrawOptions& options)
    : recording_(recording), frames_(frames), options_(options) {
  gpu_.set_depth(options.depth);
  if (!recording.start().empty()) {
    [[maybe_unused]] const auto fault = gpu_.load(recording.start());
    assert(!fault);
  }
}

void Player::run(Place end, const std::function<bool()>& keep_going) {
  const auto& packets = recording_.dump().packets;
  while (place_ < end && place_.packet < packets.size()) {
    const auto& packet = packets[place_.packet];
    const bool is_port = packet.type == PacketType::port0 || packet.type == PacketType::port1;
    const std::uint32_t last = place_.packet == end.packet ? std::min(end.word, packet.count) : packet.count;
    const std::uint32_t until = is_port ? std::min(last, place_.word + piece_words) : packet.count;
    send(place_.packet, place_.word, until);
    if (until >= packet.count) {
      place_ = {place_.packet + 1, 0};
    } else {
      place_.word = until;
    }
    if (keep_going && !keep_going()) return;
  }
}

void Player::send(std::size_t number, std::uint32_t first, std::uint32_t end) {
  const auto& packet = recording_.dump().packets[number];
  const auto payload = recording_.dump().payload(packet);
  switch (packet.type) {
    case PacketType::port0:
      begin_frame();
      send_words(payload.subspan(first, end - first), packet.first + first);
      break;
    case PacketType::port1:
      begin_frame();
      for (const auto word : payload.subspan(first, end - first)) gpu_.gp1(word);
      break;
    case PacketType::discard:
    case PacketType::readback:
      dump::read_words(gpu_, payload[0]);
      break;
    default:
      break;
  }
  if (frames_.ends_with(number)) end_frame();
  if (packet.type == PacketType::vsync) gpu_.next_field();
}

/// `first`: index of the first in Dump::words.
void Player::send_words(std::span<const std::uint32_t> words, std::uint32_t first) {
  const auto& nodes = recording_.nodes();
  if (nodes.empty()) return gpu_.gp0(words);
  auto next = std::ranges::upper_bound(nodes, first, {}, &Node::first);
  while (!words.empty()) {
    if (next != nodes.begin()) {
      const std::uint32_t bucket = std::prev(next)->bucket;
      if (gpu_.trace() != nullptr) gpu_.trace()->bucket = bucket;
      if (options_.depth_of_bucket && bucket != gpu::no_bucket)
        gpu_.set_default_depth(gpu::depth_of_bucket(bucket, recording_.buckets()));
    }
    const auto count =
        next == nodes.end() ? words.size() : std::min<std::size_t>(words.size(), next->first - first);
    gpu_.gp0(words.first(count));
    words = words.subspan(count);
    first += static_cast<std::uint32_t>(count);
    while (next != nodes.end() && next->first <= first) ++next;
  }
}

void Player::begin_frame() {
  if (is_in_frame_) return;
  gpu_.begin_frame();
  is_in_frame_ = true;
}

void Player::end_frame() {
  if (is_in_frame_) frame_end_ = gpu_.end_frame();
  is_in_frame_ = false;
}

void Player::restore(std::span<const std::byte> state, Place place, bool is_in_frame) {
  [[maybe_unused]] const auto fault = gpu_.load(state);
  assert(!fault);
  place_ = place;
  is_in_frame_ = is_in_frame;
}

}  // namespace debug
