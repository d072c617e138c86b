#include "bench/support/travels.h"

#include <algorithm>
#include <cmath>

#include "shared/field/piece.h"

namespace scree {

namespace {

bool is_buried(World& world, const Volume& volume, const Pose& pose) {
  const float dx = world.config().terrain.voxel_size_m;
  const VoxelBox& box = volume.window.box;
  int solid = 0, deep = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        if (volume.window.at(x, y, z) >= 0) continue;
        ++solid;
        const glm::vec3 at =
            pose.position_m / dx + pose.rotation * (glm::vec3(x, y, z) - volume.centre_voxels);
        if (sample(world.field(), at).distance_voxels < -1.0F) ++deep;
      }
  return solid > 0 && deep * 10 >= solid * 9;
}

}  // namespace

void Travels::observe(World& world, const TickDelta& delta) {
  for (const SpawnedPiece& spawned : delta.spawned) volumes_[spawned.id] = spawned.volume;
  for (const PieceState& piece : delta.pieces) follow(world, piece);
}

size_t Travels::travellers() const {
  return static_cast<size_t>(
      std::ranges::count_if(tracks_, [](const auto& track) { return track.second.most_m > 1.0F; }));
}

void Travels::follow(World& world, const PieceState& piece) {
  const Pose pose = dequantise(piece.pose);
  const auto [found, is_new] = tracks_.try_emplace(piece.id, Track{pose.position_m});
  Track& track = found->second;
  const glm::vec3 moved = pose.position_m - track.last_m;
  track.last_m = pose.position_m;
  if (!is_buried(world, *volumes_.at(piece.id), pose)) {
    track.buried_m = 0.0F;
    return;
  }
  track.buried_m += std::sqrt(moved.x * moved.x + moved.y * moved.y + moved.z * moved.z);
  track.most_m = std::max(track.most_m, track.buried_m);
  farthest_m_ = std::max(farthest_m_, track.buried_m);
}

}  // namespace scree
