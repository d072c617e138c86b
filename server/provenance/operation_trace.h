// Follows the mass of an operation from where it was to where it is, by origin (provenance.h).
//
// What the bricks, pieces, dust and stores lose is mixed, by material, and given to those that gain. Pieces
// that are cut out of terrain get of the bricks that they lay in first. Terrain that becomes rubble where it
// lies is not cut. An operation that touches no region that counts, and no mass with an origin, costs a look.
#pragma once

#include <optional>
#include <vector>

#include "server/provenance/provenance.h"
#include "server/provenance/region_zones.h"
#include "shared/operation/operation.h"

namespace scree {

/// What operations change, and what their mass is traced by.
struct TracedWorld {
  const Field& field;
  const PieceTable& pieces;
  const MaterialLedger& materials;
  const RegionZones& zones;
  Provenance& provenance;
};

/// A brick as it was.
struct TracedBrick {
  BrickCoord coord;
  Brick codes;
  BrickMaterials says;
};

/// A world as it was before an operation, as far as that is needed.
class OperationTrace {
 public:
  /// Nothing where the operation concerns no origin. `store`: what the store has that it deals with.
  static std::optional<OperationTrace> begin(const TracedWorld& world, const Operation& operation,
                                             const VoxelBox& reads, const StoreContent* store);

  /// The operation was applied, for that party, and the ledger has its flows. CHECKs that no mass is left
  /// over.
  void finish(const TracedWorld& world, const Operation& operation, const Applied& applied,
              uint64_t party) const;

 private:
  struct EndedPiece {
    PieceId id;
    MaterialMasses masses;
  };

  std::vector<TracedBrick> bricks_;  ///< all that the operation may change, in order
  std::vector<EndedPiece> ended_;
  std::vector<MaterialLedger::Row> rows_;
  std::optional<StoreContent> store_;
};

/// Regions that count have changed: says anew of terrain with an origin in which it lies.
void rezone(const TracedWorld& world, const RegionZones& before);

}  // namespace scree
