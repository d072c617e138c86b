#include "server/world/blast.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/world/ejecta.h"
#include "shared/base/random.h"
#include "shared/field/edit.h"

namespace scree {

namespace {

constexpr float place_side_m = 1.0F / 16.0F;
/// Part of a blast's speed towards the open side.
constexpr float open_share = 0.7F;
/// From the edge of the carve's box, which is read anyway, inwards: a sample reads the voxels around it.
constexpr float margin_voxels = 1.5F;

/// Where the carve opens into the air: a unit vector, shorter where that is narrow, none where there is rock,
/// or air, all around.
glm::vec3 open_side(const Field& field, const Shape& shape) {
  const float dx = field.source().voxel_size_m;
  const VoxelBox box = band_box(in_voxels(shape, dx));
  const auto corner = [](VoxelCoord c) {
    return glm::vec3(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z));
  };
  const glm::vec3 middle = 0.5F * (corner(box.lo) + corner(box.hi) - 1.0F);
  const glm::vec3 half = corner(box.hi) - 1.0F - middle - margin_voxels;
  glm::vec3 sum(0.0F);
  for (int i = 0; i < 27; ++i) {
    const glm::vec3 step(static_cast<float>(i / 9 - 1), static_cast<float>(i / 3 % 3 - 1),
                         static_cast<float>(i % 3 - 1));
    const float length2 = glm::dot(step, step);
    if (length2 == 0.0F) continue;
    const glm::vec3 direction = step / std::sqrt(length2);
    if (sample(field, middle + half * direction).distance_voxels > 0.0F) sum += direction;
  }
  constexpr float wide = 2.0F;  // of 26 directions; a half-space has 6 to 8
  return sum / std::max(std::sqrt(glm::dot(sum, sum)), wide);
}

}  // namespace

uint32_t number_of_place(glm::vec3 place_m) {
  uint64_t number = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = static_cast<uint32_t>(floor_to_int(place_m[axis] / place_side_m));
    number = (number + step) * 0x9E3779B97F4A7C15ULL;
  }
  return Random(number).next();
}

Blast::Blast(const World::State& state, const CarveRequest& request, BlowSide side) : request_(request) {
  spins_by_place_ = state.config.rules >= rules::by_place;
  ejects_ = side == BlowSide::within && state.config.rules >= rules::ejecta;
  if (spins_by_place_) open_side_ = open_side(state.field, request.shape);
}

EjectedMotion Blast::flight(glm::vec3 centre_m) const {
  const glm::vec3 middle_m = centre_of(request_.shape);
  const float reach_m = std::max(reach_of(request_.shape), 0.01F);
  if (ejects_) return ejected({middle_m, reach_m, request_.blast_speed_m_s}, open_side_, centre_m);
  const glm::vec3 away = centre_m - (2.0F * middle_m - request_.impact_m);
  const float distance_m = std::sqrt(glm::dot(away, away));
  // A blow against flat ground would otherwise press half of the pieces into it.
  return {.direction = away / std::max(distance_m, 0.01F) + open_share * open_side_,
          .speed_m_s = request_.blast_speed_m_s * reach_m / (reach_m + distance_m)};
}

BodyState Blast::thrown(PieceId id, glm::vec3 centre_m) const {
  const EjectedMotion off = flight(centre_m);
  const uint64_t which = spins_by_place_ ? number_of_place(centre_m) : id;
  Random random(request_.random_seed * 0x9E3779B97F4A7C15ULL + which);
  const auto spin = [&] { return (random.unit() - 0.5F) * off.speed_m_s; };
  BodyState state;
  state.pose.position_m = centre_m;
  state.velocity_m_s = off.direction * off.speed_m_s;
  state.spin_rad_s = {spin(), spin(), spin()};
  return state;
}

}  // namespace scree
