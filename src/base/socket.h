#pragma once
// Whole messages over a stream socket.

#include <cstddef>
#include <span>

namespace base {

/// False: the other end is gone.
bool send_all(int socket, std::span<const std::byte> bytes);
/// Waits until all of `bytes` have come. False: the other end is gone.
bool receive_all(int socket, std::span<std::byte> bytes);

}  // namespace base
