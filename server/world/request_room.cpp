#include "server/world/request_room.h"

#include <algorithm>
#include <string>

#include "server/work/limits.h"
#include "server/work/price.h"
#include "server/world/explosion.h"
#include "server/world/limits.h"
#include "server/world/merge_stage.h"

namespace scree {

Refused no_room(const World::State& state, uint32_t seeds, uint64_t party, const PieceGrant& grant) {
  const uint32_t pieces_max = state.config.pieces_max;
  const size_t alive = state.pieces.size(), wanted = alive + seeds;
  const std::string limit = std::to_string(pieces_max), all = std::to_string(wanted);
  const std::string most = std::to_string(grant.pieces_most);
  if (seeds > pieces_max)
    return {Refusal::pieces_max,
            "a request for " + std::to_string(seeds) + " pieces never fits this server's limit of " + limit +
                " pieces (pieces-max): ask for " + limit + " seeds at most, or have the limit raised to " +
                all + " (--pieces-max)"};
  if (grant.contested)
    return {
        Refusal::pieces_share,
        "other clients share this server's room for pieces (pieces-max), and this client has " +
            std::to_string(state.shares.of(party)) + " of the " + std::to_string(alive) + " pieces: " +
            (grant.pieces_most > 0 ? "ask for " + most + " seeds at most" : "wait until some have settled")};
  return {Refusal::pieces_max,
          std::to_string(alive) + " pieces are alive and this may add " + std::to_string(seeds) +
              "; this server's limit is " + limit + " (pieces-max): wait until " +
              std::to_string(wanted - pieces_max) + " have settled, " +
              (grant.pieces_most > 0 ? "ask for " + most + " seeds at most, " : std::string()) +
              "or have the limit raised to " + all + " (--pieces-max)"};
}

std::optional<CarveRequest> carve_in(const Request& request, float voxel_size_m) {
  if (const auto* carve = std::get_if<CarveRequest>(&request)) return *carve;
  if (const auto* cut_out = std::get_if<CutOutRequest>(&request))
    return CarveRequest{.shape = cut_out->shape, .seeds = 1};
  const auto* blast = std::get_if<BlastRequest>(&request);
  if (blast == nullptr) return std::nullopt;
  return carve_of(*blast, blast_reach_m(blast->energy_j, voxel_size_m), pieces_of_blast(blast->energy_j),
                  rules::newest);
}

bool may_loosen(const Request& request) {
  const auto* carve = std::get_if<CarveRequest>(&request);
  if (carve != nullptr && carve->piece != 0) return false;
  const auto* dig = std::get_if<DigRequest>(&request);
  return carve != nullptr || std::holds_alternative<CutOutRequest>(request) ||
         std::holds_alternative<BlastRequest>(request) || std::holds_alternative<FillRequest>(request) ||
         std::holds_alternative<PlaceRequest>(request) || (dig != nullptr && dig->piece == 0);
}

PieceGrant grant_for(const World::State& state, const Command& command) {
  const std::optional<CarveRequest> carve = carve_in(command.body, state.config.terrain.voxel_size_m);
  const bool adds = std::holds_alternative<AddPieceRequest>(command.body);
  const uint32_t wanted = carve ? carve->seeds : (adds ? 1 : 0);
  if (wanted == 0) return {};
  const PieceRoom room{.alive = state.pieces.size(),
                       .pieces_max = state.config.pieces_max,
                       .bodies_load = state.work.bodies_load(),
                       .others_wait = state.requests.others_wait(party_of(command))};
  return state.shares.grant(party_of(command), wanted, room);
}

float cost_with(const World::State& state, const WaitingRequest& request, const PieceGrant& grant) {
  std::optional<CarveRequest> carve = carve_in(request.command.body, state.config.terrain.voxel_size_m);
  const bool adds = std::holds_alternative<AddPieceRequest>(request.command.body);
  if (adds && grant.pieces == 0) return limits::refusal_cost_us;
  if (!carve || grant.pieces == carve->seeds) return request.cost_us;
  if (grant.pieces == 0) return limits::refusal_cost_us;
  carve->seeds = grant.pieces;
  return price_us(Request(*carve), state.field, state.config.methods.cutter);
}

bool may_wait(const World::State& state, const WaitingRequest& request, const PieceGrant& grant) {
  const bool gets_some = grant.pieces_at_last > 0;
  const float wait_s = gets_some ? limits::room_wait_least_s : limits::room_wait_max_s;
  const auto ticks = static_cast<Tick>(wait_s * static_cast<float>(state.config.tick_rate_hz));
  return grant.pieces == 0 && (grant.may_wait || gets_some) && state.tick - request.since < ticks;
}

float relief_us(const World::State& state) {
  const float wanted = least_merge_cost_us(state) * static_cast<float>(state.rest.put_off());
  return std::min(wanted, limits::relief_share * state.work.budget_us());
}

bool may_begin(const World::State& state, float cost_us) {
  if (state.work.in_debt()) return false;
  if (state.work.bodies_load() < limits::load_max || state.work.affords(cost_us)) return true;
  const auto rest = static_cast<Tick>(limits::request_rest_s * static_cast<float>(state.config.tick_rate_hz));
  return state.tick - state.requested >= rest;
}

}  // namespace scree
