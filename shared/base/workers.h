// Threads that share a piece of work and wait for each other: fork and join. The owner's thread takes part.
//
// run() is called by one thread, the owner's, and returns when all parts are done; what it wrote before is
// seen by the parts, and what the parts wrote is seen after it. Which thread does a part, and when, is open:
// a part must not touch anything that another part changes, and results are merged by the number of the part,
// so that they are the same for any number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "shared/base/thread_check.h"

namespace scree {

class Workers {
 public:
  static constexpr size_t threads_max = 64;  ///< more would wait for each other

  /// So many threads, the owner's included; 0: as many as the machine has cores. At most threads_max.
  explicit Workers(size_t threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  size_t threads() const { return helpers_.size() + 1; }
  /// Calls work(part) once for each part below `parts`. Not from within work(), which does not throw.
  void run(size_t parts, const std::function<void(size_t part)>& work);
  /// Splits the items into parts of `each`, the last one of fewer, and calls work(part, its items) once for
  /// each.
  template <typename Item, typename Work>
  void share(std::span<Item> items, size_t each, const Work& work) {
    run(parts_of(items.size(), each), [&](size_t part) {
      const std::span<Item> from = items.subspan(part * each);
      work(part, from.first(std::min(each, from.size())));
    });
  }
  static size_t parts_of(size_t items, size_t each) { return (items + each - 1) / each; }

  /// The owner's thread lets go: the thread of the next run() is the owner's.
  void release_owner();

  /// Whether run() is under way. By the owner's thread, and from within work().
  bool at_work() const { return at_work_; }

 private:
  void help();
  void run_parts();

  std::vector<std::thread> helpers_;
  ThreadCheck owner_;
  bool at_work_ = false;
  std::mutex mutex_;
  std::condition_variable called_, left_;
  // Changed under mutex_, and read without it by those who have not yet gone to sleep.
  std::atomic<size_t> round_{0};
  std::atomic<size_t> helping_{0};
  std::atomic<bool> ending_{false};
  // Set while nobody helps, and read by those who do.
  const std::function<void(size_t)>* work_ = nullptr;  ///< null: there is none
  size_t parts_ = 0;
  std::atomic<size_t> next_part_{0};
};

/// Work of several kinds that one Workers::run() shares out, in the order in which it is added: what takes
/// longest comes first. No part may touch what another one changes.
class WorkBatch {
 public:
  /// One part.
  template <typename Work>
  void add(Work work) {
    kinds_.push_back({parts_++, [work](size_t) { work(); }});
  }
  /// As Workers::share(): work(its items) for each part. The items must outlive run().
  template <typename Item, typename Work>
  void share(std::span<Item> items, size_t each, Work work) {
    kinds_.push_back({parts_, [items, each, work](size_t part) {
                        const std::span<Item> from = items.subspan(part * each);
                        work(from.first(std::min(each, from.size())));
                      }});
    parts_ += Workers::parts_of(items.size(), each);
  }
  void run(Workers& workers) const;
  /// The same on this thread, where so little is to be done that waking another one takes longer.
  void run_alone() const;

 private:
  struct Kind {
    size_t first;  ///< part of the batch
    std::function<void(size_t part)> work;
  };
  std::vector<Kind> kinds_;
  size_t parts_ = 0;
};

}  // namespace scree
