// Memory use by category, for reports: bytes on the CPU's side and on the GPU's.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace scree {

struct MemoryCount {
  std::string_view category;  ///< a literal
  size_t cpu_bytes = 0;
  size_t gpu_bytes = 0;
};

using MemoryCounts = std::vector<MemoryCount>;

inline size_t gpu_bytes_of(const MemoryCounts& counts) {
  size_t sum = 0;
  for (const MemoryCount& count : counts) sum += count.gpu_bytes;
  return sum;
}

/// Resident set of this process, bytes; 0 where the system does not say.
size_t process_memory_bytes();

}  // namespace scree
