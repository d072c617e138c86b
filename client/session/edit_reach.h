// How far from its eye a server lets a client edit, and how much a person carries, as the server's settings
// say. Pure functions.
#pragma once

#include <optional>

#include "proto/messages.h"

namespace scree {

/// Metres, from the eye to the nearest point of the edit. Nothing: there is no limit, as for administrators,
/// or it is not known: a status comes once a second, and servers of older releases have no such setting.
std::optional<float> edit_reach_m(const std::optional<StatusMessage>& status, Role role);

/// Cubic metres that a person's own store holds; nothing: it is not known.
std::optional<float> store_room_m3(const std::optional<StatusMessage>& status);

}  // namespace scree
