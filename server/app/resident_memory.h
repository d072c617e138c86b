// What the process has in RAM, and that it is not more than it needs: malloc keeps what is freed, for later.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace scree {

/// Bytes of this process that lie in RAM; 0 when the system does not say.
double resident_bytes();

/// Has malloc keep few arenas, and return large blocks at once. Before the first thread starts: threads that
/// allocate for each other would otherwise leave holes in an arena each.
void bound_heap_arenas();

/// Looks every limits::resident_sample_ms, on a thread of its own.
class ResidentMemory {
 public:
  ResidentMemory();
  ~ResidentMemory();
  ResidentMemory(const ResidentMemory&) = delete;
  ResidentMemory& operator=(const ResidentMemory&) = delete;

  /// From any thread. Above so many bytes, malloc is to give back what it holds for nothing.
  void bound(double bytes) { bound_bytes_.store(bytes, std::memory_order_relaxed); }
  /// From any thread: as of the last look.
  double bytes() const { return bytes_.load(std::memory_order_relaxed); }

 private:
  void run();

  std::atomic<double> bound_bytes_;
  std::atomic<double> bytes_;
  std::mutex mutex_;  ///< guards the member below
  bool stopping_ = false;
  std::condition_variable changed_;
  std::thread thread_;
};

}  // namespace scree
