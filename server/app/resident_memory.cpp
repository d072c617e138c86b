#include "server/app/resident_memory.h"

#include <chrono>
#include <cstdint>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <unistd.h>

#include "server/app/limits.h"

namespace scree {

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  uint64_t all_pages = 0, resident_pages = 0;
  if (!(file >> all_pages >> resident_pages)) return 0.0;
  return static_cast<double>(resident_pages) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void bound_heap_arenas() {
  mallopt(M_ARENA_MAX, limits::heap_arenas);
  mallopt(M_MMAP_THRESHOLD, limits::heap_block_bytes);
  mallopt(M_TRIM_THRESHOLD, 2 * limits::heap_block_bytes);
}

ResidentMemory::ResidentMemory()
    : bound_bytes_(std::numeric_limits<double>::max()),
      bytes_(resident_bytes()),
      thread_([this] { run(); }) {}

ResidentMemory::~ResidentMemory() {
  {
    const std::scoped_lock lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ResidentMemory::run() {
  const std::chrono::milliseconds period(limits::resident_sample_ms);
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, period, [this] { return stopping_; })) {
    lock.unlock();
    if (resident_bytes() > bound_bytes_.load(std::memory_order_relaxed)) malloc_trim(0);
    bytes_.store(resident_bytes(), std::memory_order_relaxed);
    lock.lock();
  }
}

}  // namespace scree
