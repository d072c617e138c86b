// A field's narrow band as an OpenVDB level set, for the peers that need one.
#pragma once

#include <openvdb/openvdb.h>

#include "shared/field/field.h"

namespace scree::peers {

/// The distances of the box, in metres: leaves at the surface; solid regions without leaves are filled from
/// them.
openvdb::FloatGrid::Ptr level_set_of(const Field& field, const VoxelBox& box);

}  // namespace scree::peers
