#include "server/world/region_masses.h"

#include <algorithm>

#include "server/provenance/no_origin.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

TracedWorld traced(World::State& state) {
  return {state.field, state.pieces, state.materials, state.regions.zones(), state.provenance};
}

MassUnits dust_of(const World::State& state, Material material) {
  const auto& rows = state.materials.rows();
  const size_t row = row_number(material);
  return row < rows.size() ? rows[row].dust : 0;
}

/// How much there is at a place; a most that is never reached where only the terrain could tell.
MassUnits most_at(const World::State& state, const MassPlace& place) {
  return std::visit(
      Overloaded{[&](const TerrainPlace& at) -> MassUnits {
                   const bool known = at.region == 0 || state.regions.zones().counts(at.region);
                   return known && state.in_world(at.brick) ? MassUnits{units_per_voxel} * brick_voxels : 0;
                 },
                 [&](const PiecePlace& at) -> MassUnits {
                   const auto piece = state.pieces.find(at.piece);
                   return piece == state.pieces.end() ? 0
                                                      : mass_of(masses_of(*piece->second), place.material);
                 },
                 [&](const StorePlace& at) { return state.stores.mass_of(at.store, place.material); },
                 [&](const DustPlace&) { return dust_of(state, place.material); },
                 [](const NoPlace&) { return limits::ledger_mass_max; }},
      place.at);
}

}  // namespace

std::optional<OperationTrace> begin_trace(World::State& state, const Operation& operation,
                                          const VoxelBox& reads, const StoreName* store) {
  if (state.provenance.empty() && state.regions.zones().empty()) return std::nullopt;
  if (store == nullptr) return OperationTrace::begin(traced(state), operation, reads, nullptr);
  StoreContent content{*store, {}};
  if (const Stores::Store* const found = state.stores.find(*store)) content.masses = found->masses;
  return OperationTrace::begin(traced(state), operation, reads, &content);
}

void finish_trace(World::State& state, const std::optional<OperationTrace>& trace, const Operation& operation,
                  const Applied& applied, uint64_t party) {
  if (trace) trace->finish(traced(state), operation, applied, party);
  if (trace || !state.provenance.has_dust()) return;
  for (const MaterialFlow& flow : applied.flows)
    state.provenance.bound_dust(flow.material, dust_of(state, flow.material));
}

void carry_origins(World::State& state, const StoreName& from, const StoreName& to,
                   const MaterialMasses& masses) {
  for (const auto& [material, mass] : masses)
    state.provenance.put(
        {StorePlace{to}, material},
        state.provenance.take({StorePlace{from}, material}, mass, state.stores.mass_of(from, material)));
}

void recount(World::State& state, const RegionZones& before) {
  if (before == state.regions.zones()) return;
  for (const Region& region : before.regions())
    if (!state.regions.zones().counts(region.id)) state.provenance.forget(region.id);
  rezone(traced(state), before);
}

Result<void> restore_provenance(World::State& state, const std::vector<PlacedMass>& placed) {
  TRY(validate(placed));
  MassUnits at_place = 0;
  for (size_t i = 0; i < placed.size(); ++i) {
    const auto& [place, share] = placed[i];
    at_place = i > 0 && placed[i - 1].place == place ? at_place + share.mass : share.mass;
    if (!state.palette->has(place.material) ||
        !(share.origin == no_origin || state.regions.zones().counts(share.origin.region)) ||
        at_place > most_at(state, place))
      return fail("mass has an origin that is none, or lies where there is less");
  }
  state.provenance.restore(placed);
  return {};
}

}  // namespace scree
