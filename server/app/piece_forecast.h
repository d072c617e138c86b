// The chunks that pieces will touch soon: where each is, and where it will be if it goes on as it does. What
// reads or generates terrain ahead of them goes by it. Used by one thread.
#pragma once

#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "server/world/tick_delta.h"
#include "shared/field/coord.h"

namespace scree {

/// The chunk that holds a place; outside of the world, the one at its edge.
ChunkCoord chunk_at(glm::vec3 place_m, float voxel_size_m);

class PieceForecast {
 public:
  /// The chunks ahead of pieces after the tick that ended; each piece is examined every
  /// limits::piece_forecast_ticks ticks. A chunk may come more than once.
  const std::vector<ChunkCoord>& update(const TickDelta& delta, float voxel_size_m);

 private:
  std::unordered_map<PieceId, glm::vec3> places_m_;  ///< when they were looked at last
  std::vector<ChunkCoord> chunks_;
};

}  // namespace scree
