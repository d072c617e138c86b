// What the flight recorder keeps of a tick. Values; milliseconds and metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "server/world/stages.h"
#include "shared/base/ids.h"

namespace scree {

/// What a party's work within a stage of a tick cost.
struct FlightCause {
  static constexpr uint8_t no_request = 0xFF;

  uint64_t party = 0, session = 0;  ///< 0: the server's own; no session where pieces do it later
  TickStage stage = TickStage::requests;
  uint8_t request = no_request;  ///< its kind, by the index of Request
  uint16_t count = 0;            ///< requests, or operations
  float clock_ms = 0.0F;
  float price_ms = 0.0F;  ///< by the model of work
  glm::vec3 place_m{0.0F};
};

/// Where pieces lie closest, and whose they are, of a tick that was slow.
struct FlightCrowd {
  uint32_t pieces = 0;  ///< there; 0: there are few in all
  glm::vec3 place_m{0.0F};
  uint64_t party = 0;         ///< whose most of all pieces are
  uint32_t party_pieces = 0;  ///< its pieces
};

struct FlightTick {
  Tick tick = 0;
  uint64_t unix_ms = 0;  ///< at its end
  // The time on the clock, part by part.
  float began_late_ms = 0.0F;  ///< after it was due, and the tick before had ended
  float wall_ms = 0.0F;
  float terrain_in_ms = 0.0F;  ///< commands, rules, terrain that comes in
  float world_ms = 0.0F;
  float record_ms = 0.0F;     ///< handing it to the recorder, which may wait for the disk
  float keep_ms = 0.0F;       ///< handing it to the saver; terrain that goes out
  float hand_over_ms = 0.0F;  ///< to the network thread, whose queue may be full
  std::array<float, tick_stages.size()> stage_ms{};
  std::array<float, tick_stages.size()> model_ms{};
  // What the system gave.
  float thread_cpu_ms = 0.0F;
  float process_cpu_ms = 0.0F;  ///< both without what the kernel took to fetch pages from the swap
  uint32_t major_faults = 0;    ///< pages of the process that came from a disk
  uint32_t preempted = 0;       ///< times that the thread lost its processor
  // Storage and network.
  float save_ms = 0.0F;  ///< of the save that ended since the tick before; 0: none did
  uint16_t saves_skipped = 0;
  uint16_t chunk_waits = 0;  ///< times that the tick waited for terrain from the file
  float net_lag_ms = 0.0F;   ///< of the tick that the network thread took last
  float net_busy_ms = 0.0F;  ///< what it took for that
  float net_cpu_ms = 0.0F;   ///< of it on a processor
  // Work by the model, and what there was.
  uint32_t budget_us = 0, estimate_us = 0;
  uint32_t pieces = 0, contacts = 0, requests_waiting = 0;
  FlightCrowd crowd;

  float tick_ms = 0.0F;  ///< its length by the tick rate
  /// By how much it made the game late.
  float late_ms() const { return began_late_ms + (wall_ms > tick_ms ? wall_ms - tick_ms : 0.0F); }
};
static_assert(sizeof(FlightTick) <= 280);
static_assert(sizeof(FlightCause) <= 56);

}  // namespace scree
