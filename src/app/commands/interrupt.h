#pragma once
// Ctrl-C in a run that takes long: it ends with what it has, and exit status 130.

#include <csignal>

namespace app {

/// While one lives, SIGINT sets a flag instead of ending the program.
class Interrupt {
 public:
  Interrupt() : before_(std::signal(SIGINT, [](int) { flag = 1; })) {}
  ~Interrupt() { std::signal(SIGINT, before_); }
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  [[nodiscard]] bool was_asked() const { return flag != 0; }

 private:
  static inline volatile std::sig_atomic_t flag = 0;
  void (*before_)(int);
};

}  // namespace app
