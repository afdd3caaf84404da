#include "dump/bucket_note.h"

#include <charconv>

namespace dump {
namespace {

constexpr std::string_view prefix = "otter.bucket ", none = "none", between = " of ";

std::optional<std::uint32_t> number(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string to_text(const BucketNote& note) {
  if (note.length == 0) return std::string(prefix) + std::string(none);
  return std::string(prefix) + std::to_string(note.bucket) + std::string(between) +
         std::to_string(note.length);
}

std::optional<BucketNote> bucket_note(const Dump& dump, const Packet& packet) {
  if (packet.type != PacketType::comment) return std::nullopt;
  const auto words = dump.payload(packet);
  std::string_view text(reinterpret_cast<const char*>(words.data()), words.size_bytes());
  text = text.substr(0, text.find('\0'));
  if (!text.starts_with(prefix)) return std::nullopt;
  text.remove_prefix(prefix.size());
  if (text == none) return BucketNote{};
  const auto at = text.find(between);
  if (at == std::string_view::npos) return std::nullopt;
  const auto bucket = number(text.substr(0, at)), length = number(text.substr(at + between.size()));
  if (!bucket || !length || *length == 0 || *bucket >= *length) return std::nullopt;
  return BucketNote{*bucket, *length};
}

}  // namespace dump
