#include "interrupt.h"

#include <atomic>
#include <csignal>

namespace pelage {

namespace {

/// Written by the handler, read by all threads that work.
std::atomic<int> received = 0;
static_assert(std::atomic<int>::is_always_lock_free, "a handler of signals must not wait for a lock");

void remember(int signal) { received = signal; }

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = remember;
  // The handler serves once, so that a second signal has its usual effect; reads and writes go on.
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGHUP, &action, nullptr);
}

int interrupt_signal() { return received; }

}  // namespace pelage
