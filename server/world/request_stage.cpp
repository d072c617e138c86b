#include "server/world/request_stage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "server/world/buried_stage.h"
#include "server/world/limits.h"
#include "server/world/merge_stage.h"
#include "server/world/refusal.h"
#include "server/world/settings.h"
#include "server/world/spawn.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"

namespace scree {

namespace {

/// How many pieces a request made.
using Outcome = tl::expected<uint32_t, Refused>;

/// The initial state of a piece of a carve: it flies away from the mirror image of the impact behind the
/// shape's centre, so towards the impact, more slowly with distance, and spins. Away from the impact itself,
/// most pieces would be pressed into the rock behind them.
BodyState blast(PieceId id, glm::vec3 centre_m, const CarveRequest& request) {
  const glm::vec3 source_m = 2.0F * centre_of(request.shape) - request.impact_m;
  const glm::vec3 away = centre_m - source_m;
  const float distance_m = std::sqrt(glm::dot(away, away));
  // Plus a part upwards: a blow against flat ground would otherwise press half of the pieces into it.
  const glm::vec3 direction = away / std::max(distance_m, 0.01F) + glm::vec3(0.0F, 0.7F, 0.0F);
  const float reach_m = std::max(reach_of(request.shape), 0.01F);
  const float speed = request.blast_speed_m_s * reach_m / (reach_m + distance_m);
  Random random(request.random_seed * 0x9E3779B97F4A7C15ULL + id);
  const auto spin = [&] { return (random.unit() - 0.5F) * speed; };
  BodyState state;
  state.pose.position_m = centre_m;
  state.velocity_m_s = direction * speed;
  state.spin_rad_s = {spin(), spin(), spin()};
  return state;
}

void throw_out(World::State& state, const Applied& applied, const CarveRequest& request, TickDelta& delta) {
  const float dx = state.config.terrain.voxel_size_m;
  const auto born = [&](PieceId id, const Volume& volume) {
    return Newborn{blast(id, volume.centre_voxels * dx, request), {}};
  };
  spawn(state, applied, born, delta);
}

/// The refusal says what would help: fewer seeds, more room, or time, if the carve ever fits.
Result<void> check_room(size_t alive, uint32_t seeds, uint32_t pieces_max) {
  const size_t wanted = alive + seeds;
  if (wanted <= pieces_max) return {};
  const std::string limit = std::to_string(pieces_max), all = std::to_string(wanted);
  if (seeds > pieces_max)
    return fail("a carve of " + std::to_string(seeds) + " seeds never fits this server's limit of " + limit +
                " pieces (pieces_max): ask for " + limit + " seeds at most, or have the limit raised to " +
                all + " (--pieces-max)");
  const size_t left = pieces_max - std::min<size_t>(alive, pieces_max);
  return fail(std::to_string(alive) + " pieces are alive and the carve may add " + std::to_string(seeds) +
              "; this server's limit is " + limit + " (pieces_max): wait until " +
              std::to_string(wanted - pieces_max) + " have settled, " +
              (left > 0 ? "ask for " + std::to_string(left) + " seeds at most, " : std::string()) +
              "or have the limit raised to " + all + " (--pieces-max)");
}

Outcome carve(World::State& state, const CarveRequest& request, TickDelta& delta) {
  const CarveOperation operation{.shape = request.shape,
                                 .pattern = request.pattern,
                                 .seeds = request.seeds,
                                 .random_seed = request.random_seed,
                                 .impact_m = request.impact_m,
                                 .first_piece = state.next_piece,
                                 .cutter = state.config.methods.cutter,
                                 .authored_m = request.authored_m};
  if (Result<void> valid = validate(Operation(operation), state.pieces, state.config.terrain.voxel_size_m);
      !valid)
    return refuse(Refusal::carve_invalid, valid.error().message);
  if (!std::isfinite(request.blast_speed_m_s) || request.blast_speed_m_s < 0.0F ||
      request.blast_speed_m_s > limits::blast_speed_max_m_s)
    return refuse(Refusal::blast_speed, "the blast speed is not within 0 … " +
                                            std::to_string(limits::blast_speed_max_m_s) +
                                            " m/s (limits.blast_speed_max_m_s)");
  if (Result<void> room = check_room(state.pieces.size(), request.seeds, state.config.pieces_max); !room)
    return refuse(Refusal::pieces_max, room.error().message);
  const Applied applied = state.apply_and_record(operation, delta);
  state.enter_taken(applied);
  throw_out(state, applied, request, delta);
  return static_cast<uint32_t>(applied.created.size());
}

/// Pieces that lie in a shape that is filled become terrain with it, so that they do not travel out of it.
/// Returns their number, for the reply.
uint32_t merge_into_fill(World::State& state, const Shape& shape, TickDelta& delta) {
  const Recombination recombination = state.config.methods.recombine;
  if (recombination == Recombination::off) return 0;
  const Shape in_field = in_voxels(shape, state.config.terrain.voxel_size_m);
  const std::vector<PieceId> enclosed = pieces_within(
      state, band_box(in_field), [&](glm::vec3 p_voxels) { return distance(in_field, p_voxels) < 0.0F; });
  state.work.spend(merge_cost_us(recombination) * static_cast<float>(enclosed.size()));
  merge_pieces(state, enclosed, delta);
  return static_cast<uint32_t>(enclosed.size());
}

Outcome fill(World::State& state, const FillRequest& request, TickDelta& delta) {
  const FillOperation operation{request.shape};
  if (Result<void> valid = validate(Operation(operation), state.pieces, state.config.terrain.voxel_size_m);
      !valid)
    return refuse(Refusal::fill_invalid, valid.error().message);
  const uint32_t enclosed = merge_into_fill(state, request.shape, delta);
  const Applied applied = state.apply_and_record(operation, delta);
  state.ledger.poured += applied.terrain_gain;
  return enclosed;
}

Outcome paint(World::State& state, const PaintRequest& request, TickDelta& delta) {
  const PaintOperation operation{request.shape, request.material};
  if (Result<void> valid = validate(Operation(operation), state.pieces, state.config.terrain.voxel_size_m);
      !valid)
    return refuse(Refusal::paint_invalid, valid.error().message);
  state.apply_and_record(operation, delta);
  return 0U;
}

Outcome change(World::State& state, const SettingsRequest& request, TickDelta& delta) {
  const WorldConfig before = state.config;
  if (Result<void> done = set_all(state.config, request.settings); !done)
    return refuse(Refusal::settings_invalid, done.error().message);
  if (state.config != before) publish_settings(state, delta);
  CHECK(delta.settings.size() <= limits::settings_max);
  if (before.methods.recombine == Recombination::off && state.config.methods.recombine != Recombination::off)
    state.bodies.thaw_all();
  state.bodies.set_terrain_collider(state.config.methods.collider);
  return 0U;
}

struct Executing {
  World::State& state;
  TickDelta& delta;

