// Volumes of full voxels, as clients bring them.
#pragma once

#include <functional>
#include <optional>

#include "proto/operation_codec.h"
#include "shared/operation/request.h"

namespace scree {

/// What a voxel is of; nothing: it is empty.
using VoxelsOf = std::function<std::optional<Material>(VoxelCoord)>;

inline Volume given_voxels(VoxelCoord size, const VoxelsOf& voxels) {
  Volume volume;
  volume.window = Window(VoxelBox{{}, size});
  volume.materials.box = volume.window.box;
  volume.materials.each.resize(volume.window.codes.size());
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      for (int z = 0; z < size.z; ++z) {
        const size_t at = volume.window.index(x, y, z);
        const std::optional<Material> one = voxels({x, y, z});
        volume.window.codes[at] = one ? code_solid : code_air;
        volume.materials.each[at] = one.value_or(Material{});
      }
  volume.masses = masses_of(volume.window, volume.materials);
  volume.mass = sum_of(volume.masses);
  if (volume.masses.size() > 1) return volume;
  volume.materials = {volume.window.box, volume.masses.empty() ? Material{} : volume.masses[0].material, {}};
  volume.masses.clear();
  return volume;
}

/// A block of one material.
inline Volume given_block(VoxelCoord size, Material material = material::rock) {
  return given_voxels(size, [=](VoxelCoord) { return material; });
}

inline AddPieceRequest piece_of(const Volume& volume, glm::vec3 place_m) {
  return {.volume = std::make_shared<const Volume>(volume), .place_m = place_m};
}

}  // namespace scree
