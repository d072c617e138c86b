#include "tools/import/chunk_pyramid.h"

#include <algorithm>
#include <set>

#include "shared/base/check.h"
#include "shared/field/field.h"
#include "shared/field/redistance.h"

namespace scree {

namespace {

BrickLayout layout_around(const ChunkPyramid::Level& chunks, float voxel_size_m) {
  BrickLayout layout{voxel_size_m, chunks.begin()->first, chunks.begin()->first};
  for (const auto& [at, chunk] : chunks) {
    layout.lo = {std::min(layout.lo.x, at.x), std::min(layout.lo.y, at.y), std::min(layout.lo.z, at.z)};
    layout.hi = {std::max(layout.hi.x, at.x + 1), std::max(layout.hi.y, at.y + 1),
                 std::max(layout.hi.z, at.z + 1)};
  }
  return layout;
}

/// Levels of the coarse voxels in the box at which the fine chunk has a voxel.
void sample_levels(ChunkCoord at, const GeneratedChunk& fine, const VoxelBox& box,
                   std::vector<float>& levels) {
  const VoxelCoord first = first_voxel(at);
  const VoxelCoord half{first.x / 2, first.y / 2, first.z / 2};
  constexpr int side = chunk_size / 2;
  const VoxelBox part = common({half, half + VoxelCoord{side, side, side}}, box);
  if (part.empty()) return;
  const VoxelCoord size = box.size();
  for (int x = part.lo.x; x < part.hi.x; ++x)
    for (int y = part.lo.y; y < part.hi.y; ++y)
      for (int z = part.lo.z; z < part.hi.z; ++z) {
        const VoxelCoord voxel{x * 2, y * 2, z * 2};
        const Brick& brick = *fine.bricks[static_cast<size_t>(index_in_chunk(brick_of(voxel)))];
        const Code code =
            brick.codes[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))];
        levels[(static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(size.y) +
                static_cast<size_t>(y - box.lo.y)) *
                   static_cast<size_t>(size.z) +
               static_cast<size_t>(z - box.lo.z)] = 0.5F * decode(code);
      }
}

/// A brick's, by the eight finer ones that it shows. Each voxel is of what the voxel is that it has the code
/// of. If that says nothing, it is of what the one above is, so that a thin layer is not lost from afar.
BrickMaterials sampled_materials(const std::array<const BrickMaterials*, 8>& finer) {
  const BrickMaterials& one = *finer.front();
  const auto is_same = [&](const BrickMaterials* other) { return *other == one; };
  if (one.is_uniform() && std::ranges::all_of(finer, is_same)) return one;
  VoxelMaterials voxels;
  for (int x = 0; x < brick_size; ++x)
    for (int y = 0; y < brick_size; ++y)
      for (int z = 0; z < brick_size; ++z) {
        const BrickMaterials& from = *finer[static_cast<size_t>((x >> 2) * 4 + (y >> 2) * 2 + (z >> 2))];
        const int fx = (2 * x) & 7, fy = (2 * y) & 7, fz = (2 * z) & 7;
        const VoxelMaterial own = from.at(Brick::index(fx, fy, fz));
        voxels[static_cast<size_t>(Brick::index(x, y, z))] =
            own != ground_own ? own : from.at(Brick::index(fx, fy + 1, fz));
      }
  return BrickMaterials(voxels);
}

/// A chunk's, by the chunks of the level below; where none is stored, it says nothing.
std::shared_ptr<const PackedChunkMaterials> coarser_materials(ChunkCoord parent,
                                                              const ChunkPyramid::Level& fine) {
  static const BrickMaterials none;
  ChunkMaterials materials;
  for (int i = 0; i < static_cast<int>(chunk_brick_count); ++i) {
    const BrickCoord brick = brick_in_chunk(parent, i);
    std::array<const BrickMaterials*, 8> finer{};
    for (int k = 0; k < 8; ++k) {
      const BrickCoord at{brick.x * 2 + (k >> 2), brick.y * 2 + ((k >> 1) & 1), brick.z * 2 + (k & 1)};
      const auto found = fine.find(chunk_of(at));
      const auto* stored = found == fine.end() ? nullptr : found->second->stored_materials.get();
      finer[static_cast<size_t>(k)] = stored == nullptr ? &none : &stored->at(index_in_chunk(at));
    }
    materials[static_cast<size_t>(i)] = sampled_materials(finer);
  }
  return stored_materials_of(materials);
}

}  // namespace

ChunkPyramid::ChunkPyramid(const TerrainSource& bare, Level finest)
    : bare_(bare), level_(std::move(finest)), layout_(layout_around(level_, bare.voxel_size_m)) {}

ChunkPyramid::Level ChunkPyramid::coarser(const Level& fine, int level) const {
  TerrainSource source = bare_;
  source.voxel_size_m *= static_cast<float>(1 << level);
  MapField ground(source);
  std::set<ChunkCoord> parents;
  for (const auto& [at, chunk] : fine) parents.insert({at.x >> 1, at.y >> 1, at.z >> 1});
  Level coarse;
  for (const ChunkCoord parent : parents) {
    const VoxelCoord first = first_voxel(parent);
    const VoxelBox box =
        VoxelBox{first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}}.grown(chunk_apron);
    Window window = gather(ground, box);
    std::vector<float> levels;
    levels.reserve(window.codes.size());
    for (const Code code : window.codes) levels.push_back(decode(code));
    for (int i = 0; i < 64; ++i) {
      const ChunkCoord at{parent.x * 2 - 1 + (i >> 4), parent.y * 2 - 1 + ((i >> 2) & 3),
                          parent.z * 2 - 1 + (i & 3)};
      if (const auto found = fine.find(at); found != fine.end())
        sample_levels(at, *found->second, box, levels);
    }
    distances_from_levels(levels, window);
    GeneratedChunk made = split_into_bricks(window, parent);
    made.stored_materials = coarser_materials(parent, fine);
    coarse.emplace(parent, std::make_shared<const GeneratedChunk>(std::move(made)));
  }
  return coarse;
}

void ChunkPyramid::write(GroundWriter& writer) {
  for (int level = 0; level < layout_.levels(); ++level) {
    if (level > 0) level_ = coarser(level_, level);
    for (const auto& [at, chunk] : level_) writer.add_chunk(key_of(level, at), *chunk);
  }
}

}  // namespace scree
