#include "door/live.h"

#include <cstring>
#include <string>
#include <type_traits>

namespace door {

namespace {

class Writer {
 public:
  explicit Writer(std::size_t expected) { bytes_.reserve(expected); }
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof value);
  }
  /// Its length, then its elements.
  template <class Sequence>
  void put_all(const Sequence& values) {
    put(std::uint64_t{values.size()});
    put_bytes(values.data(), values.size() * sizeof(*values.data()));
  }
  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  void put_bytes(const void* from, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<std::byte> bytes_;
};

/// After the first mistake everything reads as empty.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (has_room(sizeof value)) take(&value, sizeof value);
  }
  template <class Sequence>
  void get_all(Sequence& values) {
    constexpr std::size_t each = sizeof(typename Sequence::value_type);
    std::uint64_t count = 0;
    get(count);
    is_good_ = is_good_ && count <= bytes_.size() / each;
    if (!is_good_) return;
    values.resize(static_cast<std::size_t>(count));
    if (count != 0) take(values.data(), static_cast<std::size_t>(count) * each);
  }
  [[nodiscard]] bool is_done() const { return is_good_ && bytes_.empty(); }
  [[nodiscard]] bool is_good() const { return is_good_; }

 private:
  bool has_room(std::size_t size) { return is_good_ = is_good_ && bytes_.size() >= size; }
  void take(void* to, std::size_t size) {
    std::memcpy(to, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
  }
  std::span<const std::byte> bytes_;
  bool is_good_ = true;
};

struct Numbers {
  std::uint64_t number, doubtful;
  std::uint32_t is_recording, buckets;
};

/// A truth value in a byte of its own must be 0 or 1 before it may be read as one.
struct WireRun {
  std::uint32_t flags, address, bucket, words;
};
constexpr std::uint32_t control_flag = 1, list_flag = 2;

}  // namespace

std::vector<std::byte> to_bytes(const LiveFrame& frame) {
  Writer out(frame.state.size() + frame.runs.size() * sizeof(WireRun) + frame.words.size() * 4 + 4096);
  out.put(Numbers{frame.number, frame.doubtful, frame.is_recording ? 1U : 0U, frame.buckets});
  out.put_all(frame.state);
  std::vector<WireRun> runs;
  runs.reserve(frame.runs.size());
  for (const LiveRun& run : frame.runs) {
    runs.push_back({(run.is_control ? control_flag : 0) | (run.is_list ? list_flag : 0), run.address,
                    run.bucket, run.words});
  }
  out.put_all(runs);
  out.put_all(frame.words);
  out.put(std::uint64_t{frame.lint.size()});
  for (const auto& item : frame.lint) {
    for (const std::string* text : {&item.kind, &item.at, &item.text}) out.put_all(*text);
  }
  return out.take();
}

base::Result<LiveFrame> live_frame_of(std::span<const std::byte> bytes) {
  Reader in(bytes);
  LiveFrame frame;
  Numbers numbers{};
  in.get(numbers);
  frame.number = numbers.number;
  frame.doubtful = numbers.doubtful;
  frame.is_recording = numbers.is_recording != 0;
  frame.buckets = numbers.buckets;
  in.get_all(frame.state);
  std::vector<WireRun> runs;
  in.get_all(runs);
  in.get_all(frame.words);
  std::uint64_t lint = 0;
  in.get(lint);
  for (; in.is_good() && lint > 0; --lint) {
    auto& item = frame.lint.emplace_back();
    for (std::string* text : {&item.kind, &item.at, &item.text}) in.get_all(*text);
  }
  std::uint64_t words = 0;
  for (const WireRun& run : runs) {
    frame.runs.push_back(
        {(run.flags & control_flag) != 0, (run.flags & list_flag) != 0, run.address, run.bucket, run.words});
    words += run.words;
    if ((run.flags & control_flag) != 0 && run.words != 1)
      return base::fail("a word of port 1: expected one");
  }
  if (!in.is_done() || words != frame.words.size())
    return base::fail("a frame of a running program: its parts are not as long as it says");
  return frame;
}

}  // namespace door
