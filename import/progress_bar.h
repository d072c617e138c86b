// How far a program's long work is.
#pragma once

#include <cstdio>
#include <unistd.h>

namespace scree {

/// On standard error, when it is a terminal.
class ProgressBar {
 public:
  void show(double part) {
    const int percent = static_cast<int>(part * 100.0);
    if (!shown_ || percent == percent_) return;
    percent_ = percent;
    std::fprintf(stderr, "\r[%-50.*s] %3d %%", percent / 2,
                 "##################################################", percent);
  }
  void end() const {
    if (percent_ >= 0) std::fprintf(stderr, "\n");
  }

 private:
  const bool shown_ = isatty(STDERR_FILENO) != 0;
  int percent_ = -1;
};

}  // namespace scree