  Outcome operator()(const CarveRequest& request) const { return carve(state, request, delta); }
  Outcome operator()(const FillRequest& request) const { return fill(state, request, delta); }
  Outcome operator()(const PaintRequest& request) const { return paint(state, request, delta); }
  Outcome operator()(const SettingsRequest& request) const { return change(state, request, delta); }
};

}  // namespace

void publish_settings(const World::State& state, TickDelta& delta) {
  delta.settings = print(state.config);
  delta.service = state.config.service;
}

void execute(World::State& state, const Command& command, TickDelta& delta) {
  const Outcome made = std::visit(Executing{state, delta}, command.body);
  Reply reply{command.session, command.request, {}, 0};
  if (made) {
    reply.pieces = *made;
  } else {
    reply.refusal = made.error().message;
    reply.reason = made.error().reason;
  }
  delta.replies.push_back(std::move(reply));
}

void take_in(World::State& state, std::span<const Command> commands, TickDelta& delta) {
  for (const Command& command : commands) {
    if (state.waiting.size() < limits::requests_waiting_max) {
      state.waiting.push_back(command);
      continue;
    }
    delta.replies.push_back({command.session, command.request,
                             std::to_string(state.waiting.size()) +
                                 " requests are waiting (limits.requests_waiting_max): ask again later",
                             0, Refusal::requests_waiting});
  }
}

void carry_out(World::State& state, TickDelta& delta) {
  for (bool first = true; !state.waiting.empty(); first = false) {
    const float cost = cost_us(state.waiting.front(), state.config.terrain.voxel_size_m);
    if (!first && !state.work.affords(cost)) break;
    execute(state, state.waiting.front(), delta);
    state.work.spend(cost);
    state.waiting.pop_front();
  }
  CHECK(state.waiting.size() <= limits::requests_waiting_max);
  delta.work.requests_waiting = static_cast<uint32_t>(state.waiting.size());
}

}  // namespace scree
