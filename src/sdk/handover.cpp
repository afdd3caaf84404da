#include "sdk/handover.h"

#include <ctime>

#include "sdk/console.h"

namespace sdk {
namespace {

// Of the program's thread alone, and of signal handlers on it.
// Initial-exec: found without a call, as a library that is loaded at the start may.
__attribute__((tls_model("initial-exec"))) thread_local volatile int calls = 0;
__attribute__((tls_model("initial-exec"))) thread_local void (*volatile pending)() = nullptr;

timespec after(Handover::Milliseconds time) {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const auto nanoseconds = now.tv_nsec + time.count() % 1000 * 1'000'000;
  return {now.tv_sec + time.count() / 1000 + nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000};
}

}  // namespace

Handover::Handover() {
  sem_init(&to_host_, 0, 0);
  sem_init(&to_program_, 0, 0);
}

Handover::~Handover() {
  sem_destroy(&to_host_);
  sem_destroy(&to_program_);
}

void Handover::wait_for_blank() {
  state_ = ProgramState::waiting;
  sem_post(&to_host_);
  while (sem_wait(&to_program_) != 0) {  // a signal woke it
  }
}

void Handover::stop(ProgramState how) {
  state_ = how;
  sem_post(&to_host_);
  for (;;) sem_wait(&to_program_);
}

ProgramState Handover::wait_for_program(Milliseconds longest) {
  if (state_ != ProgramState::running) return state_;
  const auto until = after(longest);
  sem_timedwait(&to_host_, &until);
  return state_;
}

void Handover::release() {
  while (sem_trywait(&to_host_) == 0) {  // what announced the wait that ends here
  }
  state_ = ProgramState::running;
  sem_post(&to_program_);
}

Busy::Busy() { calls = calls + 1; }

Busy::~Busy() {
  calls = calls - 1;
  while (calls == 0 && pending != nullptr) {
    auto* callback = pending;
    pending = nullptr;
    callback();
  }
}

Call::Call() : lock_(the_console().handover.console) {}

void interrupt(void (*callback)()) {
  if (calls != 0) {
    pending = callback;
  } else {
    callback();
  }
}

}  // namespace sdk
