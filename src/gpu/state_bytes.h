#pragma once
// The bytes of a saved state: numbers of 32 bits and blocks of pixels or keys, little-endian. A structure is
// described by one function that names its fields to either of these; what is read is checked number by
// number.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace gpu {

class StateWriter {
 public:
  /// The range is for reading.
  template <class T>
  void number(std::string_view, const T& value, std::int64_t = 0, std::int64_t = 0) {
    word(static_cast<std::uint32_t>(value));
  }
  void word(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8)
      bytes_.push_back(static_cast<std::byte>(value >> shift & 0xff));
  }
  void real(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    word(static_cast<std::uint32_t>(bits));
    word(static_cast<std::uint32_t>(bits >> 32));
  }
  /// A span or an array of unsigned numbers.
  void block(const auto& values) {
    constexpr std::size_t each = sizeof(values[0]);
    std::size_t at = bytes_.size();
    bytes_.resize(at + values.size() * each);
    for (const auto value : values) {
      for (std::size_t n = 0; n < each; ++n) bytes_[at++] = static_cast<std::byte>(value >> 8 * n & 0xff);
    }
  }
  void put_word_at(std::size_t at, std::uint32_t value) {
    for (std::size_t n = 0; n < 4; ++n) bytes_[at + n] = static_cast<std::byte>(value >> 8 * n & 0xff);
  }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

 private:
  std::vector<std::byte> bytes_;
};

/// Keeps the first thing that is wrong and reads zeros from then on.
class StateReader {
 public:
  explicit StateReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  /// Needs lowest <= 0 <= largest, or `out` to be in the range already.
  template <class T>
  void number(std::string_view name, T& out, std::int64_t lowest, std::int64_t largest) {
    const std::size_t at = at_;
    std::uint32_t bits = 0;
    word(bits);
    const std::int64_t value = lowest < 0 ? static_cast<std::int32_t>(bits) : std::int64_t{bits};
    if (value < lowest || value > largest) {
      fail(at, std::string(name) + " is " + std::to_string(value) + ", expected " + std::to_string(lowest) +
                   ".." + std::to_string(largest));
    } else if (!has_failed()) {
      out = static_cast<T>(value);
    }
  }
  void word(std::uint32_t& out) {
    out = 0;
    if (const auto bytes = take(4); !bytes.empty()) out = static_cast<std::uint32_t>(little_endian(bytes));
  }
  void real(double& out) {
    if (const auto bytes = take(8); !bytes.empty()) out = std::bit_cast<double>(little_endian(bytes));
  }
  void block(auto&& out) {
    using Value = std::remove_reference_t<decltype(out[0])>;
    const auto bytes = take(out.size() * sizeof(Value));
    if (bytes.empty()) return;
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<Value>(little_endian(bytes.subspan(i * sizeof(Value), sizeof(Value))));
  }
  /// The bytes of a block, to be read later; none after a failure.
  std::span<const std::byte> take(std::size_t count) {
    if (has_failed() || bytes_.size() - at_ < count) {
      fail(at_, "the state ends, expected " + std::to_string(count) + " more bytes");
      return {};
    }
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  /// A number of things of so many bytes each, which must still be there.
  void count(std::string_view name, std::uint32_t& out, std::size_t bytes_each) {
    number(name, out, 0, static_cast<std::int64_t>((bytes_.size() - at_) / bytes_each));
  }

  void fail(std::size_t at, std::string text) {
    if (has_failed()) return;
    offset_ = at;
    message_ = std::move(text);
  }
  [[nodiscard]] bool has_failed() const { return !message_.empty(); }
  [[nodiscard]] std::size_t position() const { return at_; }
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  static std::uint64_t little_endian(std::span<const std::byte> bytes) {
    std::uint64_t value = 0;
    for (std::size_t n = bytes.size(); n-- > 0;)
      value = value << 8 | std::to_integer<std::uint64_t>(bytes[n]);
    return value;
  }

  std::span<const std::byte> bytes_;
  std::size_t at_ = 0, offset_ = 0;
  std::string message_;
};

}  // namespace gpu
