// What becomes of the rock of regions that count (server/provenance), as part of a world.
#pragma once

#include <optional>

#include "server/provenance/operation_trace.h"
#include "server/world/world_state.h"

namespace scree {

/// To be called before an operation is applied, and after the ledger has its flows.
std::optional<OperationTrace> begin_trace(World::State& state, const Operation& operation,
                                          const VoxelBox& reads, const StoreName* store);
void finish_trace(World::State& state, const std::optional<OperationTrace>& trace, const Operation& operation,
                  const Applied& applied, uint64_t party);

/// So much is about to go from a store to another.
void carry_origins(World::State& state, const StoreName& from, const StoreName& to,
                   const MaterialMasses& masses);

/// Regions have changed. Those that do not count any more are forgotten.
void recount(World::State& state, const RegionZones& before);

/// Enters what a kept world has, when all else is entered. Refuses more at a place
/// than there is, as far as that is known without reading the terrain.
Result<void> restore_provenance(World::State& state, const std::vector<PlacedMass>& placed);

}  // namespace scree
