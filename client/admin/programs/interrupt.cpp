#include "client/admin/programs/interrupt.h"

#include <csignal>
#include <iostream>
#include <poll.h>
#include <unistd.h>

namespace scree {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void note(int) {
  interrupted = 1;
}

}  // namespace

void note_interrupts() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
}

bool was_interrupted() {
  return interrupted != 0;
}

void forget_interrupt() {
  interrupted = 0;
}

bool read_line_unless_interrupted(std::string& line) {
  constexpr int look_ms = 100;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!was_interrupted()) {
    const int ready = ::poll(&input, 1, look_ms);
    if (ready > 0) return static_cast<bool>(std::getline(std::cin, line));
    if (ready < 0 && errno != EINTR) return false;
  }
  std::cerr << "\n";
  return false;
}

}  // namespace scree
