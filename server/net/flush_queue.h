// Sessions whose messages are queued and not sent yet, in the order in which they began to wait, and when
// each has its turn (flush_rate.h). The workers write; everything else is on the network thread.
//
// Invariant: each session waits once.
#pragma once

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <memory>
#include <span>
#include <vector>

#include "server/metrics/durations.h"
#include "server/net/client_session.h"
#include "server/net/flush_rate.h"
#include "shared/base/ids.h"
#include "shared/base/workers.h"

namespace scree {

class FlushQueue {
 public:
  /// `workers` must outlive this object.
  FlushQueue(asio::io_context& context, Workers& workers, uint32_t tick_rate_hz)
      : timer_(context), workers_(workers), rate_(tick_rate_hz), tick_rate_hz_(tick_rate_hz) {}

  /// The session has queued messages of this tick, which ended at `done_s`.
  void add(const std::shared_ptr<ClientSession>& session, Tick tick, double done_s);
  /// Sends the messages of those whose turn it is in this tick. `more`: as of NetHost::publish().
  void send_turn(Tick tick, bool more);
  void send_all() { send(waiting_.size()); }
  /// No timer of this object fires from now on.
  void cancel() { timer_.cancel(); }
  /// How long after their tick's end messages were given to the sockets, by session.
  const Durations& frame_age() const { return frame_age_; }

 private:
  struct Waiting {
    std::shared_ptr<ClientSession> session;
    Tick since = 0;
    double since_s = 0.0;  ///< that tick's end
  };
  void send(size_t count);
  void send_later();
  void note_age(std::span<const Waiting> sent);

  asio::steady_timer timer_;
  Workers& workers_;
  FlushRate rate_;
  double tick_rate_hz_;
  std::vector<Waiting> waiting_;  ///< by since
  Durations frame_age_;
};

}  // namespace scree
