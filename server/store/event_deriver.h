// Derives the world's events from ticks. A simulated tick gives all events, in the operations' order; a
// replay's ticks do not say which stage applied an operation: there dents and crushes count as carves, and a
// large carve's further cuts as breaks. A burst of merges is told when its time is over; those that are open
// when a process ends, or goes on from a saved value, are nobody's. One thread at a time.
#pragma once

#include <optional>
#include <vector>

#include "proto/event.h"
#include "server/world/tick_delta.h"

namespace scree {

/// Pieces that merge near each other within merge_burst_ticks and count as a burst: fewer happen all the time
/// while rubble comes to rest.
inline constexpr uint32_t merge_burst_min = 4;

/// Ticks from a burst's first merge to its event: 1 s at 60 Hz.
inline constexpr Tick merge_burst_ticks = 60;

/// Contacts that took at least so much energy are events, joules: a crate of 20 kg that falls by half a
/// metre.
inline constexpr float contact_event_least_j = 100.0F;

/// Contacts that are told within merge_burst_ticks, the hardest of a tick first. When that time is over, the
/// hardest of the others is told, with their number: so the hardest of all is always told.
inline constexpr uint32_t contacts_told_max = 8;

/// What became of props and joints in one tick. Above: the last that is told says how many are not.
inline constexpr size_t told_events_max = 256;

/// Where an operation of a tick acts; nothing of one that has no place.
std::optional<glm::vec3> place_of(const AppliedOperation& applied, const TickDelta& delta,
                                  float voxel_size_m);

class EventDeriver {
 public:
  /// `settings`: as they stand before the next tick. `burst_ticks`: those of the recording, not 0.
  /// `contacts_j`: likewise, the least energy of contacts that are told; 0: neither contacts nor what became
  /// of props and joints are.
  EventDeriver(float voxel_size_m, SettingValues settings, Tick burst_ticks = merge_burst_ticks,
               float contacts_j = contact_event_least_j)
      : voxel_size_m_(voxel_size_m),
        settings_(std::move(settings)),
        burst_ticks_(burst_ticks),
        contacts_j_(contacts_j) {}

  /// The next tick's.
  std::vector<Event> events_of(const TickDelta& delta);

 private:
  struct Burst {
    Tick begun = 0;
    glm::vec3 place_m{0.0F};  ///< of its first merge
    uint32_t pieces = 0;
  };

  /// The contacts of the ticks since the first that was told.
  struct ContactTime {
    Tick begun = 0;
    uint32_t told = 0;
    uint32_t left_out = 0;
    ContactEvent hardest{};  ///< of those that were left out
  };

  void add_told(const TickDelta& delta, std::vector<Event>& events) const;
  void add_contacts(const TickDelta& delta, std::vector<Event>& events);
  void add_settings(const TickDelta& delta, std::vector<Event>& events);
  void note_merges(const TickDelta& delta);
  /// The burst that a merge at that place is a part of: a new one where none is near.
  Burst& burst_near(glm::vec3 place_m, Tick tick);
  /// Bursts whose time is over, in the order in which they began.
  void add_bursts(Tick tick, std::vector<Event>& events);

  float voxel_size_m_;
  SettingValues settings_;
  Tick burst_ticks_;
  float contacts_j_;
  std::optional<ContactTime> contacts_;  ///< nothing: none was told lately
  std::vector<Burst> bursts_;            ///< that may grow, in the order in which they began
};

}  // namespace scree
