#include "server/store/ground_mass.h"

#include "shared/field/ground_materials.h"

namespace scree {

MassByBrick ground_masses(const TerrainSource& ground, ChunkCoord chunk) {
  const GeneratedChunk generated = generate_chunk(ground, chunk);
  MassByBrick masses{};
  for (size_t i = 0; i < masses.size(); ++i)
    masses[i] =
        static_cast<int32_t>(ground_mass(ground, brick_in_chunk(chunk, static_cast<int>(i)), generated));
  return masses;
}

GroundMasses measured_ground(const TerrainSource& ground, std::span<const BrickPatch> bricks) {
  std::map<ChunkCoord, MassByBrick> chunks;
  GroundMasses sums;
  for (const BrickPatch& patch : bricks) {
    const ChunkCoord chunk = chunk_of(patch.coord);
    auto found = chunks.find(chunk);
    if (found == chunks.end()) found = chunks.emplace(chunk, ground_masses(ground, chunk)).first;
    sums[chunk] += found->second[static_cast<size_t>(index_in_chunk(patch.coord))];
  }
  return sums;
}

}  // namespace scree
