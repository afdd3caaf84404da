#pragma once
// Two threads: the program's, on which its main() runs, and the host's, which makes vertical blanks, shows
// pictures and ends it all. One of them works on the console at a time:
//
//   - the program waits for a blank (VSync): the host has the console until it lets the program go on;
//   - the program never waits (it spins): the host takes the console between two of its calls, makes a blank,
//   and
//     interrupts the program for the callbacks of the blank, as the console's interrupt does.

#include <semaphore.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>

namespace sdk {

enum class ProgramState : std::uint8_t { running, waiting, ended, crashed };

class Handover {
 public:
  using Milliseconds = std::chrono::milliseconds;

  Handover();
  ~Handover();
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;

  // --- the program's side ---

  /// VSync: returns when the host has made the next blank.
  void wait_for_blank();
  /// The last thing the program does; never returns. Signal handlers may call it.
  [[noreturn]] void stop(ProgramState how);

  // --- the host's side ---

  /// Until the program waits, ends or crashes, `longest` at most. The state now.
  ProgramState wait_for_program(Milliseconds longest);
  /// The program goes on after its wait.
  void release();

  /// Held while the console is used. The program's calls hold it; so does the host where the program spins.
  std::recursive_mutex console;

 private:
  sem_t to_host_, to_program_;
  std::atomic<ProgramState> state_{ProgramState::running};
};

/// While one lives, the runtime is at work on the program's thread, and an interrupt waits for its end.
class Busy {
 public:
  Busy();
  ~Busy();
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
};

/// While one lives, a function of the SDK has the console.
class Call {
 public:
  Call();

 private:
  Busy busy_;  // ends after the lock: what an interrupt runs may call again
  std::lock_guard<std::recursive_mutex> lock_;
};

/// The interrupt: runs `callback` on the program's thread, now or when the runtime is no longer at work
/// there. Signal handlers may call it.
void interrupt(void (*callback)());

}  // namespace sdk
