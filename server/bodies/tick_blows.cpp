#include "server/bodies/tick_blows.h"

#include <algorithm>

namespace scree {

void TickBlows::merge_into(std::vector<BodyImpact>& impacts,
                           const std::function<std::optional<float>(PieceId)>& impulse_min) const {
  for (const BodyImpact& blow : blows_) {
    const std::optional<float> least_n_s = impulse_min(blow.id);
    if (!least_n_s || blow.impulse_n_s < *least_n_s) continue;
    const auto place = std::ranges::lower_bound(impacts, blow.id, {}, &BodyImpact::id);
    if (place == impacts.end() || place->id != blow.id)
      impacts.insert(place, blow);
    else if (place->impulse_n_s < blow.impulse_n_s)
      *place = blow;
  }
}

}  // namespace scree
