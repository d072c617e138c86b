// Props, joints, regions and persons of a world's value. Internal to this folder.
#pragma once

#include <world.pb.h>

#include "proto/wire_values.h"
#include "server/formats/world_value.h"

namespace scree {

void write_world_props(kept::Moment& to, const WorldMoment& from);
void read_world_props(const kept::Moment& from, WorldMoment& to, FieldChecker& check);

}  // namespace scree
