#pragma once
// The window over a running program: the program `otter`, in a process of its own, so that nothing it does
// can touch the emulator's memory. Frames go there, requests come back; neither end waits for the other.

#include <sys/types.h>

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/result.h"
#include "door/live.h"

namespace door {

class WindowProcess {
 public:
  /// `program`: path of `otter`, or a name to be looked for in PATH. `words`: for its command line, behind
  /// those that tell where frames come from. Error: it cannot be started.
  static base::Result<std::unique_ptr<WindowProcess>> start(const std::string& program,
                                                            const std::vector<std::string>& words);
  /// Ends the window, which has a second to do it itself.
  ~WindowProcess();
  WindowProcess(const WindowProcess&) = delete;
  WindowProcess& operator=(const WindowProcess&) = delete;

  /// A frame that is sent now goes soon: the last one is on its way.
  [[nodiscard]] bool is_ready();
  void send(const LiveFrame& frame);
  /// The next request, if there is one before `milliseconds` have passed.
  std::optional<LiveRequest> poll(int milliseconds);
  /// The other end is closed: the user has ended it, or it has crashed.
  [[nodiscard]] bool has_ended() const { return has_ended_; }

 private:
  WindowProcess(int socket, pid_t child);
  void send_frames();

  int socket_;
  pid_t child_;
  bool has_ended_ = false;
  std::vector<std::byte> read_;  // the beginning of a request

  std::mutex mutex_;
  std::condition_variable wakes_;
  std::vector<std::byte> outbox_;  // empty: ready
  bool is_closing_ = false;
  std::thread sender_;
};

/// Where the window's program is: what the environment says (OTTER_PROGRAM), beside the folder of this
/// library (../bin/otter of a build, ../../../bin/otter of an installation), or "otter", to be found in PATH.
std::string find_window_program();

}  // namespace door
