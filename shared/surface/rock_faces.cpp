#include "shared/surface/rock_faces.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/base/check.h"
#include "shared/base/vector_clones.h"
#include "shared/field/voxel_vector.h"

namespace scree {
namespace {

/// Facets are of one face when their normals differ by less than 5 degrees, and their planes by no more than
/// that in the cell.
constexpr float same_normal = 0.9962F;
constexpr float same_place_voxels = 0.15F;
/// Facets with fewer supporters than the first are ignored; only one with the second begins a face.
constexpr int supporters_min = 6;
constexpr int supporters_strong = 17;
/// Least sum of supporters of a face's facets: fewer are chance.
constexpr int face_supporters_min = 18;
constexpr size_t faces_max = 5;
/// Squared sine of the least angle at which two faces meet: 10 degrees; and the least volume that the normals
/// of three faces span.
constexpr float angle_min = 0.03F;
constexpr float volume_min = 0.05F;
/// A point this near to the cell may count as inside.
constexpr float miss_voxels = 0.02F;
/// The largest difference between a code and the faces' distance at which the faces explain the code.
constexpr float explained_voxels = 0.06F;
/// With fewer points, faces explain nothing.
constexpr int points_min = 4;

const glm::vec3 cell_centre(0.5F);

VoxelCoord block_point(size_t i) {
  const auto k = static_cast<int>(i);
  return {k / 16 - 1, k / 4 % 4 - 1, k % 4 - 1};
}

struct Places {
  std::array<float, block_points> x{}, y{}, z{};
};

constexpr Places make_places() {
  Places places;
  for (size_t i = 0; i < block_points; ++i) {
    places.x[i] = static_cast<float>(i / 16) - 1.0F;
    places.y[i] = static_cast<float>(i / 4 % 4) - 1.0F;
    places.z[i] = static_cast<float>(i % 4) - 1.0F;
  }
  return places;
}
constexpr Places places = make_places();

/// The sum of facets of one plane, weighted by their supporters.
struct Sum {
  glm::vec3 first_normal;  ///< normal of the first facet
  float first_distance;    ///< distance of the cell's centre from it
  glm::vec3 normal{0.0F};
  float offset = 0.0F;
  int supporters = 0;
};

void add(const Facet& facet, glm::vec3 at, std::vector<Sum>& sums) {
  const float offset = facet.offset + glm::dot(facet.normal, at);
  const float distance = glm::dot(facet.normal, cell_centre) - offset;
  auto home = std::ranges::find_if(sums, [&](const Sum& sum) {
    return glm::dot(sum.first_normal, facet.normal) > same_normal &&
           std::abs(sum.first_distance - distance) < same_place_voxels;
  });
  if (home == sums.end()) {
    if (facet.supporters < supporters_strong) return;
    home = sums.insert(home, Sum{facet.normal, distance});
  }
  const auto weight = static_cast<float>(facet.supporters);
  home->normal += facet.normal * weight;
  home->offset += offset * weight;
  home->supporters += facet.supporters;
}

RockFace face_of(const Sum& sum) {
  RockFace face{};
  CHECK_DEBUG(sum.supporters >= face_supporters_min);
  face.normal = sum.normal / std::sqrt(glm::dot(sum.normal, sum.normal));
  face.offset = sum.offset / static_cast<float>(sum.supporters);
  face.supporters = sum.supporters;
  for (size_t i = 0; i < block_points; ++i)
    face.distance[i] = face.distance_at({places.x[i], places.y[i], places.z[i]});
  return face;
}

/// The point of the cell nearest to `to` on the line along which two faces meet.
std::optional<glm::vec3> on_line(const RockFace& a, const RockFace& b, glm::vec3 to) {
  const glm::vec3 along = glm::cross(a.normal, b.normal);
  const float squared = glm::dot(along, along);
  if (squared < angle_min) return std::nullopt;
  const float da = -a.distance_at(to), db = -b.distance_at(to), c = glm::dot(a.normal, b.normal);
  const glm::vec3 nearest = to + (a.normal * (da - c * db) + b.normal * (db - c * da)) / squared;
  float low = -1e9F, high = 1e9F;
  for (int i = 0; i < 3; ++i) {
    const float from = -miss_voxels - nearest[i], until = 1.0F + miss_voxels - nearest[i];
    if (std::abs(along[i]) < 1e-6F) {
      if (from > 0.0F || until < 0.0F) return std::nullopt;
      continue;
    }
    const float s = from / along[i], t = until / along[i];
    low = std::max(low, std::min(s, t));
    high = std::min(high, std::max(s, t));
  }
  if (low > high) return std::nullopt;
  return nearest + along * std::clamp(0.0F, low, high);
}

std::optional<glm::vec3> at_corner(const RockFace& a, const RockFace& b, const RockFace& c) {
  const glm::mat3 normals = glm::transpose(glm::mat3(a.normal, b.normal, c.normal));
  if (std::abs(glm::determinant(normals)) < volume_min) return std::nullopt;
  const glm::vec3 x = glm::inverse(normals) * glm::vec3(a.offset, b.offset, c.offset);
  for (int i = 0; i < 3; ++i)
    if (x[i] < -miss_voxels || x[i] > 1.0F + miss_voxels) return std::nullopt;
  return x;
}

SCREE_VECTOR_CLONES int32_t count_explained(const std::array<float, block_points>& said,
                                            const std::array<float, block_points>& distance,
                                            const std::array<int32_t, block_points>& counted) {
  int32_t count = 0;
  for (size_t i = 0; i < block_points; ++i) {
    const float off = said[i] - distance[i];
    count += counted[i] & static_cast<int32_t>((off <= explained_voxels) & (off >= -explained_voxels));
  }
  return count;
}

SCREE_VECTOR_CLONES int32_t count_near_plane(const glm::vec3& slope, float there,
                                             const std::array<float, block_points>& distance) {
  int32_t count = 0;
  for (size_t i = 0; i < block_points; ++i) {
    float said = slope.x * places.x[i] + slope.y * places.y[i] + slope.z * places.z[i] + there;
    said = said < -band_voxels ? -band_voxels : said;
    said = said > band_voxels ? band_voxels : said;
    const float off = said - distance[i];
    count += static_cast<int32_t>((off <= explained_voxels) & (off >= -explained_voxels));
  }
  return count;
}

SCREE_VECTOR_CLONES void join(const std::array<float, block_points>& face, float sign,
                              std::array<float, block_points>& said) {
  for (size_t i = 0; i < block_points; ++i) {
    const float a = sign * said[i], b = sign * face[i];
    said[i] = sign * (a < b ? b : a);
  }
}

}  // namespace

const Facet& FacetMap::at(VoxelCoord point) {
  int32_t& slot = slots_[window_.index(point.x, point.y, point.z)];
  if (slot == 0) {
    facets_.push_back(facet_at(window_, point));
    slot = static_cast<int32_t>(facets_.size());
  }
  return facets_[static_cast<size_t>(slot) - 1];
}

PointBlock::PointBlock(const Window& window, VoxelCoord cell) {
  const auto stride = static_cast<size_t>(window.box.hi.z - window.box.lo.z);
  size_t at = 0;
  for (int x = -1; x < 3; ++x) {
    const Code* plane = &window.codes[window.index(cell.x + x, cell.y - 1, cell.z - 1)];
    for (size_t i = 0; i < 16; ++i, ++at) {
      const Code code = plane[i / 4 * stride + i % 4];
      const bool known = code != code_air && code != code_solid;
      distance[at] = decode(code);
      in_rock[at] = known && code < 0 ? 1 : 0;
      in_air[at] = known && code >= 0 ? 1 : 0;
      rock += in_rock[at];
      air += in_air[at];
    }
  }
}

bool PointBlock::is_flat() const {
  // The cell's corners: 21 is its lowest one.
  glm::vec3 slope(0.0F);
  float middle = 0.0F;
  for (size_t i = 0; i < 8; ++i) {
    const float d = distance[21 + (i >> 2) * 16 + ((i >> 1) & 1) * 4 + (i & 1)] / 4.0F;
    slope += glm::vec3((i & 4) != 0 ? d : -d, (i & 2) != 0 ? d : -d, (i & 1) != 0 ? d : -d);
    middle += d / 2.0F;
  }
  return count_near_plane(slope, middle - glm::dot(slope, cell_centre), distance) == block_points;
}

std::vector<RockFace> rock_faces(FacetMap& facets, VoxelCoord cell) {
  struct Found {
    const Facet* facet;
    glm::vec3 at;
  };
  std::array<Found, block_points> weak;
  size_t weak_count = 0;
  std::vector<Sum> sums;
  for (size_t i = 0; i < block_points; ++i) {
    const Facet& facet = facets.at(cell + block_point(i));
    if (facet.supporters >= supporters_strong) {
      add(facet, as_vector(block_point(i)), sums);
    } else if (facet.supporters >= supporters_min) {
      weak[weak_count++] = {&facet, as_vector(block_point(i))};
    }
  }
  if (sums.empty()) return {};
  for (size_t i = 0; i < weak_count; ++i) add(*weak[i].facet, weak[i].at, sums);
  std::erase_if(sums, [](const Sum& sum) { return sum.supporters < face_supporters_min; });
  std::ranges::stable_sort(sums, std::greater(), &Sum::supporters);
  if (sums.size() > faces_max) sums.resize(faces_max);
  std::vector<RockFace> faces;
  for (const Sum& sum : sums) faces.push_back(face_of(sum));
  return faces;
}

std::optional<glm::vec3> meeting_point(std::span<const RockFace* const> faces, glm::vec3 to) {
  CHECK(!faces.empty() && faces.size() <= 3);
  if (faces.size() == 1) return to - faces[0]->normal * faces[0]->distance_at(to);
  return faces.size() == 2 ? on_line(*faces[0], *faces[1], to) : at_corner(*faces[0], *faces[1], *faces[2]);
}

float explained_share(const PointBlock& block, std::span<const RockFace* const> faces, Corner corner) {
  CHECK_DEBUG(!faces.empty());
  const bool convex = corner == Corner::convex;
  const int all = convex ? block.rock : block.air;
  if (all < points_min) return 0.0F;
  std::array<float, block_points> said = faces[0]->distance;
  for (const RockFace* face : faces.subspan(1)) join(face->distance, convex ? 1.0F : -1.0F, said);
  const int explained = count_explained(said, block.distance, convex ? block.in_rock : block.in_air);
  return static_cast<float>(explained) / static_cast<float>(all);
}

}  // namespace scree
