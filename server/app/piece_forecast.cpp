#include "server/app/piece_forecast.h"

#include <glm/common.hpp>

#include "server/app/limits.h"
#include "shared/base/limits.h"

namespace scree {

ChunkCoord chunk_at(glm::vec3 place_m, float voxel_size_m) {
  const glm::vec3 world{limits::world_half_width_m, limits::world_half_height_m, limits::world_half_width_m};
  const glm::vec3 at = glm::clamp(place_m, -world, world) / voxel_size_m;
  return chunk_of(VoxelCoord{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)});
}

const std::vector<ChunkCoord>& PieceForecast::update(const TickDelta& delta, float voxel_size_m) {
  constexpr auto every = limits::piece_forecast_ticks;
  const float half_m = 0.5F * chunk_size * voxel_size_m;
  chunks_.clear();
  for (const PieceState& piece : delta.pieces) {
    if (piece.id % every != delta.tick % every) continue;
    const glm::vec3 at_m = dequantise(piece.pose).position_m;
    const auto [known, is_new] = places_m_.try_emplace(piece.id, at_m);
    const glm::vec3 ahead_m =
        at_m + (at_m - known->second) * (static_cast<float>(limits::piece_ahead_ticks) / every);
    known->second = at_m;
    for (const glm::vec3 place_m : {at_m, ahead_m})
      for (int corner = 0; corner < 8; ++corner)
        chunks_.push_back(chunk_at(
            place_m + half_m * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1),
            voxel_size_m));
  }
  if (places_m_.size() > 2 * delta.pieces.size() + limits::pieces_forgotten_min) places_m_.clear();
  return chunks_;
}

}  // namespace scree
