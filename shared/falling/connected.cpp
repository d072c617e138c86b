#include "shared/falling/connected.h"

namespace scree {

namespace {

/// Follows the solid voxels that connect to one, and labels them.
Connected connected_to(const Window& window, VoxelCoord start, uint32_t label,
                       std::vector<uint32_t>& labels) {
  Connected found{{start, start + VoxelCoord{1, 1, 1}}, start, 0};
  std::vector<VoxelCoord> ahead;
  const auto reach = [&](VoxelCoord v) {
    if (!window.box.holds(v)) return;
    const size_t at = window.index(v.x, v.y, v.z);
    if (window.codes[at] >= 0 || labels[at] != 0) return;
    labels[at] = label;
    ahead.push_back(v);
  };
  reach(start);
  while (!ahead.empty()) {
    const VoxelCoord v = ahead.back();
    ahead.pop_back();
    ++found.voxels;
    found.box = hull_of(found.box, {v, v + VoxelCoord{1, 1, 1}});
    for (const int step : {-1, 1}) {
      reach({v.x + step, v.y, v.z});
      reach({v.x, v.y + step, v.z});
      reach({v.x, v.y, v.z + step});
    }
  }
  return found;
}

}  // namespace

ConnectedVoxels connected_in(const Window& window) {
  ConnectedVoxels found{{}, std::vector<uint32_t>(window.codes.size(), 0)};
  const VoxelBox& box = window.box;
  size_t at = 0;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z, ++at) {
        if (window.codes[at] >= 0 || found.labels[at] != 0) continue;
        const auto label = static_cast<uint32_t>(found.all.size() + 1);
        found.all.push_back(connected_to(window, {x, y, z}, label, found.labels));
      }
  return found;
}

}  // namespace scree
