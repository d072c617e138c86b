// A few threads that run jobs; urgent ones first, each kind in the order in which it came.
//
// submit() may be called from any thread. Jobs must not throw, and must own all data that they use. The
// destructor drops waiting jobs, and waits for running ones.
#pragma once

#include <array>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace scree {

class WorkPool {
 public:
  enum class Urgency { edit, load };

  explicit WorkPool(unsigned threads);
  ~WorkPool();
  WorkPool(const WorkPool&) = delete;
  WorkPool& operator=(const WorkPool&) = delete;

  void submit(Urgency urgency, std::function<void()> job);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::array<std::deque<std::function<void()>>, 2> queues_;  ///< by urgency
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

/// As many as the machine has cores, at most limits::worker_threads_max.
unsigned default_worker_threads();

}  // namespace scree
