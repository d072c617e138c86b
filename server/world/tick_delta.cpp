#include "server/world/tick_delta.h"

#include <algorithm>
#include <utility>

namespace scree {

void sort_joints(TickDelta& delta) {
  std::ranges::sort(delta.joints_removed, {}, &EndedJoint::id);
  std::ranges::stable_sort(delta.joints_added, {}, &AddedJoint::id);
  std::vector<AddedJoint> last;
  for (AddedJoint& one : delta.joints_added) {
    if (!last.empty() && last.back().id == one.id) last.pop_back();
    last.push_back(std::move(one));
  }
  delta.joints_added = std::move(last);
}

}  // namespace scree
