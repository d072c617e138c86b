// OpenVDB's way to find loose terrain: segmentSDF of the whole field.
#pragma once

#include <cstddef>

#include "shared/field/field.h"

namespace scree {

struct PeerSegments {
  double milliseconds = 0.0;
  size_t segments = 0;
  size_t leaves = 0;  ///< of the level set that was segmented
};

/// Segments the solid within the box, which is first copied into a level set of floats (not timed).
PeerSegments segment_with_openvdb(const Field& field, const VoxelBox& box);

}  // namespace scree
