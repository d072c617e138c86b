// What else can be told of a world's value (server/formats/world_value.h).
#pragma once

#include "server/formats/world_value.h"

namespace scree {

/// The least number that no session or party in the value has: sessions of a new process begin with it, so
/// that nobody is taken for somebody of before.
uint64_t first_free_session(const WorldMoment& moment);

}  // namespace scree
