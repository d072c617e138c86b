// A few threads that run jobs; urgent ones first, each kind in the order in which it came. Where there are no
// threads, a few jobs at a time run when their owner calls run_for().
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

  /// 0: only run_for() runs anything.
  explicit WorkPool(unsigned threads);
  ~WorkPool();
  WorkPool(const WorkPool&) = delete;
  WorkPool& operator=(const WorkPool&) = delete;

  void submit(Urgency urgency, std::function<void()> job);

  /// Without threads: runs jobs on the caller's, one after another, until so much time is over; one at least,
  /// if any waits and there is any time. True: others wait. With threads: does nothing, and is false.
  bool run_for(double seconds);
  /// The longest job that run_for() ran, milliseconds.
  double worst_ms() const { return worst_ms_; }

 private:
  void run();
  std::function<void()> pop();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::array<std::deque<std::function<void()>>, 2> queues_;  ///< by urgency
  bool stopping_ = false;
  double worst_ms_ = 0.0;
  std::vector<std::thread> threads_;
};

/// As many as the machine has cores, at most limits::worker_threads_max; none where a program has no threads.
unsigned default_worker_threads();

}  // namespace scree
