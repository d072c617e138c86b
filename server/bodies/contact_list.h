// Lists the points of contact between Bullet's bodies, for display.
#pragma once

#include <vector>

#include "proto/messages.h"

class btCollisionDispatcher;

namespace scree {

/// Appends every point of contact of the last step that is nearer than limits::contact_slack_m.
void list_contacts(const btCollisionDispatcher& dispatcher, std::vector<ContactView>& to);

}  // namespace scree
