#include "shared/operation/stamp_groups.h"

#include <algorithm>

#include "shared/recombine/stamp.h"

namespace scree {

namespace {

struct Group {
  std::vector<StampedPiece> places;
  VoxelBox box;
  size_t voxels = 0;  ///< of the pieces' own boxes together
};

bool may_join(const Group& group, const StampedPiece& one, const VoxelBox& box, const PieceTable& pieces) {
  if (common(group.box, box).empty()) return false;
  if (Window::count(hull_of(group.box, box)) > group.voxels + Window::count(box)) return false;
  std::vector<StampedPiece> joined = group.places;
  joined.push_back(one);
  return can_merge_together(joined, pieces);
}

}  // namespace

std::vector<std::vector<StampedPiece>> stamp_groups(std::span<const StampedPiece> places,
                                                    const PieceTable& pieces, float voxel_size_m) {
  std::vector<Group> groups;
  for (const StampedPiece& one : places) {
    const VoxelBox box = stamp_box(*pieces.at(one.piece), one.pose, voxel_size_m);
    auto found =
        std::ranges::find_if(groups, [&](const Group& group) { return may_join(group, one, box, pieces); });
    if (found == groups.end()) found = groups.insert(groups.end(), Group{{}, box, 0});
    found->places.push_back(one);
    found->box = hull_of(found->box, box);
    found->voxels += Window::count(box);
  }
  std::vector<std::vector<StampedPiece>> out;
  for (Group& group : groups) out.push_back(std::move(group.places));
  return out;
}

}  // namespace scree
