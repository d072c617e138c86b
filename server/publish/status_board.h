// The server's state as all clients are told it: the ticks of the last second, and what the owner says of
// refusals, latency and saving. One thread.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "proto/messages.h"
#include "server/command/refusal.h"
#include "server/publish/tick_clock.h"
#include "server/world/published_state.h"

namespace scree {

/// As of StatusMessage::saving and saved_tick.
struct Saving {
  std::string how;
  Tick tick = 0;
  PagingStatus paging = {};
};

class StatusBoard {
 public:
  explicit StatusBoard(uint32_t ticks_per_second) : clock_(ticks_per_second) {}

  /// A tick has ended.
  void add(const TickDelta& delta) { clock_.add(delta.times, delta.work); }
  void set_refusals(const RefusalCounts& refusals) { refusals_ = refusals; }
  void set_latency(const LatencyStatus& latency) { latency_ = latency; }
  void set_saving(Saving saving) { saving_ = std::move(saving); }

  StatusMessage status(const PublishedState& state, size_t clients) const;

 private:
  TickClock clock_;
  RefusalCounts refusals_;
  LatencyStatus latency_;
  Saving saving_;
};

}  // namespace scree
