// The impacts of a tick whose steps are several: those of all steps but the last, which Bullet still has.
// Private to this folder.
#pragma once

#include <functional>
#include <vector>

#include "server/bodies/bodies.h"

namespace scree {

class TickBlows {
 public:
  /// A tick begins.
  void clear() { blows_.clear(); }
  /// The impacts of a step, ordered by id, one a body.
  void add(const std::vector<BodyImpact>& impacts) {
    blows_.insert(blows_.end(), impacts.begin(), impacts.end());
  }
  /// Merges the blows into the last step's impacts, which are ordered by id: the strongest of each body
  /// stays. `impulse_min(id)`: a blow must have so much; nothing for a body that is gone.
  void merge_into(std::vector<BodyImpact>& impacts,
                  const std::function<std::optional<float>(PieceId)>& impulse_min) const;

 private:
  std::vector<BodyImpact> blows_;
};

}  // namespace scree
