#include "shared/field/material.h"

namespace scree {

namespace {

std::optional<Material> stored_material_at(const TerrainSource& source, glm::vec3 p_m) {
  if (source.heights == nullptr || !source.heights->bricks()) return std::nullopt;
  const glm::vec3 p = p_m / source.voxel_size_m + 0.5F;
  const BrickCoord brick = brick_of(VoxelCoord{floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)});
  const ChunkLookup lookup = stored_chunk(source, chunk_of(brick));
  return lookup.chunk == nullptr ? std::nullopt : stored_material(*lookup.chunk, index_in_chunk(brick));
}

}  // namespace

std::optional<Material> stored_material(const GeneratedChunk& chunk, int index) {
  const uint8_t number = chunk.materials[static_cast<size_t>(index)];
  return number == 0 ? std::nullopt : std::optional(static_cast<Material>(number - 1));
}

Material material_at(const TerrainSource& source, glm::vec3 p_m) {
  if (const auto stored = stored_material_at(source, p_m)) return *stored;
  const MaterialHeights at = layers_of(source);
  const bool soil = p_m.y < at.soil_below_m;
  if (!soil && p_m.y <= at.ice_above_m) return Material::rock;
  if (ground_density(source, p_m) >= 0.0F) return Material::rock;
  const Material layer = soil ? Material::soil : Material::ice;
  // One look as far up as the layer is deep, instead of a march to the surface: 0.05 µs on average.
  if (ground_density(source, p_m + glm::vec3(0.0F, traits_of(layer).layer_depth_m, 0.0F)) < 0.0F)
    return Material::rock;
  return layer;
}

}  // namespace scree
