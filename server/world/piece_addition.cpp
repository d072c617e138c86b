#include "server/world/piece_addition.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <utility>

#include "proto/limits.h"
#include "server/bodies/limits.h"
#include "server/fracture/own_volumes.h"
#include "server/work/price.h"
#include "server/world/request_room.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/operation/added_piece_limits.h"

namespace scree {

namespace {

tl::unexpected<Refused> invalid(const std::string& what) {
  return refuse(Refusal::piece_invalid, what);
}

/// Whether a speed is a number within its bound.
bool is_speed(glm::vec3 speed, float most) {
  return glm::dot(speed, speed) <= most * most;
}

CheckedRequest check_volume(const std::shared_ptr<const Volume>& volume) {
  if (volume != nullptr && is_box_of_added_piece(volume->window.box)) {
    CHECK_EQ(volume->window.codes.size(), Window::count(volume->window.box));
    CHECK(volume->materials.is_uniform() || volume->materials.box == volume->window.box);
    return {};
  }
  const std::string what =
      volume == nullptr ? "the piece has no voxels that can be read" : "the piece is too large";
  return invalid(what + ": its box has at most " + std::to_string(limits::added_piece_side_max) +
                 " voxels along a side and " + std::to_string(limits::added_piece_voxels_max) +
                 " in all, packed as a piece's volume in at most " +
                 std::to_string(limits::added_piece_bytes_max) + " bytes");
}

CheckedRequest check_materials(const Volume& volume, const Palette& palette) {
  for (size_t at = 0; at < volume.window.codes.size(); ++at) {
    const Material material = volume.materials.at(at);
    if (volume.window.codes[at] < 0 && !palette.has(material))
      return invalid("material " + std::to_string(row_number(material)) +
                     " of the piece is none of this world's palette, which has " +
                     std::to_string(palette.rows.size()) + " (0 to " +
                     std::to_string(palette.rows.size() - 1) + ")");
  }
  return {};
}

/// Room for so many pieces more, and for their voxels.
CheckedRequest check_room(const World::State& state, const std::vector<Volume>& volumes, uint64_t party,
                          const PieceGrant& grant) {
  const auto count = static_cast<uint32_t>(volumes.size());
  if (state.pieces.size() + count > state.config.pieces_max)
    return tl::unexpected(no_room(state, count, party, grant));
  size_t voxels = 0;
  for (const auto& [id, volume] : state.pieces) voxels += volume->window.codes.size();
  for (const Volume& volume : volumes) voxels += volume.window.codes.size();
  if (voxels <= limits::piece_voxels_max) return {};
  return refuse(Refusal::pieces_max, "all pieces together would have " + std::to_string(voxels) +
                                         " voxels, more than " + std::to_string(limits::piece_voxels_max) +
                                         " (limits.piece_voxels_max): wait until some have settled");
}

/// Enters the volumes as pieces that come from outside.
Applied pour(World::State& state, std::vector<Volume> volumes) {
  Applied applied;
  for (Volume& volume : volumes) {
    const PieceId id = state.next_piece + static_cast<PieceId>(applied.created.size());
    state.ledger.pieces += volume.mass;
    state.ledger.poured += volume.mass;
    CHECK(state.materials.enter(flows_poured(masses_of(volume))));
    state.pieces.emplace(id, std::make_shared<const Volume>(std::move(volume)));
    applied.created.push_back({id, {}});
  }
  return applied;
}

glm::vec3 centre_of(const std::vector<Volume>& volumes) {
  glm::vec3 sum(0.0F);
  float mass = 0.0F;
  for (const Volume& volume : volumes) {
    sum += static_cast<float>(volume.mass) * volume.centre_voxels;
    mass += static_cast<float>(volume.mass);
  }
  return sum / mass;
}

}  // namespace

CheckedRequest check(const World::State& state, const AddPieceRequest& request) {
  TRY(check_volume(request.volume));
  TRY(check_place(request.place_m, Refusal::piece_invalid, "piece"));
  TRY(check_turn(request.turn, Refusal::piece_invalid, "piece"));
  const VoxelBox& box = request.volume->window.box;
  const VoxelCoord twice = box.lo + box.hi;
  const glm::vec3 middle_voxels = 0.5F * glm::vec3(twice.x, twice.y, twice.z);
  const float dx = state.config.terrain.voxel_size_m;
  TRY(check_place(request.place_m + request.turn * (middle_voxels * dx), Refusal::piece_invalid, "piece"));
  if (!is_speed(request.velocity_m_s, limits::speed_max_m_s))
    return invalid("the piece is faster than 200 m/s, or its speed is no number");
  if (!is_speed(request.spin_rad_s, limits::spin_max_rad_s))
    return invalid("the piece spins faster than 20 rad/s, or its spin is no number");
  static_assert(limits::speed_max_m_s == 200.0F && limits::spin_max_rad_s == 20.0F);
  return {};
}

Outcome add_piece(World::State& state, const AddPieceRequest& request, uint64_t party,
                  const PieceGrant& grant, TickDelta& delta) {
  if (grant.pieces == 0) return tl::unexpected(no_room(state, 1, party, grant));
  const Volume& given = *request.volume;
  TRY(check_materials(given, *state.palette));
  Result<std::vector<Volume>> volumes = own_volumes(given, state.field.rubble());
  if (!volumes) return invalid(volumes.error().message);
  TRY(check_room(state, *volumes, party, grant));
  const size_t voxels = Window::count(given.window.box);
  for (const Volume& more : std::span(*volumes).subspan(1))
    state.work.spend(added_price_us(std::min(voxels, more.window.codes.size())));
  const float dx = state.config.terrain.voxel_size_m;
  const glm::vec3 centre_voxels = centre_of(*volumes);
  BodyState whole;
  whole.pose.rotation = request.turn / std::sqrt(glm::dot(request.turn, request.turn));
  whole.pose.position_m = request.place_m + whole.pose.rotation * (centre_voxels * dx);
  whole.velocity_m_s = request.velocity_m_s;
  whole.spin_rad_s = request.spin_rad_s;
  const PieceId first = state.next_piece;
  const auto born = [&](PieceId, const Volume& volume) {
    return Newborn{.body = part_of(whole, (volume.centre_voxels - centre_voxels) * dx),
                   .traits = {.owner = party, .kept = request.kept},
                   .may_be_concave = true};
  };
  spawn(state, pour(state, std::move(*volumes)), born, delta);
  return first;
}

}  // namespace scree
