#include "shared/base/workers.h"

#include <algorithm>
#include <chrono>

#include "shared/base/check.h"

namespace scree {

namespace {

/// For how long a thread looks for what it waits for before it sleeps: being woken takes as long.
constexpr std::chrono::microseconds patience(50);

template <typename Done>
void spin_until(const Done& done) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!done() && std::chrono::steady_clock::now() < until) std::this_thread::yield();
}

}  // namespace

Workers::Workers(size_t threads) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  threads = std::min(threads, threads_max);
  helpers_.reserve(threads - 1);
  while (helpers_.size() + 1 < threads) helpers_.emplace_back([this] { help(); });
}

Workers::~Workers() {
  CHECK(!at_work_);
  {
    const std::scoped_lock lock(mutex_);
    ending_ = true;
  }
  called_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

/// A thread that comes late finds no parts left and does no harm. The owner waits only for threads that still
/// help at the end.
void Workers::run(size_t parts, const std::function<void(size_t)>& work) {
  CHECK(owner_.is_the_same());
  CHECK(!at_work_);
  at_work_ = true;
  if (parts <= 1 || helpers_.empty()) {
    for (size_t part = 0; part < parts; ++part) work(part);
    at_work_ = false;
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    CHECK_EQ(helping_.load(), 0U);
    work_ = &work;
    parts_ = parts;
    next_part_ = 0;
    ++round_;
  }
  for (size_t helper = 0; helper < std::min(helpers_.size(), parts - 1); ++helper) called_.notify_one();
  run_parts();
  spin_until([this] { return helping_ == 0; });
  {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [this] { return helping_ == 0; });
    work_ = nullptr;
  }
  at_work_ = false;
}

void Workers::release_owner() {
  CHECK(!at_work_ && owner_.release());
}

void Workers::run_parts() {
  for (size_t part = next_part_++; part < parts_; part = next_part_++) (*work_)(part);
}

void Workers::help() {
  size_t helped = 0;  // the last round
  while (true) {
    spin_until([&] { return ending_ || round_ != helped; });
    std::unique_lock lock(mutex_);
    called_.wait(lock, [&] { return ending_ || round_ != helped; });
    if (ending_) return;
    helped = round_;
    if (work_ == nullptr) continue;  // too late
    ++helping_;
    lock.unlock();
    run_parts();
    lock.lock();
    if (--helping_ == 0) left_.notify_one();
  }
}

void WorkBatch::run_alone() const {
  for (size_t i = 0; i < kinds_.size(); ++i) {
    const size_t end = i + 1 < kinds_.size() ? kinds_[i + 1].first : parts_;
    for (size_t part = kinds_[i].first; part < end; ++part) kinds_[i].work(part - kinds_[i].first);
  }
}

void WorkBatch::run(Workers& workers) const {
  workers.run(parts_, [this](size_t part) {
    const auto begins_later = [](size_t one, const Kind& kind) { return one < kind.first; };
    const auto after = std::upper_bound(kinds_.begin(), kinds_.end(), part, begins_later);
    const Kind& kind = *(after - 1);  // a kind without parts comes before the one that begins where it does
    kind.work(part - kind.first);
  });
}

}  // namespace scree
