// Stores in files of worlds. Internal to this folder.
#pragma once

#include <world.pb.h>

#include "proto/wire_values.h"
#include "server/formats/world_value.h"

namespace scree {

void write_world_stores(kept::Moment& to, const WorldMoment& from);
/// Refuses what no store has, and stores that are not in order.
void read_world_stores(const kept::Moment& from, WorldMoment& to, FieldChecker& check);

}  // namespace scree
