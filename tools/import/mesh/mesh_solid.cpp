#include "tools/import/mesh/mesh_solid.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <map>
#include <set>

#include "tools/import/limits.h"
#include "tools/import/mesh/winding.h"

namespace scree {

namespace {

constexpr int band_around = 4;

/// Up to here from the triangles, levels are distances. Between two voxels that are both farther lies no
/// surface of a closed mesh. Voxels.
constexpr float near_voxels = 2.0F;

/// So many voxels is a whole winding where no triangle is near.
constexpr float voxels_per_winding = 4.0F;

/// A voxel that lies nearer to a triangle than this is looked at on both sides of it.
constexpr float touching_voxels = 0.002F;

/// The place on a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
double distance_to(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return glm::length(ap);
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return glm::length(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return glm::length(ap - ab * (d1 / (d1 - d3)));
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return glm::length(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return glm::length(ap - ac * (d2 / (d2 - d6)));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return glm::length(bp - (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))));
  const glm::dvec3 normal = glm::cross(ab, ac);
  return std::abs(glm::dot(ap, normal)) / glm::length(normal);
}

class MeshSolid final : public Solid {
 public:
  MeshSolid(TriangleMesh mesh, bool closed, float voxel_size_m)
      : mesh_(std::move(mesh)), closed_(closed), voxel_m_(voxel_size_m), tree_(mesh_) {
    glm::dvec3 lo(1e300), hi(-1e300);
    for (const auto& t : mesh_.triangles)
      for (const uint32_t corner : t)
        lo = glm::min(lo, mesh_.points[corner]), hi = glm::max(hi, mesh_.points[corner]);
    if (mesh_.triangles.empty()) return;
    lowest_m_ = lo.y;
    box_ = {floored(lo), floored(hi) + VoxelCoord{1, 1, 1}};
  }

  /// Before all else that reads the mesh.
  Result<void> prepare() {
    TRY(layout_around(box_, static_cast<float>(voxel_m_)));
    size_t touched = closed_ ? 0 : count_chunks(box_);
    for (uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      const VoxelBox box = voxels_of(mesh_.triangles[i]).grown(band_around);
      touched += count_chunks(box);
      if (touched > limits::solid_surface_max)
        return fail(
            fmt::format("it is too large for voxels of {:.6g} m (limits.solid_surface_max); larger ones "
                        "(--voxel-size) or a smaller --scale fit",
                        voxel_m_));
      for_each_chunk(box, [&](ChunkCoord chunk) { near_[chunk].push_back(i); });
    }
    return {};
  }

  std::vector<ChunkCoord> surface_chunks() const override {
    std::set<ChunkCoord> chunks;
    for (const auto& [chunk, triangles] : near_) chunks.insert(chunk);
    // What closes a hole lies anywhere in between.
    if (!closed_) for_each_chunk(box_, [&](ChunkCoord chunk) { chunks.insert(chunk); });
    return {chunks.begin(), chunks.end()};
  }
  VoxelBox box() const override { return box_; }
  double lowest_m() const override { return lowest_m_; }
  bool is_inside(VoxelCoord voxel) const override { return tree_.winding(metres(voxel)) > 0.5; }
  std::optional<Material> material(BrickCoord brick) const override {
    const VoxelCoord first = first_voxel(brick);
    const VoxelBox box{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
    return mesh_.material && !common(box, box_.grown(1)).empty() ? mesh_.material : std::nullopt;
  }

  void read_levels(const VoxelBox& box, std::span<float> levels) const override {
    read_distances(box, levels);
    size_t i = 0;
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y) {
        std::optional<double> winding;  // of the voxel before, while no surface lies between
        for (int z = box.lo.z; z < box.hi.z; ++z, ++i) {
          const bool is_far = levels[i] >= near_voxels;
          if (!winding || !closed_ || !is_far) winding = tree_.winding(metres({x, y, z}));
          const auto signed_winding = static_cast<float>(0.5 - *winding);
          levels[i] =
              is_far ? voxels_per_winding * signed_winding : (signed_winding < 0.0F ? -levels[i] : levels[i]);
          if (!is_far && std::abs(levels[i]) < touching_voxels) levels[i] = level_on_triangle({x, y, z});
          if (!is_far) winding.reset();
        }
      }
  }

 private:
  /// 0, but inside where a triangle lies within the rest of the mesh: on a triangle itself, winding numbers
  /// jump.
  float level_on_triangle(VoxelCoord voxel) const {
    const glm::dvec3 aside =
        glm::dvec3(0.71, 1.0, 0.53) * (2.0 * static_cast<double>(touching_voxels) * voxel_m_);
    const bool inside =
        tree_.winding(metres(voxel) + aside) > 0.5 && tree_.winding(metres(voxel) - aside) > 0.5;
    return inside ? -voxels_per_winding : 0.0F;
  }

  glm::dvec3 metres(VoxelCoord voxel) const { return glm::dvec3(voxel.x, voxel.y, voxel.z) * voxel_m_; }
  VoxelCoord floored(const glm::dvec3& p_m) const {
    constexpr double far = 1.0e8;
    const auto axis = [&](double metres) {
      return static_cast<int>(std::floor(std::clamp(metres / voxel_m_, -far, far)));
    };
    return {axis(p_m.x), axis(p_m.y), axis(p_m.z)};
  }
  VoxelBox voxels_of(const std::array<uint32_t, 3>& t) const {
    const glm::dvec3 &a = mesh_.points[t[0]], &b = mesh_.points[t[1]], &c = mesh_.points[t[2]];
    return {floored(glm::min(a, glm::min(b, c))), floored(glm::max(a, glm::max(b, c))) + VoxelCoord{2, 2, 2}};
  }

  /// To the triangles of the chunks around, as far as near_voxels; more where none is as near.
  void read_distances(const VoxelBox& box, std::span<float> distances) const {
    std::ranges::fill(distances, band_voxels);
    std::set<uint32_t> triangles;
    for_each_chunk(box, [&](ChunkCoord chunk) {
      if (const auto found = near_.find(chunk); found != near_.end())
        triangles.insert(found->second.begin(), found->second.end());
    });
    const VoxelCoord size = box.size();
    for (const uint32_t i : triangles) {
      const auto& t = mesh_.triangles[i];
      const VoxelBox part = common(voxels_of(t).grown(static_cast<int>(near_voxels)), box);
      for (int x = part.lo.x; x < part.hi.x; ++x)
        for (int y = part.lo.y; y < part.hi.y; ++y)
          for (int z = part.lo.z; z < part.hi.z; ++z) {
            float& nearest = distances[(static_cast<size_t>(x - box.lo.x) * static_cast<size_t>(size.y) +
                                        static_cast<size_t>(y - box.lo.y)) *
                                           static_cast<size_t>(size.z) +
                                       static_cast<size_t>(z - box.lo.z)];
            const double m =
                distance_to(metres({x, y, z}), mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
            nearest = std::min(nearest, static_cast<float>(m / voxel_m_));
          }
    }
  }

  const TriangleMesh mesh_;
  const bool closed_;
  const double voxel_m_;
  const WindingTree tree_;
  std::map<ChunkCoord, std::vector<uint32_t>> near_;
  VoxelBox box_{};
  double lowest_m_ = 0.0;
};

}  // namespace

Result<std::unique_ptr<Solid>> solid_of_mesh(TriangleMesh mesh, bool closed, float voxel_size_m) {
  auto solid = std::make_unique<MeshSolid>(std::move(mesh), closed, voxel_size_m);
  TRY(solid->prepare());
  return solid;
}

}  // namespace scree
