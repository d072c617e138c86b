// What every program does for its output, on any stream or file: none fails without a word.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "shared/base/result.h"

namespace scree {

/// A file over the limit of `ulimit -f` would end the program by a signal, without a word and with half files
/// left behind. Now the write fails (EFBIG), as on a full disk. To be called first of all.
inline void fail_at_file_limit() {
  std::signal(SIGXFSZ, SIG_IGN);
}

/// To be called last: what was printed is buffered, and may still fail to be written.
inline Result<void> flush_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
  return fail(std::string("the standard output cannot be written: ") + std::strerror(errno));
}

}  // namespace scree
