#include "shared/surface/rock_faces.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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
  glm::vec3 normal;
  float offset;
  int supporters;
};

/// The sums around a cell, in the order of their first facets.
struct SumList {
  std::array<Sum, block_points> sums;
  size_t count = 0;

  std::span<Sum> all() { return {sums.data(), count}; }
};

void add(const Facet& facet, size_t point, SumList& list) {
  const glm::vec3 at(places.x[point], places.y[point], places.z[point]);
  const float offset = facet.offset + glm::dot(facet.normal, at);
  const float distance = glm::dot(facet.normal, cell_centre) - offset;
  size_t home = 0;
  for (; home < list.count; ++home) {
    const Sum& sum = list.sums[home];
    if (glm::dot(sum.first_normal, facet.normal) > same_normal &&
        std::abs(sum.first_distance - distance) < same_place_voxels)
      break;
  }
  if (home == list.count) {
    if (facet.supporters < supporters_strong) return;
    list.sums[list.count++] = {facet.normal, distance, glm::vec3(0.0F), 0.0F, 0};
  }
  Sum& sum = list.sums[home];
  const auto weight = static_cast<float>(facet.supporters);
  sum.normal += facet.normal * weight;
  sum.offset += offset * weight;
  sum.supporters += facet.supporters;
}

/// Leaves those of faces, at most faces_max, those with the most supporters first, of as many in their order.
void add_faces(SumList& list) {
  size_t count = 0;
  for (size_t i = 0; i < list.count; ++i) {
    if (list.sums[i].supporters < face_supporters_min) continue;
    const Sum sum = list.sums[i];
    size_t to = count++;
    for (; to > 0 && list.sums[to - 1].supporters < sum.supporters; --to) list.sums[to] = list.sums[to - 1];
    list.sums[to] = sum;
  }
  list.count = std::min(count, faces_max);
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

size_t FacetMap::find(size_t index, VoxelCoord point) {
  int32_t& slot = slots_[index];
  if (slot == 0) {
    facets_.push_back(facet_at(window_, point));
    slot = static_cast<int32_t>(facets_.size());
  }
  return static_cast<size_t>(slot) - 1;
}

Facet FacetMap::at(VoxelCoord point) {
  return facets_[find(window_.index(point.x, point.y, point.z), point)];
}

void FacetMap::around(VoxelCoord cell, std::array<const Facet*, block_points>& facets) {
  const VoxelCoord low = cell - VoxelCoord{1, 1, 1}, size = window_.box.size();
  const auto step_y = static_cast<size_t>(size.z), step_x = static_cast<size_t>(size.y) * step_y;
  const size_t first = window_.index(low.x, low.y, low.z);
  std::array<size_t, block_points> found;
  size_t* to = found.data();
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 4; ++y) {
      const size_t row = first + static_cast<size_t>(x) * step_x + static_cast<size_t>(y) * step_y;
      for (int z = 0; z < 4; ++z) *to++ = find(row + static_cast<size_t>(z), low + VoxelCoord{x, y, z});
    }
  for (size_t i = 0; i < block_points; ++i) facets[i] = &facets_[found[i]];
}

namespace {

SCREE_VECTOR_CLONES void read_block(const std::array<Code, block_points>& codes, PointBlock& block) {
  for (size_t i = 0; i < block_points; ++i) {
    const int32_t code = codes[i];
    const int32_t known = static_cast<int32_t>(code != code_air) & static_cast<int32_t>(code != code_solid);
    block.distance[i] = static_cast<float>(code) * (band_voxels / 127.0F);
    block.in_rock[i] = known & static_cast<int32_t>(code < 0);
    block.in_air[i] = known & static_cast<int32_t>(code >= 0);
  }
  int32_t rock = 0, air = 0;
  for (size_t i = 0; i < block_points; ++i) {
    rock += block.in_rock[i];
    air += block.in_air[i];
  }
  block.rock = rock;
  block.air = air;
}

}  // namespace

PointBlock::PointBlock(const Window& window, VoxelCoord cell) {
  const VoxelCoord size = window.box.size();
  const auto step_y = static_cast<size_t>(size.z), step_x = static_cast<size_t>(size.y) * step_y;
  const Code* const first = &window.codes[window.index(cell.x - 1, cell.y - 1, cell.z - 1)];
  std::array<Code, block_points> codes;
  for (size_t row = 0; row < 16; ++row)
    std::memcpy(&codes[row * 4], first + row / 4 * step_x + row % 4 * step_y, 4);
  read_block(codes, *this);
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
  std::array<const Facet*, block_points> around;
  facets.around(cell, around);
  SumList list;
  std::array<uint8_t, block_points> weak;
  size_t weak_count = 0;
  for (size_t i = 0; i < block_points; ++i) {
    const int supporters = around[i]->supporters;
    if (supporters >= supporters_strong)
      add(*around[i], i, list);
    else if (supporters >= supporters_min)
      weak[weak_count++] = static_cast<uint8_t>(i);
  }
  if (list.count == 0) return {};
  for (size_t i = 0; i < weak_count; ++i) add(*around[weak[i]], weak[i], list);
  add_faces(list);
  std::vector<RockFace> faces;
  faces.reserve(list.count);
  for (const Sum& sum : list.all()) faces.push_back(face_of(sum));
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
