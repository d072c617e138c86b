#include "shared/base/memory_count.h"

#include <fstream>
#include <string>

namespace scree {

size_t process_memory_bytes() {
  // Linux: "VmRSS:  1234 kB" (proc(5), status).
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmRSS:") continue;
    size_t kibibytes = 0;
    status >> kibibytes;
    return kibibytes * 1024;
  }
  return 0;
}

}  // namespace scree
