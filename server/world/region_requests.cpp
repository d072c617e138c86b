#include "server/world/region_requests.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "server/world/game_requests.h"
#include "server/world/limits.h"
#include "server/world/region_bodies.h"
#include "server/world/region_masses.h"
#include "server/world/slide_stage.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/plain_number.h"
#include "shared/base/text.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

std::string quoted(const std::string& name) {
  return "'" + name + "'";
}

/// "Ann, Bo, the team red"; empty: nobody.
std::string editors_of(const Region& region) {
  std::string names;
  for (const std::string& person : region.persons) names += (names.empty() ? "" : ", ") + person;
  for (const std::string& team : region.teams) names += (names.empty() ? "the team " : ", the team ") + team;
  return names;
}

/// "only a director and roles above may edit there".
std::string who_may(const Region& region) {
  switch (region.editors) {
    case RegionEditors::nobody:
      return "nobody may edit there";
    case RegionEditors::role:
      return "only the role " + std::string(name_of(region.role)) + ", and those above it, may edit there";
    case RegionEditors::persons:
      return editors_of(region).empty() ? "nobody may edit there"
                                        : "only " + editors_of(region) + " may edit there";
    case RegionEditors::all:
      return "all may edit there";
  }
  return {};
}

/// A ball around a piece that a request brings.
Shape ball_around(const AddPieceRequest& request, float voxel_size_m) {
  const VoxelBox& box = request.volume->window.box;
  const auto voxels = [](VoxelCoord v) {
    return glm::vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
  };
  const glm::vec3 middle = 0.5F * voxels(box.lo + box.hi - VoxelCoord{1, 1, 1}), size = voxels(box.size());
  return sphere(request.place_m + request.turn * (middle * voxel_size_m),
                0.5F * std::sqrt(glm::dot(size, size)) * voxel_size_m);
}

std::optional<glm::vec3> place_of_piece(const World::State& state, PieceId piece) {
  if (!state.pieces.contains(piece)) return std::nullopt;
  return state.bodies.state(piece).pose.position_m;
}

/// What a request edits: shapes of the world, and the place of a piece.
std::vector<Shape> edited_by(const World::State& state, const Request& request) {
  std::vector<Shape> edited;
  if (const std::optional<Shape> shape = shape_of(request)) edited.push_back(*shape);
  const auto add_piece = [&](PieceId piece) {
    if (const auto at_m = place_of_piece(state, piece)) edited.push_back(sphere(*at_m, 0.0F));
  };
  std::visit(Overloaded{[&](const CarveRequest& carve) { add_piece(carve.piece); },
                        [&](const BreakRequest& broken) { add_piece(broken.piece); },
                        [&](const DigRequest& dig) { add_piece(dig.piece); },
                        [&](const AddPieceRequest& add) {
                          edited.push_back(ball_around(add, state.config.terrain.voxel_size_m));
                        },
                        [](const auto&) {}},
             request);
  return edited;
}

void publish_regions(const World::State& state, TickDelta& delta) {
  delta.regions = state.regions.shared();
}

/// What hung on a region awaits its search; it may hang on another one.
void release_hung(World::State& state, RegionId id) {
  const auto hung = state.regions.hung.find(id);
  if (hung == state.regions.hung.end()) return;
  state.regions.released.insert(hung->second.begin(), hung->second.end());
  state.regions.hung.erase(hung);
}

/// Searches that go on, and islands that wait, began by other regions.
void search_again(World::State& state) {
  state.islands.restore(state.islands.value());
}

void end(World::State& state, const Region& region) {
  const RegionId id = region.id;
  const RegionZones before = state.regions.zones();
  const bool held = region.forbids_any(forbids::falls);
  state.regions.remove(id);
  state.regions.inside.erase(id);
  release_hung(state, id);
  if (held) search_again(state);
  recount(state, before);
}

}  // namespace

CheckedRequest check(const World::State& state, const SetRegionRequest& request) {
  if (const Result<void> valid = validate(request.region); !valid)
    return refuse(Refusal::region_invalid, valid.error().message);
  if (!(request.lasts_s >= 0.0F && request.lasts_s <= limits::region_lasts_max_s))
    return refuse(
        Refusal::region_invalid,
        "a region lasts " + range_text(0.0, limits::region_lasts_max_s, "s") + "; 0: until it is removed");
  if (state.regions.named(request.region.name) != nullptr || state.regions.all().size() < limits::regions_max)
    return {};
  return refuse(Refusal::regions_max, std::to_string(limits::regions_max) +
                                          " regions are there, and a world has no more: remove some");
}

CheckedRequest check(const World::State& state, const RemoveRegionRequest& request) {
  if (state.regions.named(request.name) != nullptr) return {};
  return refuse(Refusal::region_missing,
                "there is no region " + quoted(showable(request.name, limits::region_name_bytes_max)));
}

CheckedRequest check_regions(const World::State& state, const Command& command) {
  if (command.session == 0 || !state.regions.forbid_any(forbids::edits)) return {};
  const Asker asker = asker_in_game(state, command);
  for (const Shape& shape : edited_by(state, command.body))
    for (const Region& region : state.regions.all())
      if (region.forbids_any(forbids::edits) && !may_edit(region, asker) && meets(region, shape))
        return refuse(Refusal::in_region,
                      "this lies in the region " + quoted(region.name) + ": " + who_may(region));
  return {};
}

