#include "shared/query/scene.h"

#include <glm/common.hpp>

#include "shared/query/limits.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

SolidFrame frame_of(const QuerySolid& solid, double voxel_m) {
  SolidFrame frame;
  frame.rotation = rotation_of(solid.pose.rotation);
  frame.position_m = glm::dvec3(solid.pose.position_m);
  if (solid.volume == nullptr) return frame;
  frame.centre = glm::dvec3(solid.volume->centre_voxels);
  frame.unit_m = voxel_m;
  return frame;
}

/// A box in the world around one in a frame.
SpaceBox around(const SolidFrame& frame, const glm::dvec3& lo, const glm::dvec3& hi) {
  const glm::dvec3 middle = frame.out((lo + hi) * 0.5), half = (hi - lo) * (0.5 * frame.unit_m);
  glm::dvec3 reach(0.0);
  for (int axis = 0; axis < 3; ++axis) reach += glm::abs(frame.rotation[axis]) * half[axis];
  return {middle - reach, middle + reach};
}

SpaceBox bounds_of(const QuerySolid& solid, const SolidFrame& frame) {
  constexpr SpaceBox nowhere{glm::dvec3(1.0), glm::dvec3(-1.0)};
  if (solid.volume != nullptr) {
    const VoxelBox& box = solid.volume->window.box;
    if (box.empty()) return nowhere;
    return around(frame, glm::dvec3(box.lo.x - 1, box.lo.y - 1, box.lo.z - 1),
                  glm::dvec3(box.hi.x, box.hi.y, box.hi.z));
  }
  CHECK(!solid.parts.empty() && solid.parts.size() <= limits::query_parts_max);
  SpaceBox bounds{frame.position_m, frame.position_m};
  for (const Convex& part : solid.parts) {
    CHECK(!part.points_m.empty() && part.points_m.size() <= limits::query_points_max);
    for (const glm::vec3& point : part.points_m) {
      const glm::dvec3 at = frame.out(glm::dvec3(point));
      const SpaceBox box = SpaceBox{at, at}.grown(static_cast<double>(part.radius_m));
      bounds = hull_of(bounds, box);
    }
  }
  return bounds;
}

}  // namespace

QueryScene::QueryScene(const Field& field, std::span<const QuerySolid> solids)
    : QueryScene(field, solids, nullptr) {}

QueryScene::QueryScene(const Field& field, std::span<const QuerySolid> solids, FieldCells& terrain)
    : QueryScene(field, solids, &terrain) {}

QueryScene::QueryScene(const Field& field, std::span<const QuerySolid> solids, FieldCells* kept)
    : field_(field),
      voxel_m_(static_cast<double>(field.source().voxel_size_m)),
      solids_(solids),
      own_(kept == nullptr ? std::make_unique<FieldCells>(field) : nullptr),
      terrain_(kept == nullptr ? *own_ : *kept),
      cells_(solids.size()) {
  CHECK(&terrain_.field() == &field);
  std::vector<SpaceBox> boxes;
  boxes.reserve(solids.size());
  frames_.reserve(solids.size());
  for (size_t i = 0; i < solids.size(); ++i) {
    CHECK(i == 0 || solids[i - 1].id < solids[i].id);
    frames_.push_back(frame_of(solids[i], voxel_m_));
    boxes.push_back(bounds_of(solids[i], frames_.back()));
  }
  tree_ = SolidTree(std::move(boxes));
}

VolumeCells& QueryScene::cells(size_t index) const {
  CHECK(solids_[index].volume != nullptr);
  std::unique_ptr<VolumeCells>& cells = cells_[index];
  if (cells == nullptr) cells = std::make_unique<VolumeCells>(solids_[index].volume->window);
  return *cells;
}

}  // namespace scree
