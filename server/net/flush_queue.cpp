#include "server/net/flush_queue.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <span>

#include "server/net/limits.h"
#include "server/publish/limits.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

void FlushQueue::add(const std::shared_ptr<ClientSession>& session, Tick tick, double done_s) {
  if (!session->wait_for_flush()) waiting_.push_back({session, tick, done_s});
}

/// A recording's ticks may go back.
void FlushQueue::send_turn(Tick tick, bool more) {
  const auto waits_still = [&](const Waiting& one) {
    return one.since <= tick && tick - one.since + 1 < limits::ticks_per_flush_max;
  };
  const auto waited = std::ranges::find_if(waiting_, waits_still) - waiting_.begin();
  send(rate_.due(waiting_.size(), static_cast<size_t>(waited), more));
  if (!more && !waiting_.empty()) send_later();
}

/// In case that no tick follows soon.
void FlushQueue::send_later() {
  const std::chrono::duration<double> wait_s(limits::flush_wait_ticks_max / tick_rate_hz_);
  timer_.expires_after(std::chrono::duration_cast<std::chrono::steady_clock::duration>(wait_s));
  timer_.async_wait([this](asio::error_code error) {
    if (!error) send_all();
  });
}

/// The first `count` that wait.
void FlushQueue::send(size_t count) {
  CHECK(count <= waiting_.size());
  timer_.cancel();
  const double begin_s = steady_now_s();
  const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<Waiting> turn(std::make_move_iterator(waiting_.begin()), std::make_move_iterator(end));
  waiting_.erase(waiting_.begin(), end);
  workers_.share(std::span(turn), limits::sessions_per_part, [](size_t, std::span<Waiting> some) {
    for (const Waiting& one : some) one.session->send_now();
  });
  for (const Waiting& one : turn) {
    one.session->flushed();
    one.session->settle();
  }
  rate_.flushed(count, steady_now_s() - begin_s);
  note_age(turn);
}

/// Those of a tick have the same age.
void FlushQueue::note_age(std::span<const Waiting> sent) {
  const double now_s = steady_now_s();
  while (!sent.empty()) {
    const double since_s = sent.front().since_s;
    const auto others =
        std::ranges::find_if(sent, [&](const Waiting& one) { return one.since_s != since_s; });
    const auto count = static_cast<size_t>(others - sent.begin());
    frame_age_.add(std::max(0.0, 1e3 * (now_s - since_s)), count);
    sent = sent.subspan(count);
  }
}

}  // namespace scree
