// What a host's rules keep, show and made of persons, in files of worlds. Internal to this folder.
#pragma once

#include <world.pb.h>

#include "proto/wire_values.h"
#include "server/formats/world_value.h"

namespace scree {

void write_world_game(kept::Moment& to, const GameValue& from);
/// Refuses what is too much to be read; a world refuses what it cannot have.
GameValue read_world_game(const kept::Moment& from, FieldChecker& check);

}  // namespace scree
