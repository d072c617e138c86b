// How far a program's long work is.
#pragma once

#include <cstdio>

namespace scree {

/// On standard error. One thread.
class ProgressBar {
 public:
  /// `shown`: standard error is a terminal. Otherwise nothing is drawn.
  explicit ProgressBar(bool shown) : shown_(shown) {}

  /// `part`: from 0 to 1; more than once may come the same, or less than before.
  void show(double part) {
    const int percent = static_cast<int>(part * 100.0);
    if (!shown_ || percent == percent_) return;
    percent_ = percent;
    std::fprintf(stderr, "\r[%-50.*s] %3d %%", percent / 2,
                 "##################################################", percent);
  }
  /// Takes it away: what the program says next begins its own line.
  void end() {
    if (percent_ >= 0) std::fprintf(stderr, "\r%58s\r", "");
    percent_ = -1;
  }

 private:
  const bool shown_;
  int percent_ = -1;
};

}  // namespace scree
