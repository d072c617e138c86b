// Derives the world's events from ticks. Of a simulated tick all follow, in the operations' order; a replay's
// ticks do not say which stage applied an operation: there dents and crushes count as carves, and a large
// carve's further cuts as breaks. One thread at a time.
#pragma once

#include <vector>

#include "proto/event.h"
#include "server/world/tick_delta.h"

namespace scree {

/// Pieces that merge in one tick and count as a burst: fewer happen all the time while rubble comes to rest.
inline constexpr uint32_t merge_burst_min = 4;

class EventDeriver {
 public:
  /// `settings`: as they stand before the next tick.
  EventDeriver(float voxel_size_m, SettingValues settings)
      : voxel_size_m_(voxel_size_m), settings_(std::move(settings)) {}

  /// The next tick's.
  std::vector<Event> events_of(const TickDelta& delta);

 private:
  void add_settings(const TickDelta& delta, std::vector<Event>& events);

  float voxel_size_m_;
  SettingValues settings_;
};

}  // namespace scree
