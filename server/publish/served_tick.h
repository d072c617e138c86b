// What all clients have in common in a tick. While clients are served it is only read, by several threads at
// once, but for the cache, which is safe to share.
#pragma once

#include <cstdint>
#include <map>

#include "proto/messages.h"
#include "server/publish/client_view.h"
#include "server/publish/encode_cache.h"
#include "server/publish/interest_filter.h"

namespace scree {

/// How often clients are sent what.
struct PublishRates {
  uint32_t tick_rate_hz = 60;
  uint32_t ticks_per_transform = 3;
  double heartbeat_s = 0.0;

  uint32_t ticks_of(double seconds) const { return static_cast<uint32_t>(seconds * tick_rate_hz); }
  bool has_poses(Tick tick) const { return tick % ticks_per_transform == 0; }
  /// Once a second, in another tick than most others get theirs.
  bool status_due(uint64_t session, Tick tick) const { return (tick + session) % tick_rate_hz == 0; }
};

struct ServedTick {
  const TickChanges& changes;
  EncodeCache& cache;
  const StatusMessage& status;
  const std::map<uint64_t, PartyCursor>& cursors;
  const PublishRates& rates;

  Tick tick() const { return changes.delta.tick; }
};

}  // namespace scree
