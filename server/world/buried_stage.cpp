#include "server/world/buried_stage.h"

#include <algorithm>

#include "server/work/limits.h"
#include "server/world/limits.h"
#include "server/world/merge_stage.h"
#include "shared/field/edit.h"
#include "shared/field/window.h"

namespace scree {

namespace {

/// Step along each axis with which at most limits::buried_samples voxels of the window are tested.
int stride_of(const Window& window) {
  const VoxelCoord size = window.box.size();
  int stride = 1;
  const auto samples = [&] {
    const auto along = [&](int n) { return (n + stride - 1) / stride; };
    return along(size.x) * along(size.y) * along(size.z);
  };
  while (samples() > limits::buried_samples) ++stride;
  return stride;
}

/// Whether at least limits::buried_share of the tested solid voxels lie where `in_rock` holds.
bool lies_within(const Volume& volume, const Pose& pose, float voxel_size_m, const InRock& in_rock) {
  const VoxelBox& box = volume.window.box;
  const int stride = stride_of(volume.window);
  const glm::vec3 centre = pose.position_m / voxel_size_m;
  int solid = 0, inside = 0;
  for (int x = box.lo.x; x < box.hi.x; x += stride)
    for (int y = box.lo.y; y < box.hi.y; y += stride)
      for (int z = box.lo.z; z < box.hi.z; z += stride) {
        if (volume.window.at(x, y, z) >= 0) continue;
        ++solid;
        const glm::vec3 offset = glm::vec3(x, y, z) - volume.centre_voxels;
        if (in_rock(centre + pose.rotation * offset)) ++inside;
      }
  // No tested voxel of a very thin piece may be solid: its centre of mass decides.
  if (solid == 0) return in_rock(centre);
  return static_cast<float>(inside) >= limits::buried_share * static_cast<float>(solid);
}

bool lies_within(const World::State& state, PieceId id, const InRock& in_rock) {
  return lies_within(*state.pieces.at(id), state.bodies.state(id).pose, state.config.terrain.voxel_size_m,
                     in_rock);
}

/// Those that may become terrain.
std::vector<PieceId> pieces_near(const World::State& state, const VoxelBox& bounds) {
  const float dx = state.config.terrain.voxel_size_m;
  const auto position_m = [&](VoxelCoord v) { return glm::vec3(v.x, v.y, v.z) * dx; };
  std::vector<PieceId> near = state.bodies.near(position_m(bounds.lo), position_m(bounds.hi));
  std::erase_if(near, [&](PieceId id) { return state.props.contains(id) || state.traits_of(id).kept; });
  return near;
}

/// Places whose voxel has at most that code.
InRock codes_up_to(int code_max, Field& field) {
  return [&field, code_max](glm::vec3 p_voxels) {
    const VoxelCoord voxel{floor_to_int(p_voxels.x + 0.5F), floor_to_int(p_voxels.y + 0.5F),
                           floor_to_int(p_voxels.z + 0.5F)};
    const VoxelCoord first = first_voxel(brick_of(voxel));
    const int index = Brick::index(voxel.x - first.x, voxel.y - first.y, voxel.z - first.z);
    return field.brick(brick_of(voxel)).codes[static_cast<size_t>(index)] <= code_max;
  };
}

/// Adds pieces near terrain that gained rock since the last call.
void find_enclosed(World::State& state) {
  if (state.gained.empty()) return;
  const InRock in_rock = codes_up_to(limits::buried_code, state.field);
  for (const VoxelBox& box : state.gained) {
    const std::vector<PieceId> near = pieces_near(state, box);
    state.work.spend(limits::buried_look_cost_us * static_cast<float>(near.size()));
    for (const PieceId id : near)
      if (lies_within(state, id, in_rock)) state.buried.insert(id);
  }
  state.gained.clear();
}

/// Adds pieces that got stuck in another way. Each piece is tested limits::buried_scan_hz times a second.
/// One test is not enough: a piece that strikes the ground hard is in it for a tick or two. A centre of mass
/// in the air tells nearly every piece that is not buried at the cost of one voxel.
void find_stuck(World::State& state) {
  const float dx = state.config.terrain.voxel_size_m;
  const auto period = std::max<Tick>(1, state.config.tick_rate_hz / limits::buried_scan_hz);
  const InRock in_rock = codes_up_to(limits::buried_code, state.field);
  const InRock in_solid = codes_up_to(-1, state.field);
  for (const auto& [id, volume] : state.pieces) {
    if ((id + state.tick) % period != 0) continue;
    const BodyState body = state.bodies.state(id);
    if (body.frozen || state.traits_of(id).kept) continue;
    if (!in_solid(body.pose.position_m / dx) || !lies_within(*volume, body.pose, dx, in_rock))
      state.sunk.erase(id);
    else if (!state.sunk.insert(id).second)
      state.buried.insert(id);
  }
}

}  // namespace

std::vector<PieceId> pieces_within(const World::State& state, const VoxelBox& bounds, const InRock& in_rock) {
  std::vector<PieceId> found = pieces_near(state, bounds);
  std::erase_if(found, [&](PieceId id) { return !lies_within(state, id, in_rock); });
  return found;
}

uint32_t merge_enclosed(World::State& state, const Shape& shape, TickDelta& delta) {
  if (!merges(state.config.methods.recombine)) return 0;
  const Shape in_field = in_voxels(shape, state.config.terrain.voxel_size_m);
  const std::vector<PieceId> enclosed = pieces_within(
      state, band_box(in_field), [&](glm::vec3 p_voxels) { return distance(in_field, p_voxels) < 0.0F; });
  for (const PieceId id : enclosed) state.work.spend(merge_cost_us(state, id));
  merge_pieces(state, enclosed, delta);
  return static_cast<uint32_t>(enclosed.size());
}

void merge_buried(World::State& state, TickDelta& delta) {
  find_enclosed(state);
  find_stuck(state);
  std::vector<PieceId> now;
  const bool merging = merges(state.config.methods.recombine);
  TurnQueue<WaitingPiece>& turns = state.turns.buried;
  for (const PieceId id : state.buried)
    if (state.bodies.contains(id)) turns.push(state.party_of(id), {id, merge_cost_us(state, id)});
  turns.begin_tick();
  while (!turns.empty()) {
    const auto [id, cost_us] = turns.next();
    const bool merged = merging && ((now.empty() && !state.work.is_late()) || state.work.affords(cost_us));
    turns.pop(merged ? cost_us : 0.0F);
    if (merged) {
      state.work.spend(cost_us);
      now.push_back(id);
    } else if (!state.bodies.state(id).frozen) {
      state.bodies.freeze(id);
      state.work.spend(limits::buried_wait_cost_us);
    }
  }
  merge_pieces(state, now, delta);
  // Frozen for good or not, a piece that thaws is tested anew.
  if (!merging) state.buried.clear();
  const auto is_gone = [&](PieceId id) { return !state.bodies.contains(id); };
  std::erase_if(state.buried, is_gone);
  std::erase_if(state.sunk, is_gone);
}

}  // namespace scree
