#include "server/replay/field_diff.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

#include "server/replay/replay_source.h"

namespace scree {

namespace {

/// Ticks behind one that cannot be played in which a keyframe is looked for.
constexpr Tick keyframe_ahead_max = 1200;

struct EditedBrick {
  Brick brick;
  BrickMaterials materials{};
  uint64_t hash = 0;
};
using EditedBricks = std::map<BrickCoord, EditedBrick>;

struct Terrain {
  EditedBricks bricks;
  Tick tick = 0;
  float voxel_size_m = 0.0F;
};

/// By a keyframe, which says how the terrain was, whatever the operations before it do.
Result<Terrain> at_next_keyframe(const DiffSide& side, Tick tick, const Error& because) {
  const auto reader = TRY(RecordingReader::open(side.path));
  const Tick end = std::min(reader->last_tick(), tick + keyframe_ahead_max);
  Tick at = 0;
  for (Tick wanted = tick; wanted <= end && at < tick; ++wanted) {
    const auto near = TRY(reader->keyframe_tick_before(wanted));
    at = near;
  }
  if (at < tick) return tl::unexpected(because);
  const auto keyframe = TRY(reader->keyframe_before(at));
  if (!keyframe.has_value()) return tl::unexpected(because);
  Terrain terrain{{}, at, reader->header().world.terrain.voxel_size_m};
  for (const BrickPatch& patch : keyframe->bricks)
    terrain.bricks[patch.coord] = {patch.brick, patch.materials,
                                   brick_hash(patch.coord, patch.brick, patch.materials)};
  return terrain;
}

Result<Terrain> terrain_after(const DiffSide& side, Tick tick) {
  auto source = TRY(ReplaySource::open(side.path, tick, side.ground));
  Terrain terrain{{}, tick, source->header().world.terrain.voxel_size_m};
  if (tick == 0) return terrain;
  const auto whole = TRY(source->next());
  for (const BrickState& state : whole->bricks)
    terrain.bricks[state.coord] = {*state.brick, state.materials, state.hash};
  return terrain;
}

bool same(const EditedBricks& a, const EditedBricks& b, BrickCoord coord) {
  const auto in_a = a.find(coord), in_b = b.find(coord);
  return in_a != a.end() && in_b != b.end() && in_a->second.hash == in_b->second.hash;
}

std::vector<BrickCoord> differing(const EditedBricks& a, const EditedBricks& b) {
  std::vector<BrickCoord> bricks;
  for (const auto& [coord, brick] : a)
    if (!same(a, b, coord)) bricks.push_back(coord);
  for (const auto& [coord, brick] : b)
    if (!a.contains(coord)) bricks.push_back(coord);
  std::ranges::sort(bricks);
  return bricks;
}

std::string place_of(VoxelCoord v, float voxel_size_m) {
  const auto m = [&](int32_t c) { return static_cast<float>(c) * voxel_size_m; };
  return fmt::format("voxel {} {} {} at ({:.2f}, {:.2f}, {:.2f}) m", v.x, v.y, v.z, m(v.x), m(v.y), m(v.z));
}

/// The first voxel of a brick that both edited.
std::string within(const EditedBrick& a, const EditedBrick& b, BrickCoord coord, float voxel_size_m) {
  for (int i = 0; i < brick_voxels; ++i) {
    const auto at = static_cast<size_t>(i);
    if (a.brick.codes[at] == b.brick.codes[at]) continue;
    const VoxelCoord v = first_voxel(coord) + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7};
    return place_of(v, voxel_size_m) +
           fmt::format(" has the code {}, in the other {}", +a.brick.codes[at], +b.brick.codes[at]);
  }
  return place_of(first_voxel(coord), voxel_size_m) + " begins a brick that is painted differently";
}

}  // namespace

Result<std::string> field_difference(const DiffSide& a, const DiffSide& b, Tick tick) {
  auto one = terrain_after(a, tick), other = terrain_after(b, tick);
  if (!one || !other) {
    const Error because = one ? other.error() : one.error();
    one = at_next_keyframe(a, tick, because);
    other = at_next_keyframe(b, tick, because);
  }
  for (const auto* terrain : {&one, &other})
    if (!*terrain) return tl::unexpected(terrain->error());
  const std::vector<BrickCoord> bricks = differing(one->bricks, other->bricks);
  if (bricks.empty()) return std::string("the hashes differ, and no brick does: one of them is damaged");
  const BrickCoord first = bricks.front();
  const ChunkCoord chunk = chunk_of(first);
  const auto in_a = one->bricks.find(first), in_b = other->bricks.find(first);
  std::string text =
      fmt::format("chunk {} {} {}, brick {} {} {}: ", chunk.x, chunk.y, chunk.z, first.x, first.y, first.z);
  if (in_a != one->bricks.end() && in_b != other->bricks.end())
    text += within(in_a->second, in_b->second, first, one->voxel_size_m);
  else
    text += place_of(first_voxel(first), one->voxel_size_m) +
            (in_a == one->bricks.end() ? " begins a brick that only the other edited"
                                       : " begins a brick that the other did not edit");
  text += fmt::format("; {} {} differ", bricks.size(), bricks.size() == 1 ? "brick" : "bricks in all");
  if (one->tick != tick || other->tick != tick)
    text += fmt::format(" (by keyframes of the ticks {} and {})", one->tick, other->tick);
  return text;
}

}  // namespace scree
