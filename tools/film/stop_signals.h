// SIGINT and SIGTERM as a question, so that a program ends in order where it can.
#pragma once

#include <csignal>
#include <ctime>

namespace scree {

/// Make it before any thread starts: they are blocked from then on. One thread.
class StopSignals {
 public:
  StopSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }

  /// Whether one came; it stays so.
  bool asked() {
    const timespec at_once{};
    asked_ = asked_ || sigtimedwait(&signals_, nullptr, &at_once) > 0;
    return asked_;
  }

 private:
  sigset_t signals_{};
  bool asked_ = false;
};

}  // namespace scree
