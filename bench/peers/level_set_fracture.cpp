#include "bench/peers/level_set_fracture.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetFracture.h>
#include <openvdb/tools/LevelSetPlatonic.h>
#include <openvdb/tools/LevelSetSphere.h>

#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree::peers {

LevelSetPieces fracture_ball(float radius_m, float voxel_size_m, float side_m,
                             const std::vector<glm::vec3>& places_m) {
  using openvdb::FloatGrid;
  using Fracture = openvdb::tools::LevelSetFracture<FloatGrid>;
  openvdb::initialize();
  const openvdb::Vec3f origin(0.0F);
  const auto ball = openvdb::tools::createLevelSetSphere<FloatGrid>(radius_m, origin, voxel_size_m);
  const auto cube = openvdb::tools::createLevelSetCube<FloatGrid>(side_m, origin, voxel_size_m);
  Fracture::Vec3sList points;
  Fracture::QuatsList rotations;
  Random random(1);
  for (const glm::vec3& place : places_m) {
    points.emplace_back(place.x, place.y, place.z);
    openvdb::math::Quats rotation(random.unit() - 0.5F, random.unit() - 0.5F, random.unit() - 0.5F,
                                  random.unit() - 0.5F);
    rotation.normalize();
    rotations.push_back(rotation);
  }
  Fracture::GridPtrList rest = {ball};
  Fracture fracture;
  LevelSetPieces found;
  Stopwatch stopwatch;
  fracture.fracture(rest, *cube, true, &points, &rotations);
  found.milliseconds = stopwatch.lap_ms();
  found.pieces = rest.size() + fracture.fragments().size();
  return found;
}

}  // namespace scree::peers
