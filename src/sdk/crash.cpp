#include "sdk/crash.h"

#include <execinfo.h>
#include <pthread.h>
#include <sys/mman.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <span>

#include "sdk/call_site.h"
#include "sdk/console.h"
#include "sdk/memory.h"

namespace sdk {
namespace {

constexpr std::array fatal{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP};
constexpr std::size_t page = 4096;

alignas(page) std::array<std::byte, 65536> signal_stack;
pthread_t watched;

// Written once, before the program's thread stops; read by the host afterwards.
int caught = 0;
std::array<void*, 32> frames;
int frame_count = 0;

void on_fatal(int number) {
  if (pthread_equal(pthread_self(), watched) == 0) {  // the host's own: as ever
    std::signal(number, SIG_DFL);
    std::raise(number);
    return;
  }
  caught = number;
  frame_count = backtrace(frames.data(), static_cast<int>(frames.size()));
  the_console().handover.stop(ProgramState::crashed);
}

const char* name_of(int number) {
  switch (number) {
    case SIGSEGV:
      return "SIGSEGV";
    case SIGBUS:
      return "SIGBUS";
    case SIGFPE:
      return "SIGFPE";
    case SIGILL:
      return "SIGILL";
    case SIGABRT:
      return "SIGABRT";
    default:
      return "SIGTRAP";
  }
}

}  // namespace

void catch_crashes() {
  watched = pthread_self();
  backtrace(frames.data(), 1);  // loads what it needs now, not inside the handler
  stack_t stack{};
  stack.ss_sp = signal_stack.data();
  stack.ss_size = signal_stack.size();
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_handler = on_fatal;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int number : fatal) sigaction(number, &action, nullptr);
  // The stack's last page may be read, when memory is copied, but not written.
  mprotect(the_console().memory.stack.data(), page, PROT_READ);
}

Crash describe_crash() {
  const std::span<void* const> all(frames.data(), static_cast<std::size_t>(frame_count));
  // The handler and the frame that the system made for it come first.
  constexpr std::size_t ours = 2;
  const auto sites = all.subspan(std::min(ours, all.size()));
  return {name_of(caught), describe_first_in_program(std::vector<CallSite>(sites.begin(), sites.end()))};
}

}  // namespace sdk
