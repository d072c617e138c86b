// What work costs by the model: microseconds on one core of the machine that shared/operation/limits.h names.
// Prices are functions of the request and of the simulation's state alone. The bench worst compares them with
// the clock.
#pragma once

#include <cstdint>

#include "server/work/limits.h"
#include "shared/field/field.h"
#include "shared/fracture/cutter.h"
#include "shared/operation/price.h"
#include "shared/operation/request.h"

namespace scree {

/// How many of the wanted pieces a volume of so many voxels is cut into at once: all of them, or as many as
/// limits::first_fracture_us pays, if that is much less.
uint32_t pieces_at_once(Cutter cutter, float voxels, uint32_t wanted);
/// The cutter for a volume of so many voxels: the one that is wanted, or cheapest_cutter where that
/// one's price is over the limit.
Cutter cutter_for(Cutter wanted, float voxels, float limit_us = limits::polygons_at_once_us);
/// Making a piece of a box of so many voxels that a request brings.
float added_price_us(size_t voxels);
/// Carrying out a valid request in this field. A carve's price is that of all its pieces.
float price_us(const Request& request, const Field& field, Cutter cutter);

}  // namespace scree
