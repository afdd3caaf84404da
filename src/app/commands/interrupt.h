#pragma once
// Ctrl-C in a run that takes long: it ends with what it has, and exit status 130.

#include <csignal>

namespace app {

/// While one lives, the first SIGINT sets a flag instead of ending the program; a second one ends it at once.
class Interrupt {
 public:
  Interrupt() {
    flag = 0;
    before_ = std::signal(SIGINT, [](int) {
      flag = 1;
      std::signal(SIGINT, SIG_DFL);
    });
  }
  ~Interrupt() { std::signal(SIGINT, before_); }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] static bool was_asked() { return flag != 0; }

 private:
  static inline volatile std::sig_atomic_t flag = 0;
  void (*before_)(int);
};

}  // namespace app
