#include "system/interrupts.h"

#include <array>
#include <atomic>
#include <csignal>

#include <unistd.h>

#include "pliant/core/error.h"

namespace pliant_system {
namespace {

constexpr std::array interrupts = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};

// A handler may run on any thread.
std::atomic<int> interrupt_flag = 0;
std::atomic<int> patience_ended = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void on_alarm(int) {
  patience_ended = 1;
}

extern "C" void on_interrupt(int) {
  if (interrupt_flag.exchange(1) != 0) return;  // SIGXCPU comes every second
  alarm(patience);
  for (const int number : interrupts) {
    if (number != SIGXCPU) std::signal(number, SIG_DFL);
  }
}

extern "C" void end_at_once(int) {
  _exit(static_cast<int>(pliant::ErrorKind::interrupted));
}

void handle_interrupts(const struct sigaction& action) {
  for (const int number : interrupts) {
    struct sigaction inherited = {};
    sigaction(number, nullptr, &inherited);
    if (inherited.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);  // as nohup has it
  }
}

}  // namespace

void end_at_interrupts() {
  struct sigaction action = {};
  action.sa_handler = end_at_once;
  handle_interrupts(action);
}

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  action.sa_flags = SA_RESTART;
  handle_interrupts(action);
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
}

bool was_interrupted() {
  return interrupt_flag != 0;
}

bool waits_no_longer() {
  return patience_ended != 0;
}

}  // namespace pliant_system
