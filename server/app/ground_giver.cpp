#include "server/app/ground_giver.h"

#include <fmt/format.h>

#include "ground/ground_search.h"
#include "shared/material/rubble.h"

namespace scree {

GroundGiver ground_giver(const std::string& path, const WorldConfig& given) {
  return [path, given](const Digest& ground, TerrainSource& terrain) -> Result<void> {
    if (given.ground != Digest{} && given.ground != ground)
      return fail(
          fmt::format("its ground is {}, and that of --ground is {}", hex_of(ground), hex_of(given.ground)));
    if (given.ground == ground) {
      terrain.heights = given.terrain.heights;
      return {};
    }
    auto found = TRY(find_ground(ground, ground_folders(path)));
    terrain.heights = std::move(found);
    return {};
  };
}

Result<GroundGiver> ground_giver(const std::string& path, const std::string& ground_path) {
  WorldConfig given;
  if (ground_path.empty()) return ground_giver(path, given);
  TRY(set_ground(ground_path, given));
  return ground_giver(path, given);
}

Result<void> set_ground(const std::string& ground_path, WorldConfig& config) {
  auto file = TRY(GroundFile::open(ground_path));
  // Bricks are of one size; another one that is asked for is refused by name.
  const auto& bricks = file->bricks();
  float& voxel_size_m = config.terrain.voxel_size_m;
  if (bricks && voxel_size_m == TerrainSource{}.voxel_size_m) voxel_size_m = bricks->voxel_size_m;
  if (bricks && bricks->voxel_size_m != voxel_size_m)
    return fail(fmt::format("{}: its stored bricks have voxels of {} m, not of {} m (--voxel-size)",
                            ground_path, bricks->voxel_size_m, voxel_size_m));
  config.ground = file->name();
  config.palette = with_rubble(file->palette());
  config.terrain.rows = config.palette->ground;
  config.terrain.heights = std::move(file);
  return {};
}

std::string terrain_text(const Digest& ground, const TerrainSource& terrain) {
  return ground == Digest{} ? std::string(name_of(terrain.kind)) : "ground " + hex_of(ground);
}

}  // namespace scree
