#include "client/render/scene/work_pool.h"

#include <algorithm>
#include <utility>

#include "client/render/scene/limits.h"

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
      auto& queue = queues_[0].empty() ? queues_[1] : queues_[0];
      job = std::move(queue.front());
      queue.pop_front();
    }
    job();
  }
}

unsigned default_worker_threads() {
  return std::clamp(std::thread::hardware_concurrency(), 1U, limits::worker_threads_max);
}

}  // namespace scree