uint32_t perform(World::State& state, const SetRegionRequest& request, uint64_t /*party*/, TickDelta& delta) {
  Region region = request.region;
  if (region.form != RegionForm::box) region.half_m.z = region.half_m.x;
  if (region.form == RegionForm::sphere) region.half_m.y = region.half_m.x;
  const float ticks = request.lasts_s * static_cast<float>(state.config.tick_rate_hz);
  region.until = ticks == 0.0F ? 0 : state.tick + std::max<Tick>(1, static_cast<Tick>(ticks));
  const Region* const before = state.regions.named(region.name);
  region.id = before != nullptr ? before->id : state.next_piece++;
  const bool held = before != nullptr && before->forbids_any(forbids::falls);
  if (before != nullptr) release_hung(state, before->id);
  const bool holds_now = region.forbids_any(forbids::falls);
  const RegionId id = region.id;
  const bool tells = region.tells;
  const RegionZones counted = state.regions.zones();
  state.regions.set(std::move(region));
  recount(state, counted);
  state.regions.inside.erase(id);
  if (tells) note_inside(state, id);
  if (held || holds_now) search_again(state);
  publish_regions(state, delta);
  return 0;
}

uint32_t perform(World::State& state, const RemoveRegionRequest& request, uint64_t /*party*/,
                 TickDelta& delta) {
  const Region region = *state.regions.named(request.name);
  end(state, region);
  publish_regions(state, delta);
  return 0;
}

void end_regions(World::State& state, TickDelta& delta) {
  if (state.regions.empty()) return;
  const auto before = state.regions.shared();
  for (const Region& region : *before)
    if (region.until != 0 && region.until < state.tick) end(state, region);
  if (state.regions.shared() != before) publish_regions(state, delta);
}

void release_terrain(World::State& state) {
  std::set<ChunkCoord>& released = state.regions.released;
  for (size_t count = 0; count < limits::released_chunks_per_tick && !released.empty(); ++count) {
    const ChunkCoord chunk = *released.begin();
    released.erase(released.begin());
    const std::vector<BrickCoord> edited = state.field.edited_bricks(chunk);
    std::vector<BrickCoord> all;
    for (int brick = 0; brick < chunk_bricks * chunk_bricks * chunk_bricks; ++brick)
      all.push_back({chunk.x * chunk_bricks + brick / (chunk_bricks * chunk_bricks),
                     chunk.y * chunk_bricks + brick / chunk_bricks % chunk_bricks,
                     chunk.z * chunk_bricks + brick % chunk_bricks});
    state.loosen(0, all);
    if (edited.empty()) continue;
    if (state.config.methods.support) state.strained[0].insert(edited.begin(), edited.end());
    if (state.config.rules >= rules::slides)
      for (const BrickCoord brick : edited) state.slopes[0].insert(slope_of(brick));
  }
}

Result<void> restore_regions(World::State& state, const WorldMoment& moment) {
  if (moment.regions.size() > limits::regions_max)
    return fail("it has " + std::to_string(moment.regions.size()) + " regions; a world has at most " +
                std::to_string(limits::regions_max) + " (limits.regions_max)");
  for (const Region& region : moment.regions) {
    const std::string which = "region " + quoted(region.name);
    if (const Result<void> valid = validate(region); !valid)
      return fail(which + ": " + valid.error().message);
    const bool has_other = state.pieces.contains(region.id) || state.props.contains(region.id) ||
                           state.joints.contains(region.id);
    const bool ascends = state.regions.empty() || state.regions.all().back().id < region.id;
    if (region.id == 0 || region.id >= state.next_piece || has_other || !ascends)
      return fail(which + " is none yet, or has another's id");
    if (state.regions.named(region.name) != nullptr) return fail(which + " comes twice");
    state.regions.set(region);
    if (region.tells) note_inside(state, region.id);
  }
  for (const HungTerrain& hung : moment.hung) {
    const auto is_it = [&](const Region& region) { return region.id == hung.region; };
    if (hung.chunks.empty() || hung.chunks.size() > limits::hung_chunks_max ||
        std::ranges::none_of(state.regions.all(), is_it) || state.regions.hung.contains(hung.region))
      return fail("terrain hangs on a region that is not there");
    state.regions.hung[hung.region] = {hung.chunks.begin(), hung.chunks.end()};
  }
  state.regions.released = {moment.released.begin(), moment.released.end()};
  const float chunk_m = static_cast<float>(chunk_size) * state.config.terrain.voxel_size_m;
  const auto is_in_world = [&](ChunkCoord chunk) {
    const int most = std::max({std::abs(chunk.x), std::abs(chunk.y), std::abs(chunk.z)});
    return static_cast<float>(most) * chunk_m <= 2.0F * limits::world_half_width_m;
  };
  const auto are_in_world = [&](const std::set<ChunkCoord>& chunks) {
    return std::ranges::all_of(chunks, is_in_world);
  };
  for (const auto& [region, chunks] : state.regions.hung)
    if (!are_in_world(chunks)) return fail("terrain hangs on a region outside the world");
  if (!are_in_world(state.regions.released)) return fail("terrain hung on a region outside the world");
  return {};
}

void enter_regions(const World::State& state, WorldMoment& moment) {
  moment.regions = state.regions.all();
  for (const auto& [region, chunks] : state.regions.hung)
    moment.hung.push_back({region, {chunks.begin(), chunks.end()}});
  moment.released = {state.regions.released.begin(), state.regions.released.end()};
}

}  // namespace scree
