#include "sdk/remote.h"

#include <poll.h>
#include <unistd.h>

#include <cstring>
#include <span>
#include <type_traits>

#include "base/socket.h"

namespace sdk {
namespace {

/// Puts values one behind the other.
class Packer {
 public:
  std::vector<std::byte> bytes;

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { put(&value, sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& values) {
    auto count = values.size();
    (*this)(count);
    put(values.data(), count * sizeof(T));
  }
  void operator()(std::string& text) {
    auto count = text.size();
    (*this)(count);
    put(text.data(), count);
  }
  template <class T>
  std::size_t count(std::vector<T>& values) {
    auto size = values.size();
    (*this)(size);
    return size;
  }

 private:
  void put(const void* from, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(from);
    bytes.insert(bytes.end(), first, first + size);
  }
};

/// Takes them out again. What is not there is nothing: a message comes whole or not at all.
class Unpacker {
 public:
  explicit Unpacker(const std::vector<std::byte>& bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(T& value) { take(&value, sizeof value); }
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void operator()(std::vector<T>& values) {
    std::size_t count = 0;
    (*this)(count);
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }
  void operator()(std::string& text) {
    std::size_t count = 0;
    (*this)(count);
    text.resize(count);
    take(text.data(), count);
  }
  template <class T>
  std::size_t count(std::vector<T>& values) {
    std::size_t size = 0;
    (*this)(size);
    values.resize(size);
    return size;
  }

 private:
  void take(void* to, std::size_t size) {
    if (size != 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  const std::vector<std::byte>& bytes_;
  std::size_t at_ = 0;
};

template <class Archive>
void carry(Archive& a, Orders& o) {
  a(o.frames), a(o.kept), a(o.is_silent), a(o.pads);
}

template <class Archive>
void carry(Archive& a, TakenFrame& f) {
  a(f.number), a(f.is_last), a(f.shares), a(f.state);
  a(f.ending.kind), a(f.ending.never_waited), a(f.ending.signal), a(f.ending.place);
  a.count(f.findings);
  for (auto& one : f.findings) a(one.kind), a(one.site), a(one.text), a(one.frame), a(one.times);
  a.count(f.sent);
  for (auto& one : f.sent) {
    a(one.is_control), a(one.bucket), a(one.table), a(one.table_length), a(one.address), a(one.site);
    a(one.words);
  }
}

constexpr std::uint8_t orders_kind = 1, frame_kind = 2, progress_kind = 3;

}  // namespace

Line::~Line() { ::close(socket_); }

bool Line::send_message(std::uint8_t kind, const std::vector<std::byte>& bytes) {
  const std::uint64_t size = bytes.size();
  return base::send_all(socket_, std::as_bytes(std::span(&kind, 1))) &&
         base::send_all(socket_, std::as_bytes(std::span(&size, 1))) && base::send_all(socket_, bytes);
}

bool Line::receive_message(std::uint8_t& kind, std::vector<std::byte>& bytes) {
  std::uint64_t size = 0;
  if (!base::receive_all(socket_, std::as_writable_bytes(std::span(&kind, 1))) ||
      !base::receive_all(socket_, std::as_writable_bytes(std::span(&size, 1))))
    return false;
  bytes.resize(size);
  return base::receive_all(socket_, bytes);
}

bool Line::send(Orders orders) {
  Packer pack;
  carry(pack, orders);
  return send_message(orders_kind, pack.bytes);
}

bool Line::send(TakenFrame frame) {
  Packer pack;
  carry(pack, frame);
  return send_message(frame_kind, pack.bytes);
}

bool Line::send_progress(std::uint32_t frame) {
  Packer pack;
  pack(frame);
  return send_message(progress_kind, pack.bytes);
}

std::optional<Orders> Line::receive_orders() {
  std::uint8_t kind = 0;
  std::vector<std::byte> bytes;
  if (!receive_message(kind, bytes) || kind != orders_kind) return std::nullopt;
  Orders orders;
  Unpacker take(bytes);
  carry(take, orders);
  return orders;
}

Line::Came Line::receive(TakenFrame& frame, int milliseconds) {
  pollfd wanted{socket_, POLLIN, 0};
  if (::poll(&wanted, 1, milliseconds) <= 0) return Came::nothing;
  std::uint8_t kind = 0;
  std::vector<std::byte> bytes;
  if (!receive_message(kind, bytes)) return Came::end;
  Unpacker take(bytes);
  if (kind == progress_kind) {
    take(frame.number);
    return Came::progress;
  }
  carry(take, frame);
  return Came::frame;
}

}  // namespace sdk
