#include "base/socket.h"

#include <sys/socket.h>

#include <cerrno>

namespace base {

bool send_all(int socket, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool receive_all(int socket, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const auto came = ::recv(socket, bytes.data(), bytes.size(), 0);
    if (came < 0 && errno == EINTR) continue;
    if (came <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(came));
  }
  return true;
}

}  // namespace base
