// What a tick's work was estimated at, and how much of it was put off or left out. Published with every tick.
#pragma once

#include <cstddef>
#include <cstdint>

namespace scree {

/// What the price of the bodies' step is made of (work.h).
struct BodyCounts {
  size_t pieces = 0, awake = 0, ground_points = 0, contact_points = 0, pairs = 0, overlaps = 0;
  int steps = 0;
  size_t joints = 0;  ///< of bodies that are awake
};

/// A tick's work by the model of server/work/work.h, and the counts of work that was put off or left out.
struct TickWork {
  uint32_t budget_us = 0;
  uint32_t estimate_us = 0;  ///< at the tick's end; over the budget when the minimum of work was more
  BodyCounts bodies{};
  uint32_t requests_waiting = 0;     ///< put off to a later tick
  uint32_t refractures_put_off = 0;  ///< pieces that are still to be cut into smaller ones
  uint32_t merges_put_off = 0;       ///< pieces that are at rest and wait their turn
  uint32_t breaks_left_out = 0;      ///< blows that would have broken a piece
  uint32_t dents_left_out = 0;       ///< blows that would have dented the ground
  uint32_t blows_left_out = 0;       ///< blows that might have broken terrain off
  bool merging_sooner = false;       ///< a crowd: half of the rest time is enough
  uint32_t supports_put_off = 0;     ///< changed bricks that await a search for support
  uint32_t supports_given_up = 0;    ///< searches for support that ended without a result
  uint32_t islands_put_off = 0;      ///< islands, or blocks of islands, that wait to fall
  uint32_t islands_too_large = 0;    ///< components so large that they were taken for ground
  uint32_t slides_put_off = 0;       ///< places whose slopes wait to be looked at

  bool has_leftovers() const {
    return requests_waiting + refractures_put_off + merges_put_off + breaks_left_out + dents_left_out +
               blows_left_out + supports_put_off + supports_given_up + islands_put_off + islands_too_large +
               slides_put_off >
           0;
  }
};

}  // namespace scree
