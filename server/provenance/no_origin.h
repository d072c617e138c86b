// Mass in a region that counts which did not come out of it. Internal to server/provenance and server/world.
#pragma once

#include "server/provenance/origin_shares.h"

namespace scree {

/// What was placed in a region, or fell into it, and is of no origin: so it is not the region's own rock.
/// Terrain in regions alone has such shares; elsewhere it is all that has none.
inline constexpr MassOrigin no_origin{};

/// Takes them out.
inline void drop_foreign(OriginShares& shares) {
  std::erase_if(shares, [](const OriginShare& share) { return share.origin == no_origin; });
}

}  // namespace scree
