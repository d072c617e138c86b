// What an operation did to the mass of each material, as it is noted. Internal to this folder.
#pragma once

#include <memory>

#include "shared/base/check.h"
#include "shared/field/material_changes.h"
#include "shared/operation/operation.h"
#include "shared/recombine/stamp_materials.h"

namespace scree {

inline MaterialFlow& flow_of(Applied& applied, Material material) {
  for (MaterialFlow& flow : applied.flows)
    if (flow.material == material) return flow;
  applied.flows.push_back({.material = material});
  return applied.flows.back();
}

inline void enter_terrain(Applied& applied, const MaterialMasses& gains) {
  for (const MaterialMass& gain : gains) flow_of(applied, gain.material).terrain += gain.mass;
}

inline void enter_piece(Applied& applied, const Volume& volume, int sign) {
  for (const MaterialMass& one : masses_of(volume)) flow_of(applied, one.material).pieces += sign * one.mass;
}

/// Puts codes and materials into the field, and notes the bricks that changed.
inline void write_terrain(Field& field, const Window& codes, const AddedMaterials& added, Applied& applied) {
  enter_terrain(applied, added.gains);
  applied.changed = added.says.empty() ? scatter(field, codes) : scatter(field, codes, added.says);
}

/// The piece must be in the table.
inline std::shared_ptr<const Volume> remove_piece(PieceTable& pieces, PieceId id) {
  const auto found = pieces.find(id);
  CHECK(found != pieces.end());
  std::shared_ptr<const Volume> volume = std::move(found->second);
  pieces.erase(found);
  return volume;
}

}  // namespace scree
