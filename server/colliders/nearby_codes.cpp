#include "server/colliders/nearby_codes.h"

#include <algorithm>

#include "server/colliders/limits.h"
#include "shared/base/check.h"

namespace scree {

void NearbyCodes::copy_around(glm::vec3 lo, glm::vec3 hi) {
  CHECK_DEBUG(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z);
  if (has(lo, hi)) return;
  codes_ = gather(field_, box_around(lo, hi).grown(limits::probe_slack_voxels));
  // No code is greater than that of air; without an early end the search runs in vectors.
  Code least = code_air;
  for (const Code code : codes_.codes) least = std::min(least, code);
  all_air_ = least == code_air;
}

void NearbyCodes::terrain_changed(const VoxelBox& box) {
  if (overlap(box, codes_.box)) codes_ = Window();
}

bool overlap(const VoxelBox& a, const VoxelBox& b) {
  return a.hi.x > b.lo.x && a.lo.x < b.hi.x && a.hi.y > b.lo.y && a.lo.y < b.hi.y && a.hi.z > b.lo.z &&
         a.lo.z < b.hi.z;
}

VoxelBox box_around(glm::vec3 lo, glm::vec3 hi) {
  return {{floor_to_int(lo.x), floor_to_int(lo.y), floor_to_int(lo.z)},
          {floor_to_int(hi.x) + 2, floor_to_int(hi.y) + 2, floor_to_int(hi.z) + 2}};
}

}  // namespace scree
