// A field with its pieces and both ledgers, which each operation is checked against, as in a world.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>
#include <map>

#include "shared/base/random.h"
#include "shared/operation/ledger.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"

namespace scree {

struct LedgerGround {
  explicit LedgerGround(const TerrainSource& source = flat_terrain) : field(source) {}

  Applied act(const Operation& operation) {
    MassUnits ended = 0;
    for (const PieceId id : pieces_ended_by(operation)) ended += pieces.at(id)->mass;
    Applied applied = apply(operation, field, pieces);
    MassUnits made = 0;
    for (const CreatedPiece& piece : applied.created) made += pieces.at(piece.id)->mass;
    ledger.terrain += applied.terrain_gain;
    ledger.pieces += made - ended;
    ledger.stored += applied.stored;
    if (std::holds_alternative<FillOperation>(operation))
      ledger.poured += applied.terrain_gain;
    else
      ledger.dust -= applied.terrain_gain + made - ended + applied.stored;
    if (applied.terrain_gain < 0) ledger.moved -= applied.terrain_gain;
    EXPECT_TRUE(materials.enter(applied.flows));
    EXPECT_TRUE(materials.agrees(ledger));
    expect_masses();
    return applied;
  }

  /// The pieces' masses by material are those of the ledger.
  void expect_masses() const {
    std::map<Material, MassUnits> sums;
    for (const auto& [id, volume] : pieces) {
      const MaterialMasses masses = masses_of(*volume);
      EXPECT_EQ(sum_of(masses), volume->mass);
      for (const MaterialMass& one : masses) {
        EXPECT_GT(one.mass, 0);
        sums[one.material] += one.mass;
      }
    }
    for (size_t row = 0; row < materials.rows().size(); ++row)
      EXPECT_EQ(materials.rows()[row].pieces, sums[static_cast<Material>(row)]) << "material " << row;
  }

  Material at(glm::vec3 p_m) const { return material_at(field, p_m); }

  MapField field;
  PieceTable pieces;
  Ledger ledger;
  MaterialLedger materials;
};

inline CarveOperation carve_ball(glm::vec3 at_m, float radius_m, uint32_t seeds, PieceId first,
                                 Cutter cutter = Cutter::field) {
  return {.shape = sphere(at_m, radius_m),
          .pattern = SeedPattern::uniform,
          .seeds = seeds,
          .random_seed = 5,
          .impact_m = at_m,
          .first_piece = first,
          .cutter = cutter};
}

inline QuantisedPose some_pose(glm::vec3 around_m, Random& random) {
  const auto off = [&] { return random.unit() * 2.0F - 1.0F; };
  const float x = off(), y = off(), z = off(), w = off();
  return quantise({around_m + glm::vec3(off(), off(), off()) * 0.5F, glm::normalize(glm::quat(w, x, y, z))});
}

}  // namespace scree
