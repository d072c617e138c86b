#include "server/app/tick_watch.h"

#include <algorithm>
#include <sys/resource.h>

#include "server/flight/limits.h"
#include "shared/base/wall_clock.h"

namespace scree {

namespace {

float ms_of(TickWatch::Clock::duration time) {
  return std::chrono::duration<float, std::milli>(time).count();
}

double ms_of(const timeval& time) {
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

}  // namespace

TickWatch::Counts TickWatch::counts() {
  rusage thread{}, process{};
  ::getrusage(RUSAGE_THREAD, &thread);
  ::getrusage(RUSAGE_SELF, &process);
  return {static_cast<uint64_t>(process.ru_majflt), static_cast<uint64_t>(thread.ru_nivcsw),
          ms_of(thread.ru_stime), ms_of(process.ru_stime)};
}

void TickWatch::begin(std::optional<Clock::time_point> due) {
  now_ = {};
  began_ = Clock::now();
  lap_ = {};
  if (due) now_.began_late_ms = std::max(0.0F, ms_of(began_ - std::max(*due, ended_)));
  thread_s_ = thread_cpu_s();
  process_s_ = process_cpu_s();
}

void TickWatch::storage(const SaverStatus& status, const PagerStatus& paging) {
  const uint64_t saves = status.saves + status.failures;
  if (saves != saves_) now_.save_ms = static_cast<float>(status.save_last_ms);
  const auto since = [](uint64_t now, uint64_t& before) {
    const uint64_t more = now - before;
    before = now;
    return static_cast<uint16_t>(std::min<uint64_t>(more, UINT16_MAX));
  };
  saves_ = saves;
  now_.saves_skipped = since(status.skipped, skipped_);
  now_.chunk_waits = since(paging.waits, waits_);
}

FlightTick TickWatch::end(const NetLoad& net) {
  const Counts after = counts();
  ended_ = Clock::now();
  now_.wall_ms = ms_of(ended_ - began_);
  now_.thread_cpu_ms = static_cast<float>(1e3 * (thread_cpu_s() - thread_s_));
  now_.process_cpu_ms = static_cast<float>(1e3 * (process_cpu_s() - process_s_));
  now_.major_faults = static_cast<uint32_t>(after.major_faults - before_.major_faults);
  // The kernel needs processors, too, to fetch pages from the swap: that is no work of the tick's.
  if (now_.major_faults >= limits::flight_swap_pages) {
    const auto thread_ms = static_cast<float>(after.thread_system_ms - before_.thread_system_ms);
    const auto process_ms = static_cast<float>(after.process_system_ms - before_.process_system_ms);
    now_.thread_cpu_ms = std::max(0.0F, now_.thread_cpu_ms - std::max(0.0F, thread_ms));
    now_.process_cpu_ms = std::max(0.0F, now_.process_cpu_ms - std::max(0.0F, process_ms));
  }
  // In the first tick, the count before is another thread's, and may be larger.
  now_.preempted = static_cast<uint32_t>(after.preempted - std::min(after.preempted, before_.preempted));
  before_ = after;
  now_.net_lag_ms = net.lag_ms;
  now_.net_busy_ms = net.busy_ms;
  now_.net_cpu_ms = net.cpu_ms;
  now_.unix_ms = unix_now_ms();
  return now_;
}

}  // namespace scree
