#include "shared/query/scene_maker.h"

#include <algorithm>

#include "shared/prop/prop_solid.h"

namespace scree {

std::vector<Convex> convex_parts_of(const Prop& prop) {
  std::vector<Convex> parts;
  parts.reserve(prop.parts.size());
  for (const PropPart& part : prop.parts) {
    RoundedHull hull = rounded_hull_of(part);
    parts.push_back({std::move(hull.points_m), hull.radius_m});
  }
  return parts;
}

void SceneMaker::begin(size_t bodies) {
  solids_.clear();
  solids_.reserve(bodies);
  parts_.clear();
  pieces_ = 0;
  // The parts of props that are gone stay for a while.
  constexpr size_t spare = 256;
  if (known_.size() > 2 * bodies + spare) known_.clear();
}

void SceneMaker::add_piece(PieceId id, const Pose& pose, const Volume& volume) {
  CHECK(pieces_ == solids_.size());
  QuerySolid solid;
  solid.id = id;
  solid.pose = pose;
  solid.volume = &volume;
  solids_.push_back(solid);
  ++pieces_;
}

void SceneMaker::add_prop(PieceId id, const Pose& pose, const std::shared_ptr<const Prop>& prop) {
  Known& known = known_[id];
  if (known.prop != prop) known = {prop, std::make_shared<const std::vector<Convex>>(convex_parts_of(*prop))};
  QuerySolid solid;
  solid.id = id;
  solid.pose = pose;
  solid.parts = *known.parts;
  solid.groups = prop->groups;
  solids_.push_back(solid);
  parts_.push_back(known.parts);
}

void SceneMaker::put_in_order() {
  const auto by_id = [](const QuerySolid& a, const QuerySolid& b) { return a.id < b.id; };
  const auto props = solids_.begin() + static_cast<std::ptrdiff_t>(pieces_);
  std::inplace_merge(solids_.begin(), props, solids_.end(), by_id);
}

HeldScene SceneMaker::make(const Field& field) {
  put_in_order();
  if (cells_ == nullptr) cells_ = std::make_unique<FieldCells>(field);
  for (const ChunkCoord chunk : changed_) {
    const VoxelCoord first = first_voxel(chunk);
    cells_->forget({first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}});
  }
  changed_.clear();
  return {field, *cells_, std::move(solids_), std::move(parts_)};
}

HeldScene SceneMaker::make_apart(const Field& field) {
  put_in_order();
  return {field, std::move(solids_), std::move(parts_)};
}

}  // namespace scree
