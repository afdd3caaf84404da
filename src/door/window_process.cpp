#include "door/window_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/socket.h"

extern char** environ;

namespace door {

namespace {

constexpr int window_socket = 3;  // its number in the window's process

bool ends_within(pid_t child, std::chrono::milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (waitpid(child, nullptr, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace

base::Result<std::unique_ptr<WindowProcess>> WindowProcess::start(const std::string& program,
                                                                  const std::vector<std::string>& words) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return base::fail(std::string("no window: ") + std::strerror(errno));
  std::vector<std::string> line{program, "run", "--live", std::to_string(window_socket)};
  line.insert(line.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  for (auto& word : line) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  // dup2 onto itself would leave the descriptor to be closed.
  if (ends[1] == window_socket) {
    const int other = fcntl(ends[1], F_DUPFD_CLOEXEC, window_socket + 1);
    close(std::exchange(ends[1], other));
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], window_socket);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed != 0) {
    close(ends[0]);
    return base::fail("no window: " + program + ": " + std::strerror(failed) +
                      "; expected the program otter there, OTTER_PROGRAM=PATH names another place");
  }
  return std::unique_ptr<WindowProcess>(new WindowProcess(ends[0], child));
}

WindowProcess::WindowProcess(int socket, pid_t child)
    : socket_(socket), child_(child), sender_([this] { send_frames(); }) {}

WindowProcess::~WindowProcess() {
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
  }
  wakes_.notify_one();
  shutdown(socket_, SHUT_RDWR);
  sender_.join();
  close(socket_);
  using namespace std::chrono_literals;
  if (ends_within(child_, 1s)) return;
  kill(child_, SIGTERM);
  if (ends_within(child_, 1s)) return;
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

bool WindowProcess::is_ready() {
  const std::lock_guard lock(mutex_);
  return outbox_.empty() && !has_ended_;
}

void WindowProcess::send(const LiveFrame& frame) {
  auto bytes = to_bytes(frame);
  if (bytes.size() > most_frame_bytes) return;
  {
    const std::lock_guard lock(mutex_);
    if (!outbox_.empty()) return;
    outbox_ = std::move(bytes);
  }
  wakes_.notify_one();
}

void WindowProcess::send_frames() {
  std::vector<std::byte> frame;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wakes_.wait(lock, [this] { return is_closing_ || !outbox_.empty(); });
      if (is_closing_) return;
      frame = outbox_;  // stays: is_ready() says when it is gone
    }
    const std::uint64_t length = frame.size();
    const bool went =
        base::send_all(socket_, std::as_bytes(std::span(&length, 1))) && base::send_all(socket_, frame);
    const std::lock_guard lock(mutex_);
    if (!went) return;  // nobody is there: poll() finds out
    outbox_.clear();
  }
}

std::optional<LiveRequest> WindowProcess::poll(int milliseconds) {
  if (has_ended_) return std::nullopt;
  pollfd waits{.fd = socket_, .events = POLLIN, .revents = 0};
  const int ready = ::poll(&waits, 1, milliseconds);
  if (ready <= 0) return std::nullopt;
  std::array<std::byte, sizeof(LiveRequest)> part;
  const auto got = recv(socket_, part.data(), part.size() - read_.size(), MSG_DONTWAIT);
  if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) has_ended_ = true;
  if (got <= 0) return std::nullopt;
  read_.insert(read_.end(), part.begin(), part.begin() + got);
  if (read_.size() < sizeof(LiveRequest)) return std::nullopt;
  LiveRequest request;
  std::memcpy(&request, read_.data(), sizeof request);
  read_.clear();
  return request;
}

std::string find_window_program() {
  if (const char* named = std::getenv("OTTER_PROGRAM"); named != nullptr && *named != '\0') return named;
  Dl_info own{};
  std::error_code error;
  if (dladdr(reinterpret_cast<const void*>(&find_window_program), &own) != 0 && own.dli_fname != nullptr) {
    const auto folder = std::filesystem::canonical(own.dli_fname, error).parent_path();
    for (const char* way : {"../bin/otter", "../../../bin/otter", "../../bin/otter"}) {
      if (!error && std::filesystem::exists(folder / way, error)) return folder / way;
    }
  }
  return "otter";
}

}  // namespace door
