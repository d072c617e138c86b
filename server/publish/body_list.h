// Lists of the bodies and joints that there are, for directors and administrators (proto/access.proto). They
// read the published state alone.
#pragma once

#include <memory>

#include "proto/messages.h"
#include "server/publish/motions.h"
#include "server/publish/served_tick.h"
#include "server/world/published_state.h"

namespace scree {

/// What the rows are made of. `palette`: by which pieces weigh; null: their masses are not known.
struct ListedWorld {
  const PublishedState& state;
  const Motions& motions;
  std::shared_ptr<const Palette> palette{};
  float voxel_size_m = 1.0F;
  PublishRates rates;
};

AdminListMessage list_bodies(const ListedWorld& world, const ListBodiesRequest& request);
AdminListMessage list_joints(const ListedWorld& world, const ListJointsRequest& request);

}  // namespace scree
