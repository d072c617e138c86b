#include "tools/import/process/time_limit.h"

#include <csignal>
#include <sys/time.h>
#include <unistd.h>

#include "shared/base/check.h"

namespace scree {

namespace {

constexpr int exit_late = 1;

/// A handler of signals reaches what is global alone. Set before the timer runs, and not changed while it
/// does.
struct Late {
  bool is_set = false;
  std::string words;
  std::string unfinished;
};
Late& late() {
  static Late late;
  return late;
}

/// Calls nothing that a signal must not interrupt.
void end_late(int /*signal*/) {
  const Late& end = late();
  unlink(end.unfinished.c_str());
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, end.words.data(), end.words.size());
  _exit(exit_late);
}

void start_timer(std::chrono::milliseconds time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  itimerval timer{};
  timer.it_value.tv_sec = seconds.count();
  timer.it_value.tv_usec = std::chrono::microseconds(time - seconds).count();
  CHECK(setitimer(ITIMER_REAL, &timer, nullptr) == 0);
}

}  // namespace

TimeLimit::TimeLimit(std::chrono::milliseconds time, const std::string& words,
                     const std::string& unfinished) {
  CHECK(time.count() > 0);
  CHECK(!late().is_set);
  late() = {true, words + "\n", unfinished};
  struct sigaction action {};
  action.sa_handler = end_late;
  CHECK(sigaction(SIGALRM, &action, nullptr) == 0);
  start_timer(time);
}

TimeLimit::~TimeLimit() {
  start_timer(std::chrono::milliseconds(0));
  std::signal(SIGALRM, SIG_DFL);
  late() = {};
}

}  // namespace scree
