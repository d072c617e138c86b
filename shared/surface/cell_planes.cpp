#include "shared/surface/cell_planes.h"

#include <cmath>
#include <glm/mat3x3.hpp>

#include "shared/base/check.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Codes of half a voxel, and a rounding more or less: people build with faces half-way between voxels.
constexpr int half_least = 20, half_most = 22;
/// A face says a point's code up to roundings of this.
constexpr float same_face_codes = 2.0F;
/// Cosine of an angle within the errors of the field's direction: 8 degrees.
constexpr float straight_cosine = 0.99F;
/// Planes that pass by the meeting point farther away than this are of no common edge.
constexpr float meeting_voxels = 0.2F;
/// Share of the planes' weight that holds a vertex where the planes say nothing, such as along an edge:
/// normals have errors of some hundredths, which must not move it there.
constexpr float hold = 0.002F;
/// Sine of the angle to an edge at which a third face cuts it off.
constexpr float third_face_sine = 0.35F;

bool is_half_a_voxel(int code) {
  return std::abs(code) >= half_least && std::abs(code) <= half_most;
}

}  // namespace

WindowSteps::WindowSteps(const Window& window) {
  const VoxelCoord size = window.box.size();
  along = {std::ptrdiff_t{size.y} * size.z, size.z, 1};
  for (size_t i = 0; i < cell_corners; ++i) {
    const VoxelCoord at = cell_corner(static_cast<int>(i));
    const glm::vec3 off = as_vector(at);
    corners[i] = {at.x * along[0] + at.y * along[1] + at.z * along[2], off};
    for (size_t axis = 0; axis < 3; ++axis) {
      const int way = off[static_cast<int>(axis)] > 0.0F ? 1 : -1;
      glm::vec3 beyond_off = off;
      beyond_off[static_cast<int>(axis)] += static_cast<float>(way);
      beyond[i * 3 + axis] = {corners[i].by + way * along[axis], beyond_off};
    }
  }
}

uint16_t FaceMap::look(size_t index) {
  const FacePlane plane = face_plane_at(&window_.codes[index], steps_.along[0], steps_.along[1]);
  if (!plane.is_known()) return none;
  faces_.push_back({plane.direction(), decode(plane.code)});
  CHECK(faces_.size() < none);
  return static_cast<uint16_t>(faces_.size());
}

glm::vec3 CellVertex::direction_about(const FaceMap& faces, size_t cell_index) {
  const WindowSteps& steps = faces.steps();
  const Code* const codes = &faces.window().codes[cell_index];
  std::array<int, 3> sum{};
  for (size_t i = 0; i < steps.beyond.size(); ++i) {
    const int code = codes[steps.beyond[i].by];
    sum[i % 3] += steps.beyond[i].by > steps.corners[i / 3].by ? code : -code;
  }
  const glm::vec3 slope(sum[0], sum[1], sum[2]);
  const float squared = glm::dot(slope, slope);
  return squared > 0.0F ? slope / std::sqrt(squared) : slope;
}

void CellPlanes::look_beyond(FaceMap& faces, CellVertex& home) {
  CHECK_DEBUG(count_ > 0);
  const WindowSteps& steps = faces.steps();
  const Code* const codes = &faces.window().codes[home.index];
  const glm::vec3 rise = normal_[0] * codes_per_voxel;
  for (size_t i = 0; i < steps.beyond.size(); ++i) {
    const std::ptrdiff_t corner = steps.corners[i / 3].by, beyond = steps.beyond[i].by;
    const float way = beyond > corner ? 1.0F : -1.0F;
    const float said = static_cast<float>(codes[corner]) + way * rise[static_cast<int>(i % 3)];
    if (std::abs(said - static_cast<float>(codes[beyond])) > same_face_codes)
      add(faces, home, steps.beyond[i]);
  }
}

void CellPlanes::look_across(const FaceMap& faces, const CellVertex& home) {
  const Code* const codes = &faces.window().codes[home.index];
  const auto& corners = faces.steps().corners;
  count_ = 0;
  for (size_t i = 0; i < corners.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const size_t bit = size_t{4} >> axis;
      if ((i & bit) != 0) continue;
      const int low = codes[corners[i].by], high = codes[corners[i | bit].by];
      if ((low < 0) == (high < 0)) continue;
      if (!is_half_a_voxel(low) || !is_half_a_voxel(high)) {
        count_ = 0;
        return;
      }
      const float crossing = static_cast<float>(low) / static_cast<float>(low - high);
      normal_[count_] = glm::vec3(0.0F);
      normal_[count_][axis] = high < 0 ? -1.0F : 1.0F;
      distance_[count_] = normal_[count_][axis] * (home.at[axis] - crossing);
      ++count_;
    }
}

void CellPlanes::keep_near(float voxels) {
  size_t kept = 0;
  for (size_t i = 0; i < count_; ++i) {
    if (std::abs(distance_[i]) > voxels) continue;
    normal_[kept] = normal_[i];
    distance_[kept++] = distance_[i];
  }
  count_ = kept;
}

bool CellPlanes::is_straight(glm::vec3 out) const {
  for (size_t i = 0; i < count_; ++i)
    if (glm::dot(normal_[i], out) < straight_cosine) return false;
  return true;
}

/// The one whose normal differs most from the first one's.
size_t CellPlanes::farthest() const {
  size_t found = 0;
  float least = 1.0F;
  for (size_t i = 1; i < count_; ++i)
    if (const float cosine = glm::dot(normal_[0], normal_[i]); cosine < least) {
      least = cosine;
      found = i;
    }
  return found;
}

std::optional<glm::vec3> CellPlanes::along_edge() const {
  const glm::vec3 along = glm::normalize(glm::cross(normal_[0], normal_[farthest()]));
  for (size_t i = 0; i < count_; ++i)
    if (std::abs(glm::dot(along, normal_[i])) > third_face_sine) return std::nullopt;
  return along;
}

std::optional<glm::vec3> CellPlanes::way_to_edge() const {
  if (!is_edge()) return std::nullopt;
  const glm::vec3 way = way_to_meeting();
  return meet_at(way) ? std::optional(way) : std::nullopt;
}

/// From the vertex to the nearest point on all of them.
glm::vec3 CellPlanes::way_to_meeting() const {
  glm::mat3 a(hold * static_cast<float>(count_));
  glm::vec3 b(0.0F);
  for (size_t i = 0; i < count_; ++i) {
    a += glm::outerProduct(normal_[i], normal_[i]);
    b -= normal_[i] * distance_[i];
  }
  return glm::inverse(a) * b;
}

/// Whether all of them pass by the point that lies this way.
bool CellPlanes::meet_at(glm::vec3 way) const {
  for (size_t i = 0; i < count_; ++i)
    if (std::abs(distance_[i] + glm::dot(normal_[i], way)) > meeting_voxels) return false;
  return true;
}

glm::vec3 CellPlanes::mean_normal() const {
  glm::vec3 sum(0.0F);
  for (size_t i = 0; i < count_; ++i) sum += normal_[i];
  return sum;
}

}  // namespace scree
