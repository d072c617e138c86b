// The difference between two pictures.
#pragma once

#include "client/render/renderer.h"

namespace scree {

/// Root mean square of the differences of the colour values as stored (gamma encoded), over all pixels and
/// the three colours, 0 to 1: 0 where the pictures are equal, 1 for black against white. A hole that covers
/// 1 % of the picture and differs by half the range gives 0.05; other rounding on another driver stays far
/// below 0.01. Fails when the sizes differ.
Result<double> picture_difference(const Image& a, const Image& b);

}  // namespace scree
