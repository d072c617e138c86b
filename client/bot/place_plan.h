// How a bot divides what it carries among its places: equal shares, each of the material that it has most of.
// A value.
#pragma once

#include <cstdint>

#include "shared/field/material_window.h"

namespace scree {

class PlacePlan {
 public:
  PlacePlan(MaterialMasses carried, uint32_t places) : carried_(std::move(carried)), places_(places) {}

  /// The share of the next place; of no mass where nothing is carried.
  MaterialMass next();

 private:
  MaterialMasses carried_;  ///< that no place has got yet
  uint32_t places_;         ///< that have not got a share yet
};

/// Radius of a ball of rubble that takes nine tenths of a mass, so that rounding never asks for more than
/// there is. `fill` is the rubble's, in 128ths.
float ball_radius_m(MassUnits mass, int fill, float voxel_size_m);

}  // namespace scree
