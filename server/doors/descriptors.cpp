#include "server/doors/descriptors.h"

#include <algorithm>
#include <limits>
#include <sys/resource.h>

namespace scree {

size_t raise_descriptors(size_t wanted) {
  rlimit now{};
  if (getrlimit(RLIMIT_NOFILE, &now) != 0) return wanted;  // unknown: accept() will say so
  if (now.rlim_cur == RLIM_INFINITY) return std::numeric_limits<size_t>::max();
  if (now.rlim_cur < wanted) {
    rlimit raised = now;
    raised.rlim_cur = std::min<rlim_t>(wanted, now.rlim_max);
    if (setrlimit(RLIMIT_NOFILE, &raised) == 0) now = raised;
  }
  return static_cast<size_t>(now.rlim_cur);
}

}  // namespace scree
