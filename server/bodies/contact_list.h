// Where Bullet's bodies touch, for people to look at.
#pragma once

#include <vector>

#include "proto/messages.h"

class btCollisionDispatcher;

namespace scree {

/// Appends every point of contact that bore an impulse in the last step, or that bodies rest on.
void list_contacts(const btCollisionDispatcher& dispatcher, std::vector<WatchedContact>& to);

}  // namespace scree
