#include "client/render/levels/surface_levels.h"

#include "client/render/levels/level_bricks.h"

namespace scree {
namespace {

/// Whether anything was edited in the part of the field that those samples span.
bool has_edits(const Field& field, int level, const VoxelBox& samples) {
  const auto fine = [level](VoxelCoord v) { return VoxelCoord{v.x << level, v.y << level, v.z << level}; };
  bool edited = false;
  for_each_chunk({fine(samples.lo), fine(samples.hi)},
                 [&](ChunkCoord chunk) { edited = edited || field.has_edits(chunk); });
  return edited;
}

}  // namespace

SurfaceLevels::SurfaceLevels(const TerrainSource& source, int levels) {
  for (int level = 0; level < levels; ++level) {
    sources_.push_back(spaced(source, level));
    coarse_.push_back(level == 0 ? nullptr : std::make_unique<MapField>(sources_.back()));
  }
}

bool SurfaceLevels::has_generated(const Field& field, int level, ChunkCoord chunk) const {
  return level == 0 ? field.has_generated(chunk) : coarse_[static_cast<size_t>(level)]->has_generated(chunk);
}

void SurfaceLevels::adopt_generated(const Field& field, int level, ChunkCoord chunk,
                                    GeneratedChunk&& generated) {
  const Field& generator = level == 0 ? field : *coarse_[static_cast<size_t>(level)];
  generator.adopt_generated(chunk, std::move(generated));
}

bool SurfaceLevels::is_rock(const Field& field, int level, VoxelCoord sample) {
  const Field& reader = level == 0 ? field : *coarse_[static_cast<size_t>(level)];
  return reader.brick(brick_of(sample)).codes.front() < 0;
}

std::optional<BlockWindows> SurfaceLevels::gather(const Field& field, int level, const VoxelBox& owned) {
  if (level == 0) return gather_windows(field, owned);
  MapField& generator = *coarse_[static_cast<size_t>(level)];
  const VoxelBox box = owned.grown(surface_nets_apron);
  if (!has_edits(field, level, box)) return gather_windows(generator, owned);
  BlockWindows windows{owned, gather_generated(generator, box), std::nullopt,
                       gather_looks(field, generator, level, box)};
  windows.before = windows.now;
  copy_edits(field, level, windows.now, encode(decode(code_air) / static_cast<float>(1 << level)));
  return windows;
}

}  // namespace scree
