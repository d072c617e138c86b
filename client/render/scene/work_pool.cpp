#include "client/render/scene/work_pool.h"

#include <algorithm>
#include <utility>

#include "client/render/scene/limits.h"
#include "shared/base/timing.h"

namespace scree {

WorkPool::WorkPool(unsigned threads) {
  threads_.reserve(threads);
  for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
}

WorkPool::~WorkPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (auto& queue : queues_) queue.clear();
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void WorkPool::submit(Urgency urgency, std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    queues_[static_cast<size_t>(urgency)].push_back(std::move(job));
  }
  wake_.notify_one();
}

void WorkPool::run() {
  while (true) {
    std::function<void()> job;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [this] { return stopping_ || !queues_[0].empty() || !queues_[1].empty(); });
      if (stopping_) return;
      job = pop();
    }
    job();
  }
}

/// The next job; one waits, and the mutex is held.
std::function<void()> WorkPool::pop() {
  auto& queue = queues_[0].empty() ? queues_[1] : queues_[0];
  std::function<void()> job = std::move(queue.front());
  queue.pop_front();
  return job;
}

bool WorkPool::run_for(double seconds) {
  if (!threads_.empty()) return false;
  const double begun_s = steady_now_s();
  for (double last_s = begun_s; last_s - begun_s < seconds;) {
    std::function<void()> job;
    {
      const std::lock_guard lock(mutex_);
      if (queues_[0].empty() && queues_[1].empty()) return false;
      job = pop();
    }
    job();
    const double now_s = steady_now_s();
    worst_ms_ = std::max(worst_ms_, (now_s - std::exchange(last_s, now_s)) * 1000.0);
  }
  const std::lock_guard lock(mutex_);
  return !queues_[0].empty() || !queues_[1].empty();
}

unsigned default_worker_threads() {
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  return 0;
#else
  return std::clamp(std::thread::hardware_concurrency(), 1U, limits::worker_threads_max);
#endif
}

}  // namespace scree
